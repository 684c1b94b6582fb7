#include <fmt/format.h>

#include <cmath>

#include "cli/report.hpp"
#include "cli/scene_options.hpp"
#include "runtime/analysis/culling.hpp"
#include "runtime/memory/frame_plans.hpp"
#include "runtime/scene_file/scene_animation.hpp"

namespace voxelume::cli {
namespace {

/// Three digits are what an estimate is good for.
double three_digits(double value) {
    return std::stod(fmt::format("{:.3g}", value));
}

double megabytes(double bytes) {
    return three_digits(bytes / 1e6);
}

uint64_t count(double estimate) {
    return uint64_t(std::llround(estimate));
}

Report grid_row(const Scene& scene, const GridPlan& grid) {
    const std::string& name = grid.object < 0 ? scene.models[size_t(grid.model)].name
                                              : scene.objects[size_t(grid.object)].name;
    return {{"grid", fmt::format("{} {}", grid.object < 0 ? "model" : "object", name)},
            {"voxels", size_text(grid.frame.size)},
            {"triangles", grid.triangles},
            {"surface voxels", count(grid.voxels)},
            {"bricks", count(grid.bricks)},
            {"MB while made", megabytes(grid.made_bytes)},
            {"MB kept", megabytes(grid.kept_bytes)}};
}

Report plan_report(const Scene& scene, const ScenePlan& plan, const Device& device) {
    Report report;
    report["grids"] = Report::array();
    for (const GridPlan& grid : plan.grids) report["grids"].push_back(grid_row(scene, grid));
    report["grids"].push_back({{"grid", "world"},
                               {"voxels", size_text(plan.world.size)},
                               {"triangles", nullptr},
                               {"surface voxels", count(plan.voxels)},
                               {"bricks", count(plan.bricks)},
                               {"MB while made", megabytes(plan.index_bytes)},
                               {"MB kept", megabytes(plan.world_bytes)}});
    report["device"] = device.info().name;
    report["stages"] = Report::array();
    const auto add = [&](const char* stage, double bytes) {
        report["stages"].push_back(
            {{"stage", stage},
             {"MB", megabytes(bytes)},
             {"% of device", three_digits(bytes / double(device.info().memory) * 100)}});
    };
    add("voxelize", plan.voxelize_bytes);
    add("place", plan.place_bytes);
    add("index", plan.index_bytes);
    add("image", plan.image_bytes);
    BufferPlan largest = plan.largest;
    for (const GridPlan& grid : plan.grids) keep_larger(largest, grid.largest);
    report["largest buffer"] = bytes_text(largest.bytes);
    report["main memory"] = bytes_text(plan.host_bytes);
    return report;
}

/// What the text ends with, for programs.
void add_verdict(const FramePlan& planned, size_t frames, const DeviceInfo& device,
                 Report& report) {
    const double memory = double(device.memory), peak = planned.plan.run_bytes(frames, memory);
    report["verdict"] = is_refused(planned, device) ? "doesn't fit"
                        : peak <= memory            ? "fits"
                                                    : "may fit";
    report["volume MB"] = megabytes(planned.plan.volume_bytes);
    report["least MB"] = megabytes(planned.plan.min_bytes);
    report["most MB"] = megabytes(peak);
    report["device MB"] = megabytes(memory);
}

}  // namespace

void print_plan(Scene scene, std::span<const int> frames, const Device& device,
                const ModelCache& cache, bool as_json) {
    check_tables(scene, device.info());
    AssetStore meshes(cache);
    find_potentially_visible(scene, frames, meshes);
    const FramePlan planned = plan_frames(scene, frames, meshes, device.info());
    if (!as_json) fmt::print("{}\n", describe(scene));
    Report report = plan_report(planned.scene, planned.plan, device);
    if (moves(scene)) report["frame"] = planned.frame;
    if (as_json) add_verdict(planned, frames.size(), device.info(), report);
    print_report(report, as_json);
    in_frame(scene, planned.frame,
             [&] { check_memory(planned.scene, planned.plan, device.info()); });
    if (as_json) return;
    const std::string of_frames =
        frames.size() > 1 ? fmt::format(" by frame {}", planned.frame) : "";
    const double memory = double(device.info().memory),
                 peak = planned.plan.run_bytes(frames.size(), memory);
    const std::string needed =
        peak <= memory ? fmt::format("fits: at most {}", bytes_text(peak))
                       : fmt::format("may fit: {} to {}", bytes_text(planned.plan.min_bytes),
                                     bytes_text(peak));
    fmt::print("\n{} of {} are needed{}; counts and memory are estimates\n", needed,
               bytes_text(memory), of_frames);
}

}  // namespace voxelume::cli
