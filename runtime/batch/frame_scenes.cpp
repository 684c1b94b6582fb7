// SPDX-License-Identifier: Apache-2.0
#include "runtime/batch/frame_scenes.hpp"

#include "runtime/scene/scene_animation.hpp"
#include "runtime/scene/shutter.hpp"

namespace voxelume {
namespace {

Scene scene_of(const FrameSource& source, int frame) {
    const auto [image, samples] = source.earlier ? source.earlier(frame) : EarlierImage();
    const bool is_later = image && has_moments(source.scene);
    const double moment = is_later ? moment_of(source.scene, frame, samples) : frame;
    Scene scene = band_of(scene_at(source.scene, moment), source.bands, 0);
    if (!image) return scene;
    scene.render.earlier = image;
    scene.render.first_sample = samples;
    scene.render.samples -= samples;
    return scene;
}

}  // namespace

FrameSteps steps_that_show(const FrameSource& source, std::vector<int> frames) {
    FrameSteps steps;
    const Scene& scene = source.scene;
    steps.scene = [source, frames](size_t n) { return scene_of(source, frames[n]); };
    if (moves(scene)) steps.number = [frames](size_t n) { return double(frames[n]); };
    if (!has_moments(scene)) return steps;
    steps.has_moments = [&scene, frames](size_t n) { return is_blurred(scene, frames[n]); };
    steps.moment = [&scene, frames](size_t n, int sample) {
        return scene_at(scene, moment_of(scene, frames[n], sample));
    };
    return steps;
}

}  // namespace voxelume
