// SPDX-License-Identifier: Apache-2.0
// object -> whether its voxels are too large for its thin parts
#pragma once

#include <vector>

#include "runtime/analysis/warnings/warned_object.hpp"
#include "runtime/base/warning.hpp"

namespace voxelume {

/// Says of an object that all of it is thinner than its voxels, where these would lose parts of it
/// or show them too thick.
void add_thin_warning(const Scene& scene, const Object& object, const PlacedModel& placed,
                      AssetStore& meshes, std::vector<Warning>& warnings);

/// Says once of a mesh that a `smooth` surface loses parts of it, unless it is wholly too thin.
void add_thin_part_warning(const Scene& scene, const PlacedModel& placed, AssetStore& meshes,
                           std::vector<Warning>& warnings);

}  // namespace voxelume
