// scene -> image, by several devices at once.
#pragma once

#include <vector>

#include "runtime/render/renderer.hpp"

namespace voxelume {

/// Who renders an image together.
struct DeviceGroup {
    std::vector<Device> devices;  ///< one or more
    ModelCache cache;             ///< of models that need no voxelizing
};

/// Renders the image of a single frame. Each device forms the world for itself and takes tiles as
/// it becomes free; the image has the bits that each of them alone would give it.
///
/// `report` counts the rays of all; its world and its times are those of the device that took
/// longest. Throws the first device's error, as `render` does.
Image render_together(const DeviceGroup& group, const Scene& scene, RenderReport& report,
                      const FrameProgress& progress = {});

}  // namespace voxelume
