// SPDX-License-Identifier: Apache-2.0
// frames of a scene -> whether each fits, and which takes the most, before memory is taken.
#pragma once

#include <functional>
#include <span>

#include "runtime/memory/plan.hpp"

namespace voxelume {

/// A frame with its plan.
struct FramePlan {
    int frame = 1;
    Scene scene;  ///< the scene at that frame
    ScenePlan plan;
    int plans = 1;          ///< number of plans made; other frames share those of frames before
    bool is_of_all = true;  ///< false: only frames chosen by frames_to_plan() were planned
};

/// True if check_memory refuses the frame.
bool is_refused(const FramePlan& planned, const DeviceInfo& device);

/// Plans all `frames` of a scene, one or more, and returns the first that doesn't fit the device,
/// or else the one that needs the most memory. If there are very many, those of frames_to_plan()
/// are planned, and some around the largest of them. Reads every file of models that they show.
/// Calls `progress`, unless it is empty, with the number of frames that are done.
///
/// Throws as scene_at, check_placements and plan_scene do, with the frame.
FramePlan plan_frames(const Scene& scene, std::span<const int> frames, AssetStore& meshes,
                      const DeviceInfo& device, const std::function<void(size_t)>& progress = {});

/// Checks all `frames` against the rules for placements, and those of frames_to_plan() against the
/// device's memory, as check_memory does, before the first is rendered.
///
/// Frames whose models have other files, or other shapes of a morph, than those of the first frame
/// aren't planned here but before they are rendered: reading their meshes would take as long as
/// rendering. Throws as plan_frames and check_memory do, with the frame.
void check_frames(const Scene& scene, std::span<const int> frames, AssetStore& meshes,
                  const DeviceInfo& device);

}  // namespace voxelume
