// SPDX-License-Identifier: Apache-2.0
#include "runtime/stages/lookup/source_mesh.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <map>
#include <set>

#include "kernels/shared/texture.h"
#include "runtime/base/error.hpp"
#include "runtime/stages/instance/instance_tree.hpp"
#include "runtime/stages/voxelize/voxelize_textures.hpp"

namespace voxelume {
namespace {

/// The maximum error by rounding of a point, or of a closest point, relative to the mesh's size.
constexpr double kRounding = 0x1p-20;

uint64_t nodes_of(uint64_t triangles) {
    return std::max(triangles, uint64_t{2}) - 1;
}

uint64_t mesh_words(uint64_t triangles) {
    return nodes_of(triangles) * VXL_SOURCE_NODE_WORDS +
           triangles * (VXL_SOURCE_CORNER_WORDS + VXL_WORN_WORDS);
}

bool has_equal_textures(const Mesh& a, const Mesh& b) {
    return std::ranges::equal(a.textures, b.textures, [](const Texture& s, const Texture& t) {
        return s.image == t.image && s.wrap_u == t.wrap_u && s.wrap_v == t.wrap_v &&
               std::ranges::equal(s.maps, t.maps, [](const TextureMap& m, const TextureMap& n) {
                   return m.texture == n.texture && m.transform == n.transform;
               });
    });
}

std::vector<SourceSize> sizes_of(std::span<const Mesh* const> meshes) {
    std::vector<SourceSize> sizes;
    for (size_t i = 0; i < meshes.size(); ++i) {
        SourceSize size{meshes[i]->triangles.size(), paint_of(*meshes[i]), i};
        for (size_t k = 0; k < i && size.texture_key == i; ++k)
            if (has_equal_textures(*meshes[k], *meshes[i])) size.texture_key = sizes[k].texture_key;
        sizes.push_back(size);
    }
    return sizes;
}

/// The tree over a mesh's triangles, as words.
std::vector<uint32_t> tree_words(const Mesh& mesh) {
    std::vector<InstanceBox> boxes;
    boxes.reserve(mesh.triangles.size());
    double size = 0;
    for (const glm::uvec3& t : mesh.triangles) {
        InstanceBox box{glm::dvec3(mesh.positions[t.x]), glm::dvec3(mesh.positions[t.x])};
        for (const uint32_t corner : {t.y, t.z}) {
            box.low = glm::min(box.low, glm::dvec3(mesh.positions[corner]));
            box.high = glm::max(box.high, glm::dvec3(mesh.positions[corner]));
        }
        for (int axis = 0; axis < 3; ++axis)
            size = std::max({size, std::abs(box.low[axis]), std::abs(box.high[axis])});
        boxes.push_back(box);
    }
    const std::vector<InstanceNode> nodes = build_instance_tree(boxes, size * kRounding);
    std::vector<uint32_t> words(nodes.size() * VXL_SOURCE_NODE_WORDS);
    if (!nodes.empty()) std::memcpy(words.data(), nodes.data(), words.size() * sizeof(uint32_t));
    return words;
}

std::vector<uint32_t> corner_words(const Mesh& mesh) {
    std::vector<uint32_t> words;
    words.reserve(mesh.triangles.size() * VXL_SOURCE_CORNER_WORDS);
    for (const glm::uvec3& t : mesh.triangles)
        for (int corner = 0; corner < 3; ++corner)
            for (int axis = 0; axis < 3; ++axis)
                words.push_back(std::bit_cast<uint32_t>(mesh.positions[t[corner]][axis]));
    return words;
}

}  // namespace

Buffer<uint32_t> allocate_source_words(const Device& device, std::span<const SourceSize> sizes) {
    std::set<uint64_t> textures;
    uint64_t words = 0;
    for (const SourceSize& size : sizes) {
        words += mesh_words(size.triangles);
        if (textures.insert(size.texture_key).second) words += texture_words(size.paint);
    }
    if (words > kMaxTextureWords)
        throw Error(ErrorKind::limit,
                    "the textures and triangles of the world's smooth objects have {} words, of "
                    "which 2^31 can be numbered: use smaller textures",
                    words);
    return {device, "source meshes", words, "use smaller textures"};
}

JoinedSources join_source_meshes(const Device& device, std::span<const Mesh* const> meshes) {
    const std::vector<SourceSize> sizes = sizes_of(meshes);
    JoinedSources joined{allocate_source_words(device, sizes), {}};
    struct Textures {
        uint32_t start = 0;
        std::vector<uint32_t> first_words;
    };
    std::map<uint64_t, Textures> textures;
    size_t end = 0;
    for (size_t i = 0; i < meshes.size(); ++i) {
        const auto [found, is_new] = textures.try_emplace(sizes[i].texture_key);
        if (!is_new) continue;
        const auto written =
            write_textures(*meshes[i], joined.words, end, TextureAlpha::is_ignored);
        found->second = {uint32_t(end), written.first_words};
        end += texture_words(sizes[i].paint);
        joined.has_maps |= sizes[i].paint.mapped > 0;
    }
    const auto append = [&](const std::vector<uint32_t>& words) {
        joined.words.write(words, end);
        end += words.size();
        return uint32_t(end - words.size());
    };
    for (size_t i = 0; i < meshes.size(); ++i) {
        const Textures& own = textures.at(sizes[i].texture_key);
        SourceOffsets offsets;
        offsets.textures = own.start;
        offsets.nodes = append(tree_words(*meshes[i]));
        offsets.triangles = append(corner_words(*meshes[i]));
        offsets.worn = append(worn_words(*meshes[i], own.first_words));
        joined.offsets.push_back(offsets);
    }
    return joined;
}

}  // namespace voxelume
