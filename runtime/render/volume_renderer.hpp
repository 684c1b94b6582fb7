// SPDX-License-Identifier: Apache-2.0
// scene -> P, the volumetric image.
#pragma once

#include <memory>
#include <optional>

#include "runtime/image/volume.hpp"
#include "runtime/render/renderer.hpp"

namespace voxelume {

/// Renders the volumetric image of a scene's display in the scene's world, in its layout.
///
/// `progress` is called with the number of finished parts and of all parts. Fills the report as
/// `render` does; `sight_rays` includes probe lines and rays to probe points. Throws Error::limit
/// if the device's memory doesn't suffice for the display's voxels, and Error as the stages do.
Volume render_volume(const Device& device, const Scene& scene, const BuiltWorld& world,
                     RenderReport& report, const FrameProgress& progress = {});

/// Renders the volumetric images of successive frames, and retains the last one for a frame that
/// shows the same.
class VolumeRenderer {
  public:
    /// With `follows` = false no second frame follows the first, and nothing is retained.
    explicit VolumeRenderer(const Device& device, bool follows = true)
        : device_(device), follows_(follows) {}

    /// The volumetric image as `render_volume` renders it, whose counts are added to the report's.
    /// The volume's attributes belong to its users: frames that share a volume write them one after
    /// another.
    std::shared_ptr<Volume> volume(const Scene& scene, const BuiltWorld& world,
                                   RenderReport& report, const FrameProgress& progress = {});

  private:
    Device device_;
    bool follows_;
    std::optional<Scene> scene_;  ///< the scene whose volume is retained
    uint64_t world_ = 0;          ///< the version of its world
    std::shared_ptr<Volume> volume_;
    RenderReport report_;  ///< report on rendering the volume
};

/// Renders the volumetric image with a world that is built for it alone.
Volume render_volume(const Device& device, const Scene& scene, RenderReport& report,
                     const FrameProgress& progress = {});

}  // namespace voxelume
