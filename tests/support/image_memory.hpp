// SPDX-License-Identifier: Apache-2.0
// The memory that an image is promised to take on a device, and what it really takes.
#pragma once

#include <vector>

#include "runtime/analysis/culling.hpp"
#include "runtime/memory/frame_plans.hpp"
#include "runtime/render/renderer.hpp"
#include "tests/support/test_device.hpp"

namespace voxelume {

/// Bytes on a device that has done nothing else.
struct ImageMemoryUse {
    Device device;
    double min = 0, promise = 0;  ///< planned
    double fact = 0;              ///< the peak
};

/// Plans the image of a scene that stands still, and renders it.
inline ImageMemoryUse memory_of_image(Scene scene) {
    ImageMemoryUse use{test_device()};
    AssetStore meshes;
    const std::vector<int> frames = {1};
    find_potentially_visible(scene, frames, meshes);
    const DeviceInfo& info = use.device.info();
    const ScenePlan plan = plan_frames(scene, frames, meshes, info).plan;
    use.min = plan.min_bytes;
    use.promise = plan.run_bytes(1, double(info.memory));
    RenderReport report;
    render(use.device, scene, report);
    use.fact = double(use.device.counters().peak_bytes);
    return use;
}

}  // namespace voxelume
