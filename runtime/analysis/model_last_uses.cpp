// SPDX-License-Identifier: Apache-2.0
#include "runtime/analysis/model_last_uses.hpp"

#include <algorithm>

#include "runtime/scene/scene_animation.hpp"
#include "runtime/scene/scene_motion.hpp"

namespace voxelume {
namespace {

/// True if any object may change by more than its position.
bool objects_change(const Scene& scene) {
    return any_part_changes(scene, [](const MovingPart& part) {
        return part.part == ScenePart::object && !part.only_placed;
    });
}

}  // namespace

std::vector<size_t> last_uses(const Scene& scene, std::span<const int> frames) {
    std::vector<size_t> last_use(scene.models.size(), 0);
    const auto show = [&](const Scene& now, size_t passed) {
        for (const Object& object : now.objects)
            if (object.visible) last_use[size_t(object.model)] = passed;
    };
    if (!objects_change(scene)) {
        show(scene, frames.size());
        return last_use;
    }
    for (size_t i = 0; i < frames.size(); ++i)
        in_frame(scene, frames[i], [&] { show(scene_at(scene, frames[i]), i + 1); });
    return last_use;
}

}  // namespace voxelume
