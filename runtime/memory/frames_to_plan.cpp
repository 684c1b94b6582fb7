// SPDX-License-Identifier: Apache-2.0
#include "runtime/memory/frames_to_plan.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <set>
#include <utility>

#include "runtime/assets/model_frame.hpp"
#include "runtime/scene/predicates.hpp"
#include "runtime/scene/scene_animation.hpp"
#include "runtime/scene/scene_motion.hpp"

namespace voxelume {
namespace {

/// The frames at the keys of tracks, and on both sides of keys between frames; none where they are
/// many.
std::set<int> frames_at_keys(const Scene& scene) {
    std::set<int> found;
    for (const MovingPart& part : scene.motion->parts)
        for (const Track& track : part.tracks)
            for (const double key : track.keys.frames) {
                found.insert({int(std::floor(key)), int(std::ceil(key))});
                if (found.size() > kMaxPlannedKeys) return {};
            }
    return found;
}

/// Notices objects with their models, and files of models, that no earlier frame shows.
class KnownParts {
  public:
    bool adds(const Scene& scene) {
        bool is_new = false;
        for (size_t i = 0; i < scene.objects.size(); ++i)
            if (may_be_shown(scene, scene.objects[i]))
                is_new |= objects_.insert({i, scene.objects[i].model}).second;
        for (const Model& model : scene.models)
            for (const std::filesystem::path& file : {model.mesh, model.voxels})
                is_new |= files_.insert(file).second;
        return is_new;
    }

  private:
    std::set<std::pair<size_t, int>> objects_;
    std::set<std::filesystem::path> files_;
};

FramesToPlan all_of(std::vector<int> frames) {
    FramesToPlan all{std::move(frames), {}};
    all.chosen.resize(all.changed.size());
    std::iota(all.chosen.begin(), all.chosen.end(), size_t{0});
    return all;
}

/// Adds places at even distances to those chosen for their own sake.
void fill_evenly(FramesToPlan& found) {
    const size_t taken = std::min(found.chosen.size(), kMaxPlannedKeys);
    const size_t room = kMaxPlannedFrames - taken;
    found.step = (found.changed.size() + room - 1) / room;
    for (size_t place = 0; place < found.changed.size(); place += found.step)
        found.chosen.push_back(place);
    found.chosen.push_back(found.changed.size() - 1);
    std::ranges::sort(found.chosen);
    const auto doubled = std::ranges::unique(found.chosen);
    found.chosen.erase(doubled.begin(), doubled.end());
}

}  // namespace

bool is_planned_like(const Scene& a, const Scene& b) {
    return (a.render.channels.color || a.observer == b.observer) && a.objects == b.objects &&
           a.models == b.models && a.materials == b.materials &&
           std::ranges::equal(a.lights, b.lights, {}, shines, shines) &&
           a.world.medium == b.world.medium;
}

FramesToPlan frames_to_plan(const Scene& scene, std::span<const int> frames,
                            const std::function<void(size_t)>& progress) {
    if (frames.size() <= kMaxPlannedFrames || !moves(scene))
        return all_of({frames.begin(), frames.end()});
    const std::set<int> keys = frames_at_keys(scene);
    KnownParts known;
    FramesToPlan found;
    std::optional<Scene> before;
    for (size_t i = 0; i < frames.size(); ++i) {
        if (progress) progress(i);
        in_frame(scene, frames[i], [&] {
            Scene now = scene_at(scene, frames[i]);
            if (before && is_planned_like(*before, now)) return;
            check_placements(now);
            if (known.adds(now) || keys.contains(frames[i]))
                found.chosen.push_back(found.changed.size());
            found.changed.push_back(frames[i]);
            before = std::move(now);
        });
    }
    if (found.changed.size() <= kMaxPlannedFrames) return all_of(std::move(found.changed));
    fill_evenly(found);
    return found;
}

}  // namespace voxelume
