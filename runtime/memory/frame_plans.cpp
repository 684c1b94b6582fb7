// SPDX-License-Identifier: Apache-2.0
#include "runtime/memory/frame_plans.hpp"

#include <algorithm>
#include <optional>
#include <utility>

#include "runtime/analysis/model_last_uses.hpp"
#include "runtime/analysis/scene_features.hpp"
#include "runtime/base/error.hpp"
#include "runtime/memory/frames_to_plan.hpp"
#include "runtime/scene/predicates.hpp"
#include "runtime/scene/scene_animation.hpp"
#include "runtime/scene/shutter.hpp"

namespace voxelume {
namespace {

/// Limits an image to the samples of one moment, and notes that there are more.
void take_at_once(int samples, RenderSettings& render) {
    if (samples < render.samples) render.all_samples = std::exchange(render.samples, samples);
}

/// True if both frames show the same meshes and voxels.
bool has_files_of(const Scene& a, const Scene& b) {
    return std::ranges::equal(a.models, b.models, [](const Model& m, const Model& n) {
        return m.mesh == n.mesh && m.voxels == n.voxels && m.morph == n.morph;
    });
}

/// Frees the meshes in main memory except a frame's, as far as they take more than meshes of other
/// frames may.
void forget_largest(const Scene& scene, const DeviceInfo& device, AssetStore& meshes) {
    uint64_t room = device.memory / kRetainedPart;
    for (const Model& model : scene.models) meshes.retain(model, room);
    meshes.forget_unused();
}

/// Plans frames one after the other, and keeps the plan that takes the most.
class FramePlanner {
  public:
    FramePlanner(const Scene& scene, AssetStore& meshes, const DeviceInfo& device, size_t frames)
        : scene_(scene), meshes_(meshes), device_(device), worlds_(worlds_of(scene, frames)) {}

    FramePlan run(std::span<const int> frames, const std::function<void(size_t)>& progress) {
        // Choosing frames means looking at all of them, which is half of the progress.
        const bool chooses = frames.size() > kMaxPlannedFrames;
        const size_t seen = progress && chooses ? frames.size() / 2 : 0;
        const FramesToPlan found = frames_to_plan(scene_, frames, [&](size_t i) {
            if (progress) progress(i / 2);
        });
        for (size_t i = 0; i < found.chosen.size(); ++i) {
            if (progress) progress(seen + i * (frames.size() - seen) / found.chosen.size());
            if (!plan(found, found.chosen[i])) return std::move(*refused_);
        }
        if (!climb(found)) return std::move(*refused_);
        maximum_->plans = plans_;
        maximum_->is_of_all = found.chosen.size() == found.changed.size();
        return std::move(*maximum_);
    }

  private:
    /// Plans moments of the frame. Returns false if one doesn't fit.
    bool plan(const FramesToPlan& found, size_t index) {
        const int frame = found.changed[index];
        const int at_once = samples_at_once(scene_, frame);
        for (const double moment : some_moments_of(scene_, frame))
            if (!plan(found, index, moment, at_once)) return false;
        return true;
    }

    /// Plans a moment of the frame unless its plan equals that of the moment before. Returns false
    /// if it doesn't fit.
    bool plan(const FramesToPlan& found, size_t index, double moment, int at_once) {
        Scene now = in_frame(scene_, moment, [&] { return scene_at(scene_, moment); });
        take_at_once(at_once, now.render);
        if (before_ && is_planned_like(*before_, now)) return true;
        FramePlan planned = in_frame(scene_, moment, [&] {
            FramePlan made{found.changed[index], std::move(now), {}};
            check_placements(made.scene);
            made.plan = plan_scene(made.scene, meshes_, device_, solids_);
            return made;
        });
        planned.plans = ++plans_;
        meshes_.forget_unused();
        before_ = planned.scene;
        if (is_refused(planned, device_)) {
            refused_ = std::move(planned);
            return false;
        }
        if (!maximum_ || bytes_of(planned.plan) > bytes_of(maximum_->plan)) {
            maximum_ = std::move(planned);
            max_index_ = index;
        }
        return true;
    }

    double bytes_of(const ScenePlan& plan) const {
        return plan.run_bytes(worlds_, double(device_.memory));
    }

    /// Plans a frame that wasn't chosen. Returns false if it doesn't fit.
    bool plan_new(const FramesToPlan& found, size_t index) {
        if (std::ranges::binary_search(found.chosen, index)) return true;
        return plan(found, index);
    }

    /// Searches around the frame with the maximum for a larger one between the chosen frames.
    bool climb(const FramesToPlan& found) {
        for (size_t step = found.step / 2; step > 0; step /= 2) {
            const size_t middle = max_index_;
            if (middle >= step && !plan_new(found, middle - step)) return false;
            if (middle + step < found.changed.size() && !plan_new(found, middle + step))
                return false;
        }
        return true;
    }

    const Scene& scene_;
    AssetStore& meshes_;
    const DeviceInfo& device_;
    size_t worlds_;
    SolidExtents solids_;
    std::optional<Scene> before_;
    std::optional<FramePlan> maximum_, refused_;
    size_t max_index_ = 0;  ///< index of the maximum among the frames that change
    int plans_ = 0;
};

}  // namespace

bool is_refused(const FramePlan& planned, const DeviceInfo& device) {
    try {
        check_memory(planned.scene, planned.plan, device);
    } catch (const Error&) {
        return true;
    }
    return false;
}

FramePlan plan_frames(const Scene& scene, std::span<const int> frames, AssetStore& meshes,
                      const DeviceInfo& device, const std::function<void(size_t)>& progress) {
    return FramePlanner(scene, meshes, device, frames.size()).run(frames, progress);
}

void check_frames(const Scene& scene, std::span<const int> frames, AssetStore& meshes,
                  const DeviceInfo& device) {
    std::optional<Scene> first, before;
    SolidExtents solids;
    const FramesToPlan found = frames_to_plan(scene, frames);
    const auto check = [&](double moment, int at_once) {
        Scene now = scene_at(scene, moment);
        take_at_once(at_once, now.render);
        if (before && is_planned_like(*before, now)) return;
        check_placements(now);
        if (!first) first = now;
        if (has_files_of(now, *first)) {
            check_memory(now, plan_scene(now, meshes, device, solids), device);
            forget_largest(now, device, meshes);
        }
        before = std::move(now);
    };
    for (const size_t index : found.chosen) {
        const int frame = found.changed[index], at_once = samples_at_once(scene, frame);
        for (const double moment : some_moments_of(scene, frame))
            in_frame(scene, moment, [&] { check(moment, at_once); });
    }
}

}  // namespace voxelume
