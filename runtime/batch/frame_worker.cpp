#include "runtime/batch/frame_worker.hpp"

#include <utility>

#include "runtime/base/error.hpp"
#include "runtime/scene_file/scene_animation.hpp"

namespace voxelume {

BuiltWorld build_frame(WorldBuilder& builder, const FrameSteps& steps, size_t frame,
                       const Scene& scene, WorldReport& report) {
    try {
        return builder.build(scene, report,
                             steps.retained ? steps.retained(frame) : std::vector<bool>());
    } catch (const Error& error) {
        if (!steps.number) throw;
        throw at_frame(error, steps.number(frame));
    }
}

FrameWorker::FrameWorker(const Device& device, size_t number, const FrameSteps& steps,
                         AssetStore meshes, bool follows)
    : device_(device),
      number_(number),
      steps_(steps),
      cache_(meshes.cache()),
      builder_(std::in_place, device, follows, std::move(meshes)),
      keeps_(follows) {}

std::function<void()> FrameWorker::take(size_t frame, const Scene& scene) {
    if (has_any_ && !keeps_) forget();
    try {
        return form_and_render(frame, scene);
    } catch (const Error& error) {
        const bool makes_room = has_any_ || builder_->keeps();
        if (error.kind() != ErrorKind::limit || !makes_room || !keeps_ || !steps_.forget) throw;
    }
    keeps_ = false;
    lacks_room_ = true;
    forget();
    return form_and_render(frame, scene);
}

std::function<void()> FrameWorker::form_and_render(size_t frame, const Scene& scene) {
    WorldReport report;
    const BuiltWorld world = build_frame(*builder_, steps_, frame, scene, report);
    report.lacks_room |= lacks_room_;
    auto write = steps_.render({frame, number_, scene, world, report});
    has_any_ = true;
    return write;
}

void FrameWorker::forget() {
    builder_.emplace(device_, false, AssetStore(cache_));
    steps_.forget(number_);
    has_any_ = false;
}

}  // namespace voxelume
