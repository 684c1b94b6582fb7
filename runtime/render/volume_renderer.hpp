// scene -> P, the volumetric image.
#pragma once

#include <memory>
#include <optional>

#include "runtime/image/volume.hpp"
#include "runtime/render/renderer.hpp"

namespace voxelume {

/// Renders the volumetric image of a scene's display in the scene's world, in its layout.
///
/// `progress` is called with the parts done and their number. Fills the report as `render` does;
/// `sight_rays` counts probe lines and rays to probe points too. Throws Error::limit for a display
/// whose voxels the device has no memory for, and Error as the stages do.
Volume render_volume(const Device& device, const Scene& scene, const BuiltWorld& world,
                     RenderReport& report, const FrameProgress& progress = {});

/// Renders the volumetric images of one frame after another, and keeps the last: a frame that shows
/// nothing else has it.
class VolumeRenderer {
  public:
    /// Where nothing `follows` the first frame, nothing is kept.
    explicit VolumeRenderer(const Device& device, bool follows = true)
        : device_(device), follows_(follows) {}

    /// The volumetric image as `render_volume` renders it, whose counts are added to the report's.
    /// Attributes of the volume are its users' own: frames that share it have them one after
    /// another.
    std::shared_ptr<Volume> volume(const Scene& scene, const BuiltWorld& world,
                                   RenderReport& report, const FrameProgress& progress = {});

  private:
    Device device_;
    bool follows_;
    std::optional<Scene> scene_;  ///< whose volume is kept
    uint64_t world_ = 0;          ///< in which world
    std::shared_ptr<Volume> volume_;
    RenderReport report_;  ///< of rendering it
};

/// The same with a world that is formed for it alone.
Volume render_volume(const Device& device, const Scene& scene, RenderReport& report,
                     const FrameProgress& progress = {});

}  // namespace voxelume
