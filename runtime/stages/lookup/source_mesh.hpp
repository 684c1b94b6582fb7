// SPDX-License-Identifier: Apache-2.0
// meshes -> the words in which kernels find closest points, and the textures there.
#pragma once

#include <span>
#include <vector>

#include "runtime/geometry/mesh.hpp"
#include "runtime/geometry/mesh_summary.hpp"
#include "runtime/grid/grid.hpp"

namespace voxelume {

/// The position of a mesh in the words of SourceMeshes, as SourceRecord has it.
struct SourceOffsets {
    uint32_t nodes = VXL_NO_SOURCE, triangles = 0, worn = 0, textures = 0;
};

/// The sizes of a source mesh, which give its number of words without the mesh.
struct SourceSize {
    uint64_t triangles = 0;
    MeshPaint paint;
    uint64_t texture_key = 0;  ///< meshes with equal keys have equal textures
};

/// Allocates words for meshes of these sizes; each key's textures are stored once. Throws
/// Error::limit for more words than can be numbered.
Buffer<uint32_t> allocate_source_words(const Device& device, std::span<const SourceSize> sizes);

/// The words of joined meshes, and the position of each.
struct JoinedSources {
    Buffer<uint32_t> words;
    std::vector<SourceOffsets> offsets;
    bool has_maps = false;
};

/// Joins meshes, each of which has textures. Throws Error::limit as allocate_source_words() does.
JoinedSources join_source_meshes(const Device& device, std::span<const Mesh* const> meshes);

}  // namespace voxelume
