// SPDX-License-Identifier: Apache-2.0
#include "runtime/memory/frame_plans.hpp"

#include <algorithm>
#include <optional>

#include "runtime/analysis/model_last_uses.hpp"
#include "runtime/analysis/scene_features.hpp"
#include "runtime/base/error.hpp"
#include "runtime/scene/predicates.hpp"
#include "runtime/scene/scene_animation.hpp"

namespace voxelume {
namespace {

/// True if both frames have the same plan, as nothing changed that it depends on. It depends on
/// whether lights shine, but not on their other values. It depends on the observer only in images
/// without colour, whose rays are followed through surfaces that he may be behind.
bool is_planned_like(const Scene& a, const Scene& b) {
    return (a.render.channels.color || a.observer == b.observer) && a.objects == b.objects &&
           a.models == b.models && a.materials == b.materials &&
           std::ranges::equal(a.lights, b.lights, {}, shines, shines) &&
           a.world.medium == b.world.medium;
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

FramePlan plan_frame(const Scene& scene, int frame, Scene now, AssetStore& meshes,
                     const DeviceInfo& device, SolidExtents& solids) {
    return in_frame(scene, frame, [&] {
        FramePlan planned{frame, std::move(now), {}};
        check_placements(planned.scene);
        planned.plan = plan_scene(planned.scene, meshes, device, solids);
        return planned;
    });
}

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
    std::optional<FramePlan> maximum;
    std::optional<Scene> before;
    SolidExtents solids;
    int plans = 0;
    for (size_t i = 0; i < frames.size(); ++i) {
        if (progress) progress(i);
        const int frame = frames[i];
        Scene now = in_frame(scene, frame, [&] { return scene_at(scene, frame); });
        if (before && is_planned_like(*before, now)) continue;
        FramePlan planned = plan_frame(scene, frame, std::move(now), meshes, device, solids);
        planned.plans = ++plans;
        meshes.forget_unused();
        before = planned.scene;
        if (is_refused(planned, device)) return planned;
        if (!maximum || planned.plan.peak_bytes() > maximum->plan.peak_bytes())
            maximum = std::move(planned);
    }
    maximum->plans = plans;
    return std::move(*maximum);
}

void check_frames(const Scene& scene, std::span<const int> frames, AssetStore& meshes,
                  const DeviceInfo& device) {
    std::optional<Scene> first, before;
    SolidExtents solids;
    for (const int frame : frames)
        in_frame(scene, frame, [&] {
            Scene now = scene_at(scene, frame);
            if (before && is_planned_like(*before, now)) return;
            check_placements(now);
            if (!first) first = now;
            if (has_files_of(now, *first)) {
                check_memory(now, plan_scene(now, meshes, device, solids), device);
                forget_largest(now, device, meshes);
            }
            before = std::move(now);
        });
}

}  // namespace voxelume
