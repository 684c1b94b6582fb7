// scene -> P, the volumetric image.
#pragma once

#include "runtime/renderer.hpp"
#include "runtime/volume.hpp"

namespace voxelume {

/// Renders the volumetric image of a scene's display in the scene's world, in its layout.
///
/// `progress` is called with the parts done and their number. Fills the report as `render` does;
/// `sight_rays` counts probe lines and rays to probe points too. Throws Error::limit for a display
/// whose voxels the device has no memory for, and Error as the stages do.
Volume render_volume(const Device& device, const Scene& scene, const FormedWorld& world,
                     RenderReport& report, const FrameProgress& progress = {});

/// The same with a world that is formed for it alone.
Volume render_volume(const Device& device, const Scene& scene, RenderReport& report,
                     const FrameProgress& progress = {});

}  // namespace voxelume
