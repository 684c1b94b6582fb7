// frames -> files, by several devices at once: each takes the next frame when it becomes free.
#pragma once

#include <vector>

#include "runtime/batch/frame_pipeline.hpp"

namespace voxelume {

/// Takes `count` frames through their steps as run_frames does, which calls it for several devices.
///
/// Each device forms and renders its frames one after another; the caller's thread writes them in
/// order. No device is further ahead of what is written than two frames for each device.
void share_frames(const std::vector<Device>& devices, size_t count, const FrameSteps& steps,
                  const AssetStore& meshes);

}  // namespace voxelume
