// SPDX-License-Identifier: Apache-2.0
// What a scene takes, for callers.
#include "runtime/voxelume/plan.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>

#include "runtime/analysis/culling.hpp"
#include "runtime/analysis/scene_choices.hpp"
#include "runtime/analysis/warnings/scene_warnings.hpp"
#include "runtime/api/border/convert.hpp"
#include "runtime/api/border/guarded.hpp"
#include "runtime/api/border/handles.hpp"
#include "runtime/api/border/process.hpp"
#include "runtime/api/render.hpp"
#include "runtime/api/warning.hpp"
#include "runtime/assets/model_frame.hpp"
#include "runtime/base/main_memory.hpp"
#include "runtime/memory/frame_plans.hpp"
#include "runtime/memory/image_bands.hpp"
#include "runtime/opencl/self_test/device_facts.hpp"
#include "runtime/scene/predicates.hpp"
#include "runtime/scene/scene_animation.hpp"
#include "runtime/scene/shutter.hpp"

namespace voxelume {
namespace {

std::vector<int> frames_of(const Scene& scene, const std::vector<int>& frames) {
    if (!frames.empty()) return frames;
    std::vector<int> all(moves(scene) ? size_t(scene.animation.frames) : 1);
    std::iota(all.begin(), all.end(), 1);
    return all;
}

size_t instances_of(const Scene& scene, int model) {
    return size_t(std::ranges::count_if(scene.objects, [&](const Object& object) {
        return object.model == model && is_potentially_visible(scene, object) &&
               is_instanced(scene, object);
    }));
}

v1::GridPlan grid_for_callers(const Scene& scene, const GridPlan& grid) {
    const std::string& name = grid.object < 0 ? scene.models[size_t(grid.model)].name
                                              : scene.objects[size_t(grid.object)].name;
    return {fmt::format("{} {}", grid.object < 0 ? "model" : "object", name),
            api::array_of(grid.frame.size),
            grid.triangles,
            grid.voxels,
            grid.bricks,
            grid.made_bytes,
            grid.kept_bytes,
            api::array_of(grid.frame.voxel_edge),
            grid.object < 0 ? instances_of(scene, grid.model) : 0};
}

/// The error that says why the frame doesn't fit; empty if it fits.
std::optional<v1::Error> refusal_of(const Scene& scene, const FramePlan& planned,
                                    const DeviceInfo& device) {
    try {
        in_frame(scene, planned.frame, [&] { check_memory(planned.scene, planned.plan, device); });
    } catch (const Error& error) {
        return api::error_for_callers(error);
    }
    return {};
}

v1::Plan plan_for_callers(const Scene& scene, const FramePlan& planned, size_t frames,
                          const DeviceInfo& device) {
    const ScenePlan& plan = planned.plan;
    v1::Plan result;
    result.refusal = refusal_of(scene, planned, device);
    result.frame = planned.frame;
    result.chosen_frames = planned.is_of_all ? 0 : planned.plans;
    result.min_bytes = plan.min_bytes;
    result.max_bytes = plan.run_bytes(worlds_of(scene, frames), double(device.memory));
    result.device_bytes = double(device.memory);
    result.verdict = result.refusal                            ? v1::Verdict::does_not_fit
                     : result.max_bytes <= result.device_bytes ? v1::Verdict::fits
                                                               : v1::Verdict::may_fit;
    BufferPlan largest = plan.largest;
    for (const GridPlan& grid : plan.grids) {
        result.grids.push_back(grid_for_callers(planned.scene, grid));
        keep_larger(largest, grid.largest);
    }
    result.grids.push_back({"world",
                            api::array_of(plan.world.size),
                            {},
                            plan.voxels,
                            plan.bricks,
                            plan.index_bytes,
                            plan.world_bytes,
                            api::array_of(planned.scene.world.voxel_size)});
    result.largest_buffer_bytes = largest.bytes;
    result.host_bytes = plan.host_bytes;
    result.process_bytes = process_bytes(planned.scene, plan, result.max_bytes, device);
    for (const Model& model : planned.scene.models)
        if (!model.surface_reason.empty())
            result.surfaces.push_back(
                {model.name, std::string(kind_of(model.surface).name), model.surface_reason});
    result.stages = {{"voxelize", plan.voxelize_bytes},
                     {"place", plan.place_bytes},
                     {"index", plan.index_bytes},
                     {"image", plan.image_bytes},
                     {"volume", plan.volume_bytes}};
    return result;
}

/// The bands that files are written in.
ImageBands planned_bands(const Scene& scene, std::span<const int> frames, AssetStore& meshes,
                         const DeviceInfo& device) {
    const ImageBands bands = bands_that_fit(scene, frames, meshes, device);
    const std::optional<NeedOfWhole> need = need_of_whole(scene.render);
    if (bands.are_one() || !need) return bands;
    if (bands.are_needed) refuse_bands(scene, device, *need);
    return {scene.render.size.y, 1};
}

v1::Plan plan_on(const v1::Scene& scene, const DeviceInfo& device, const v1::PlanOptions& options) {
    Scene planned = api::inside(scene);
    planned.render.channels = api::inside(options.channels);
    planned.render.shows_image = options.image || !options.volume;
    planned.render.shows_volume = options.volume;
    const std::vector<int> frames = frames_of(planned, options.frames);
    check_tables(planned, device);
    AssetStore meshes = api::assets_of(scene, options.cache);
    make_choices(planned, meshes);
    const std::vector<Warning> warnings = scene_warnings(planned, frames, meshes);
    find_potentially_visible(planned, frames, meshes);
    uint64_t kept = 0;
    if (const std::optional<v1::Quilt>& quilt = options.quilt) {
        for (const int frame : frames) api::check_quilt(planned, *quilt, frame);
        kept = bytes_of_views(planned, quilt->columns * quilt->rows);
    }
    const MainMemoryClaim claim(kept);
    const ImageBands bands = options.quilt ? ImageBands{planned.render.size.y, 1}
                                           : planned_bands(planned, frames, meshes, device);
    planned = band_of(planned, bands, 0);
    const auto progress = [&](size_t done) { options.progress(done, frames.size()); };
    v1::Plan result =
        plan_for_callers(planned,
                         plan_frames(planned, frames, meshes, device,
                                     options.progress ? std::function<void(size_t)>(progress)
                                                      : std::function<void(size_t)>()),
                         frames.size(), device);
    result.views_bytes = double(kept);
    result.host_bytes += double(kept);
    result.process_bytes += double(kept);
    result.device = device.name;
    result.bands = bands.count;
    result.band_rows = bands.rows;
    result.warnings = api::warnings_for_callers(warnings);
    return result;
}

}  // namespace

namespace v1 {

const char* name_of(Verdict verdict) {
    return verdict == Verdict::fits      ? "fits"
           : verdict == Verdict::may_fit ? "may fit"
                                         : "doesn't fit";
}

Plan plan(const Scene& scene, const Device& device, const PlanOptions& options) {
    return api::guarded([&] { return plan_on(scene, api::inside(device).info(), options); });
}

Plan plan(const Scene& scene, std::string_view selector, const PlanOptions& options) {
    return api::guarded([&] {
        api::apply_process_options();
        return plan_on(scene, device_for_plans(selector), options);
    });
}

std::string bytes_text(double bytes) {
    return voxelume::bytes_text(bytes);
}

}  // namespace v1
}  // namespace voxelume
