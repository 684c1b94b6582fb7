// SPDX-License-Identifier: Apache-2.0
// Textures of a mesh on a device, and the level that each triangle's voxels see.
#pragma once

#include "runtime/geometry/mesh_summary.hpp"
#include "runtime/stages/voxelize/voxelize_steps.hpp"

namespace voxelume {

// The names of buffers, by which a plan describes them.
inline constexpr const char* kTexels = "texture texels";
inline constexpr const char* kTextureWords = "texture words";
inline constexpr const char* kUvs = "texture places";
inline constexpr const char* kCornerUvs = "texture corners";

/// The textures; empty for a mesh without.
struct DeviceTextures {
    Buffer<uint32_t> texels;   ///< texels of all textures and levels
    Buffer<uint32_t> records;  ///< four a texture; shared/texture.h
    Buffer<uint32_t> words;    ///< one a triangle; shared/texture.h
};

/// The level of a texture whose texels are closest in size to voxels: the area of the triangle is
/// `texels` on the first level, and `voxels` squares of the shortest edge.
uint32_t texture_level(double texels, double voxels, int levels);

/// Kernels gather by signed indices.
inline constexpr uint64_t kMaxTextureWords = uint64_t{1} << 31;

/// The effect of textures' alpha where rays meet them.
enum class TextureAlpha : uint8_t { counts, is_ignored };

/// Written textures: the position of each, from the start of their words, and a hash of all.
struct WrittenTextures {
    std::vector<uint32_t> first_words;
    uint64_t hash = 0;
};

/// Writes the textures of a mesh, as BrickGrid::textures has them, from `start` on into words with
/// room for texture_words().
WrittenTextures write_textures(const Mesh& mesh, Buffer<uint32_t>& words, size_t start,
                               TextureAlpha alpha);

/// The textures on a mesh's triangles, in the words of shared/texture.h; `first_words` are the
/// positions of textures.
std::vector<uint32_t> worn_words(const Mesh& mesh, const std::vector<uint32_t>& first_words);

/// Stores the textures of exact voxels' triangles in the job's grid for rays. Meshes without
/// textures get nothing. Throws Error::limit for more texels than a device's buffer holds.
void keep_textures(VoxelizeJob& job, const Mesh& mesh);

/// The number of words of all textures in BrickGrid::textures.
uint64_t texture_words(const MeshPaint& paint);

/// Uploads a mesh's textures. Throws Error::limit for more texels than a device's buffer holds.
DeviceTextures upload_textures(const VoxelizeJob& job, const Mesh& mesh);

}  // namespace voxelume
