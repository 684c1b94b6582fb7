// SPDX-License-Identifier: Apache-2.0
// scene -> lights and observers inside of opaque objects
#pragma once

#include <vector>

#include "runtime/assets/asset_store.hpp"
#include "runtime/base/warning.hpp"
#include "runtime/scene/scene.hpp"

namespace voxelume {

/// Adds a warning for each light, and for the observer, that an opaque object encloses, at one
/// frame.
///
/// A body that encloses both is a room. So is one around the observer and another object. An
/// observer whose display is a lattice may be anywhere. Solids are asked by their formulas, meshes
/// by their winding number; files of voxels aren't asked.
void add_inside_warnings(const Scene& scene, AssetStore& meshes, std::vector<Warning>& warnings);

}  // namespace voxelume
