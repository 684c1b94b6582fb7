// SPDX-License-Identifier: Apache-2.0
// object -> whether it is in the world, and of a size that its voxels and the world's can show
#pragma once

#include <vector>

#include "runtime/assets/asset_store.hpp"
#include "runtime/base/warning.hpp"
#include "runtime/scene/scene.hpp"

namespace voxelume {

/// Adds what is wrong with where an object stands and how large it is, at one frame. An object that
/// is outside of the world, or whose unit is unlikely, has no other warning.
void add_object_warnings(const Scene& scene, const Object& object, AssetStore& meshes,
                         std::vector<Warning>& warnings);

}  // namespace voxelume
