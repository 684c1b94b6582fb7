// SPDX-License-Identifier: Apache-2.0
// a mesh's textures -> the textures of its exact triangles, for the rays that meet them.
#include <xxhash.h>

#include <algorithm>
#include <array>
#include <bit>
#include <memory>

#include "kernels/shared/texture.h"
#include "runtime/base/error.hpp"
#include "runtime/image/srgb.hpp"
#include "runtime/io/image/png.hpp"
#include "runtime/stages/voxelize/voxelize_textures.hpp"

namespace voxelume {
namespace {

/// The texture of a triangle of a mesh with textures, kNoTexture for none.
uint32_t texture_of(const Mesh& mesh, size_t triangle, const glm::uvec3& uvs) {
    const uint32_t group = mesh.triangle_group.empty() ? 0 : mesh.triangle_group[triangle];
    const uint32_t texture =
        group < mesh.group_textures.size() ? mesh.group_textures[group] : kNoTexture;
    const bool has_uvs = std::max({uvs.x, uvs.y, uvs.z}) < mesh.uvs.size();
    return texture < mesh.textures.size() && has_uvs ? texture : kNoTexture;
}

/// The colour of a triangle's corner in sRGB, white where the mesh has no colours.
uint32_t corner_color(const Mesh& mesh, size_t triangle, int corner) {
    if (mesh.vertex_colors.empty()) return 0xFFFFFF;
    const auto& numbers = mesh.triangle_colors.empty() ? mesh.triangles : mesh.triangle_colors;
    const glm::vec3& color = mesh.vertex_colors[numbers[triangle][corner]];
    return uint32_t(srgb_code(color.x)) | uint32_t(srgb_code(color.y)) << 8 |
           uint32_t(srgb_code(color.z)) << 16;
}

/// Writes textures one after another, and hashes them.
class TextureWriter {
  public:
    TextureWriter(Buffer<uint32_t>& words, size_t start)
        : words_(words), next_word_(start), state_(XXH3_createState(), XXH3_freeState) {
        XXH3_64bits_reset(state_.get());
    }

    void write(std::span<const uint32_t> words) {
        words_.write(words, next_word_);
        XXH3_64bits_update(state_.get(), words.data(), words.size_bytes());
        next_word_ += words.size();
    }

    uint64_t hash() const { return XXH3_64bits_digest(state_.get()); }

  private:
    Buffer<uint32_t>& words_;
    size_t next_word_;
    std::unique_ptr<XXH3_state_t, decltype(&XXH3_freeState)> state_;
};

/// The position of each texture, after the records of its maps.
std::vector<uint32_t> first_words_of(const Mesh& mesh) {
    std::vector<uint32_t> first_words;
    first_words.reserve(mesh.textures.size());
    size_t end = VXL_TEXTURE_CURVE;
    for (const Texture& texture : mesh.textures) {
        if (texture.has_maps()) end += size_t{VXL_MAP_COUNT} * VXL_MAP_WORDS;
        first_words.push_back(uint32_t(end));
        end += VXL_TEXTURE_HEAD + texture.image->texels.size();
    }
    return first_words;
}

/// Writes the records of a texture's maps.
void write_maps(const Texture& texture, uint32_t first_word,
                const std::vector<uint32_t>& first_words, TextureWriter& writer) {
    for (const TextureMap& map : texture.maps) {
        std::array<uint32_t, VXL_MAP_WORDS> record{};
        if (map.texture != kNoTexture)
            record[VXL_MAP_OFFSET] = first_words[map.texture] - first_word;
        for (size_t i = 0; i < map.transform.size(); ++i)
            record[VXL_MAP_TRANSFORM + i] = std::bit_cast<uint32_t>(map.transform[i]);
        writer.write(record);
    }
}

}  // namespace

WrittenTextures write_textures(const Mesh& mesh, Buffer<uint32_t>& words, size_t start,
                               TextureAlpha alpha) {
    TextureWriter writer(words, start);
    std::vector<uint32_t> curve;
    for (const float level : srgb_levels()) curve.push_back(std::bit_cast<uint32_t>(level));
    writer.write(curve);
    const std::vector<uint32_t> first_words = first_words_of(mesh);
    for (size_t i = 0; i < mesh.textures.size(); ++i) {
        const Texture& texture = mesh.textures[i];
        const TextureImage& image = *texture.image;
        const bool has_maps = texture.has_maps();
        if (has_maps) write_maps(texture, first_words[i], first_words, writer);
        const uint32_t head[VXL_TEXTURE_HEAD] = {
            uint32_t(image.width), uint32_t(image.height),
            uint32_t(texture.wrap_u) | uint32_t(texture.wrap_v) << VXL_TEXTURE_WRAP_V_SHIFT |
                (has_maps ? VXL_TEXTURE_HAS_MAPS : 0u),
            alpha == TextureAlpha::counts ? texture.alpha : VXL_ALPHA_OPAQUE};
        writer.write(head);
        writer.write(image.texels);
    }
    return {first_words, writer.hash()};
}

uint64_t texture_words(const MeshPaint& paint) {
    return VXL_TEXTURE_CURVE + paint.textures * VXL_TEXTURE_HEAD + paint.texels +
           paint.mapped * VXL_MAP_COUNT * VXL_MAP_WORDS;
}

std::vector<uint32_t> worn_words(const Mesh& mesh, const std::vector<uint32_t>& first_words) {
    const auto& numbers = mesh.triangle_uvs.empty() ? mesh.triangles : mesh.triangle_uvs;
    std::vector<uint32_t> words;
    words.reserve(mesh.triangles.size() * VXL_WORN_WORDS);
    for (size_t i = 0; i < mesh.triangles.size(); ++i) {
        const uint32_t texture = texture_of(mesh, i, numbers[i]);
        for (int corner = 0; corner < 3; ++corner)
            for (int axis = 0; axis < 2; ++axis) {
                const float at = texture == kNoTexture ? 0 : mesh.uvs[numbers[i][corner]][axis];
                words.push_back(std::bit_cast<uint32_t>(at));
            }
        words.push_back(texture == kNoTexture ? VXL_NO_TEXTURE : first_words[texture]);
        for (int corner = 0; corner < 3; ++corner) words.push_back(corner_color(mesh, i, corner));
    }
    return words;
}

void keep_textures(VoxelizeJob& job, const Mesh& mesh) {
    if (mesh.textures.empty()) return;
    const MeshPaint paint = paint_of(mesh);
    if (texture_words(paint) > kMaxTextureWords)
        throw Error(ErrorKind::limit, "the mesh has textures of {} texels, more than 2^31",
                    paint.texels);
    BrickGrid& grid = job.grid;
    grid.textures = Buffer<uint32_t>(job.device, "source textures", texture_words(paint));
    const WrittenTextures written = write_textures(mesh, grid.textures, 0, TextureAlpha::counts);
    grid.texture_key = written.hash;
    grid.texture_alpha = paint.has_alpha;
    grid.texture_maps = paint.mapped > 0;
    const std::vector<uint32_t> words = worn_words(mesh, written.first_words);
    grid.triangle_textures =
        Buffer<uint32_t>(job.device, "source texture places", std::span<const uint32_t>(words));
}

}  // namespace voxelume
