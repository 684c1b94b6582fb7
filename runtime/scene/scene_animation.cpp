// SPDX-License-Identifier: Apache-2.0
#include "runtime/scene/scene_animation.hpp"

#include <algorithm>
#include <cmath>

#include "runtime/scene/moved_part.hpp"
#include "runtime/scene/scene_motion.hpp"

namespace voxelume {

const std::filesystem::path& FileSequence::at(double frame) const {
    const auto count = int64_t(files.size());
    const int64_t step = int64_t(std::floor(frame)) - start;
    const int64_t index =
        loop ? (step % count + count) % count : std::clamp<int64_t>(step, 0, count - 1);
    return files[size_t(index)];
}

bool moves(const Scene& scene) {
    return scene.motion != nullptr;
}

Error at_frame(const Error& error, double frame) {
    const std::string sentence = error.what(), end = fmt::format(" (at frame {})", frame);
    return {error.place(), error.kind(), sentence.ends_with(end) ? sentence : sentence + end};
}

Scene scene_at(const Scene& scene, double frame) {
    Scene now = scene;
    if (!moves(scene)) return now;
    for (const MovingPart& part : scene.motion->parts) {
        try {
            MovedPart(part, scene.motion->file, frame, now).apply();
        } catch (const Error& error) {
            throw at_frame(error, frame);
        }
    }
    if (scene.has_default_light) place_default_light(now);
    find_extents(now);
    return now;
}

}  // namespace voxelume
