// SPDX-License-Identifier: Apache-2.0
// scene of an animation -> the memory of a device while one frame is rendered and the next one's
// world is built.
#pragma once

#include "runtime/memory/count/object_counts.hpp"
#include "runtime/stages/medium/density_grid.hpp"

namespace voxelume {

/// The maximum bytes of the device in a run of frames that keeps what they share and builds each
/// frame's world while the one before is rendered. 0 for a scene that stands still.
double walk_following(const Scene& scene, AssetStore& meshes, ObjectCounts& objects,
                      const DensityPlan& medium, const DeviceInfo& device);

}  // namespace voxelume
