// A frame's world formed, then its files' contents rendered, on one device.
#pragma once

#include <optional>

#include "runtime/batch/frame_pipeline.hpp"

namespace voxelume {

/// Forms the world of a frame.
BuiltWorld build_frame(WorldBuilder& builder, const FrameSteps& steps, size_t frame,
                       const Scene& scene, WorldReport& report);

/// Takes one frame after another through forming and rendering. What is kept of the frames before
/// is forgotten, now and from then on, where the device has no memory for a frame beside it.
class FrameWorker {
  public:
    /// `number` is the device's in FrameInput. Where nothing `follows` the first frame, nothing is
    /// kept.
    FrameWorker(const Device& device, size_t number, const FrameSteps& steps, AssetStore meshes,
                bool follows);

    /// Returns what writes the frame's files.
    std::function<void()> take(size_t frame, const Scene& scene);

  private:
    std::function<void()> form_and_render(size_t frame, const Scene& scene);
    void forget();

    Device device_;
    size_t number_;
    const FrameSteps& steps_;
    ModelCache cache_;
    std::optional<WorldBuilder> builder_;
    bool keeps_;               ///< frames may keep something for those that follow
    bool lacks_room_ = false;  ///< for that
    bool has_any_ = false;     ///< of frames before
};

}  // namespace voxelume
