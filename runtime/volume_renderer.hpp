// scene -> P, the volumetric image.
#pragma once

#include <functional>

#include "runtime/renderer.hpp"
#include "runtime/volume.hpp"

namespace voxelume {

/// Renders the volumetric image of a scene's display, in its layout, on a device.
///
/// `progress` is called with the parts done and their number. Fills the report as `render` does;
/// `sight_rays` counts probe lines and rays to probe points too. Throws Error::limit for a display
/// whose voxels the device has no memory for, and Error as the stages do.
Volume render_volume(const Device& device, const Scene& scene, RenderReport& report,
                     const std::function<void(uint32_t done, uint32_t total)>& progress = {});

}  // namespace voxelume
