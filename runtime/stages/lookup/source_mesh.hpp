// SPDX-License-Identifier: Apache-2.0
// meshes -> the words in which kernels find closest points, and what these wear.
#pragma once

#include <span>
#include <vector>

#include "runtime/geometry/mesh.hpp"
#include "runtime/geometry/mesh_summary.hpp"
#include "runtime/grid/grid.hpp"

namespace voxelume {

/// Where a mesh lies among the words of SourceMeshes, as SourceRecord has it.
struct SourcePlaces {
    uint32_t nodes = VXL_NO_SOURCE, triangles = 0, worn = 0, textures = 0;
};

/// What source meshes are made of, to tell their words without a mesh.
struct SourceSize {
    uint64_t triangles = 0;
    MeshPaint paint;
    uint64_t texture_key = 0;  ///< meshes with equal keys have equal textures
};

/// Makes room for meshes of these sizes; each key's textures are stored once. Throws Error::limit
/// for more words than can be numbered.
Buffer<uint32_t> allocate_source_words(const Device& device, std::span<const SourceSize> sizes);

/// The meshes that are joined, and the place of each.
struct JoinedSources {
    Buffer<uint32_t> words;
    std::vector<SourcePlaces> places;
    bool has_maps = false;
};

/// Joins meshes, each of which has textures. Throws Error::limit as above.
JoinedSources join_source_meshes(const Device& device, std::span<const Mesh* const> meshes);

}  // namespace voxelume
