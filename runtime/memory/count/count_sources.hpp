// SPDX-License-Identifier: Apache-2.0
// The data of each object that rays look up, on a counting device: the meshes of smooth objects
// with textures, and the steps of cubes with normals.
#pragma once

#include <span>

#include "runtime/assets/asset_store.hpp"
#include "runtime/grid/grid.hpp"
#include "runtime/scene/scene.hpp"

namespace voxelume {

/// Follows SourceMeshCache::meshes_of.
SourceMeshes count_sources(const Device& device, const Scene& scene, AssetStore& meshes);

/// Follows WorldBuilder::build for Pyramid::cube_steps.
Buffer<float> count_cube_steps(const Device& device, const Scene& scene, AssetStore& meshes,
                               std::span<const VoxelBox> boxes);

/// Follows WorldBuilder::build for Pyramid::order.
Buffer<uint32_t> count_order(const Device& device, const Scene& scene);

}  // namespace voxelume
