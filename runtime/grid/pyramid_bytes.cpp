// SPDX-License-Identifier: Apache-2.0
#include "runtime/grid/pyramid_bytes.hpp"

#include <algorithm>

#include "runtime/grid/packed_grid.hpp"

namespace voxelume {
namespace {

/// Calls `visit` with the buffers of a pyramid's voxels, in the order of their bytes.
template <class AnyPyramid, class Visit>
void visit_pyramid(AnyPyramid& pyramid, const Visit& visit) {
    visit("sectors", pyramid.sectors);
    visit("brick records", pyramid.bricks);
    visit("leaves", pyramid.leaves);
    visit("leaf voxels", pyramid.leaf_voxels);
    visit("voxel attributes", pyramid.attributes);
    visit("voxel colors", pyramid.colors);
    visit("voxel normals", pyramid.normals);
    visit("voxel fields", pyramid.fields);
    visit("primitive starts", pyramid.primitive_first);
    visit("primitives", pyramid.primitives);
    visit("source triangles", pyramid.triangles);
    visit("source attributes", pyramid.triangle_attributes);
    visit("source normals", pyramid.triangle_normals);
    visit("source texture places", pyramid.triangle_textures);
    visit("source textures", pyramid.textures);
    visit("source solids", pyramid.solids);
}

/// Calls its argument with each buffer of a pyramid's voxels.
auto pyramid_buffers(auto& pyramid) {
    return [&pyramid](const auto& visit) { visit_pyramid(pyramid, visit); };
}

}  // namespace

uint64_t bytes_of(const Pyramid& pyramid) {
    return buffer_bytes([&](const auto& visit) {
        visit_pyramid(pyramid, visit);
        visit("", pyramid.instances.records);
        visit("", pyramid.instances.nodes);
        visit("", pyramid.instances.materials);
        visit("", pyramid.sources.words);
        visit("", pyramid.sources.objects);
        visit("", pyramid.cube_steps);
        visit("", pyramid.order);
    });
}

std::string bytes_of_pyramid(const Pyramid& pyramid) {
    const std::array<uint32_t, 5> counts{
        pyramid.leaf_count, pyramid.voxel_count, pyramid.attribute,
        uint32_t(pyramid.transparent) | uint32_t(pyramid.texture_alpha) << 1 |
            uint32_t(pyramid.texture_maps) << 2 | uint32_t(pyramid.has_chains) << 3 |
            uint32_t(pyramid.cubes) << 4 | pyramid.chain_depth << 5,
        pyramid.listed_fields};
    return *packed_bytes({pyramid.frame, counts}, pyramid_buffers(pyramid));
}

std::optional<Pyramid> pyramid_of_bytes(const Device& device, std::string_view bytes) {
    Pyramid pyramid;
    const auto header = unpack_bytes(device, bytes, pyramid_buffers(pyramid));
    if (!header) return std::nullopt;
    pyramid.frame = header->frame;
    pyramid.leaf_count = header->counts[0];
    pyramid.voxel_count = header->counts[1];
    pyramid.attribute = header->counts[2];
    pyramid.transparent = (header->counts[3] & 1) != 0;
    pyramid.texture_alpha = (header->counts[3] & 2) != 0;
    pyramid.texture_maps = (header->counts[3] & 4) != 0;
    pyramid.has_chains = (header->counts[3] & 8) != 0;
    pyramid.cubes = (header->counts[3] & 16) != 0;
    pyramid.chain_depth = std::min(header->counts[3] >> 5, uint32_t(kMaxBracketDepth));
    pyramid.listed_fields = header->counts[4];
    const bool fits = pyramid.leaves.size() == size_t(pyramid.leaf_count) * 2 &&
                      pyramid.leaf_voxels.size() == pyramid.leaf_count;
    return fits ? std::optional(std::move(pyramid)) : std::nullopt;
}

}  // namespace voxelume
