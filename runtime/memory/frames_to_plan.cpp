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
#include "runtime/scene/shutter.hpp"

namespace voxelume {
namespace {

/// Calls `visit` with the frames on both sides of a key, which may lie between frames.
template <class Visit>
void visit_frames(double key, const Visit& visit) {
    visit(int(std::floor(key)));
    visit(int(std::ceil(key)));
}

/// The frames at the keys where each of a track's numbers is smallest and largest.
template <class Visit>
void visit_extremes(const Keyframes& keys, const Visit& visit) {
    for (size_t column = 0; column < keys.width; ++column) {
        const auto value = [&](size_t key) { return keys.values[key * keys.width + column]; };
        size_t smallest = 0, largest = 0;
        for (size_t key = 1; key < keys.frames.size(); ++key) {
            if (value(key) < value(smallest)) smallest = key;
            if (value(key) > value(largest)) largest = key;
        }
        visit_frames(keys.frames[smallest], visit);
        visit_frames(keys.frames[largest], visit);
    }
}

/// The frames at the keys of tracks. If these are many, those at extreme keys, and other keys at
/// even distances.
std::set<int> frames_at_keys(const Scene& scene) {
    std::set<int> all, found;
    for (const MovingPart& part : scene.motion->parts)
        for (const Track& track : part.tracks) {
            for (const double key : track.keys.frames)
                visit_frames(key, [&](int frame) { all.insert(frame); });
            visit_extremes(track.keys, [&](int frame) {
                if (found.size() < kMaxPlannedKeys / 2) found.insert(frame);
            });
        }
    if (all.size() <= kMaxPlannedKeys) return all;
    const size_t step = all.size() / (kMaxPlannedKeys / 2) + 1;
    size_t number = 0;
    for (const int frame : all)
        if (number++ % step == 0) found.insert(frame);
    return found;
}

/// Finds objects with their models, and files of models, that no earlier frame shows.
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

/// Adds indices at even distances to those that were chosen on purpose.
void fill_evenly(FramesToPlan& found) {
    const size_t taken = std::min(found.chosen.size(), kMaxPlannedKeys);
    const size_t room = kMaxPlannedFrames - taken;
    found.step = (found.changed.size() + room - 1) / room;
    for (size_t index = 0; index < found.changed.size(); index += found.step)
        found.chosen.push_back(index);
    found.chosen.push_back(found.changed.size() - 1);
    std::ranges::sort(found.chosen);
    // Not std::ranges::unique, which clang 14 can't compile with GCC's library.
    found.chosen.erase(std::unique(found.chosen.begin(), found.chosen.end()), found.chosen.end());
}

}  // namespace

bool is_planned_like(const Scene& a, const Scene& b) {
    return a.render.samples == b.render.samples &&
           (a.render.channels.color || a.observer == b.observer) && a.objects == b.objects &&
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
            if (before && !has_moments(scene) && is_planned_like(*before, now)) return;
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
