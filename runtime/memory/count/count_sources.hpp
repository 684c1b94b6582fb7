// SPDX-License-Identifier: Apache-2.0
// The meshes of smooth objects with textures on a counting device.
#pragma once

#include "runtime/assets/asset_store.hpp"
#include "runtime/grid/grid.hpp"
#include "runtime/scene/scene.hpp"

namespace voxelume {

/// Follows SourceMeshCache::meshes_of.
SourceMeshes count_sources(const Device& device, const Scene& scene, AssetStore& meshes);

}  // namespace voxelume
