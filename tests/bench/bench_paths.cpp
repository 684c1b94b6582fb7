// SPDX-License-Identifier: Apache-2.0
// Secondary rays a second in a scene's frame, and what compaction of their queues is worth.
//
//   bench_paths [--compacted] SCENE [asset folder ...]
//
// The frame is the scene's flat image, with shadows and all; its world is formed before. Times are
// the process's CPU time over all threads, medians of five runs, with and without compaction in
// turn, or with it only; tracing's part of it is that of the kernel's time in one more run.
#include <fmt/format.h>

#include <algorithm>
#include <string_view>
#include <vector>

#include "runtime/render/illumination.hpp"
#include "runtime/scene_file/read_scene.hpp"
#include "runtime/stages/resolve/resolve.hpp"
#include "runtime/stages/trace/sight.hpp"
#include "runtime/world/world.hpp"
#include "tests/bench/cpu_time.hpp"

namespace voxelume {
namespace {

constexpr int kRuns = 5;

/// A scene's frame that is rendered repeatedly.
class Frame {
  public:
    Frame(const Device& device, const Scene& scene, const Pyramid& world, bool compact)
        : device_(device),
          world_(world),
          features_(features_of(scene, world)),
          observer_(camera_of(scene, world.frame)),
          tiles_(tile_count(observer_.width, observer_.height)),
          batch_tiles_(std::clamp(
              batch_rays(device, features_) / (16 * uint32_t(observer_.samples)), 1u, tiles_)),
          batch_(
              allocate_batch(device, features_, batch_tiles_ * 16 * uint32_t(observer_.samples))),
          sight_(device, features_, observer_),
          illumination_(device, features_, scene, world, batch_.stride, compact) {}

    /// CPU seconds of one frame.
    double render() {
        const double start = cpu_seconds();
        const uint64_t before = illumination_.secondary_rays();
        for (uint32_t first = 0; first < tiles_; first += batch_tiles_) {
            const uint32_t rays = sight_.cast(shape_of(world_), first,
                                              std::min(batch_tiles_, tiles_ - first), batch_);
            illumination_.light(batch_, rays);
        }
        device_.finish();
        rays_ = illumination_.secondary_rays() - before;
        return cpu_seconds() - start;
    }

    /// The fraction of a frame's time in kernels that tracing the secondary rays takes.
    double tracing_part() {
        device_.time_kernels(true);
        const auto before = device_.counters().kernel_ms;
        render();
        device_.time_kernels(false);
        double all = 0, tracing = 0;
        for (const auto& [name, ms] : device_.counters().kernel_ms) {
            const auto old = before.find(name);
            const double spent = ms - (old == before.end() ? 0 : old->second);
            all += spent;
            if (name == "trace_scattered") tracing += spent;
        }
        return tracing / all;
    }

    /// The secondary rays of the last frame. Without compaction, slots without a ray count, too.
    uint64_t secondary_rays() const { return rays_; }

  private:
    Device device_;
    const Pyramid& world_;
    Features features_;
    Camera observer_;
    uint32_t tiles_, batch_tiles_;
    RayBatch batch_;
    SightStage sight_;
    Illumination illumination_;
    uint64_t rays_ = 0;
};

double median(std::vector<double> values) {
    std::ranges::sort(values);
    return values[values.size() / 2];
}

void measure(const Scene& scene, bool compacted_only) {
    const Device device = Device::open("cpu");
    WorldReport report;
    const Pyramid world = build_world(device, scene, report);
    Frame compact(device, scene, world, true), sparse(device, scene, world, false);
    compact.render();
    if (!compacted_only) sparse.render();
    std::vector<double> with, without;
    for (int run = 0; run < kRuns; ++run) {
        with.push_back(compact.render());
        if (!compacted_only) without.push_back(sparse.render());
    }
    const double time = median(with);
    fmt::print("{} lanes, {} voxels, {} secondary rays\n", device.lanes(), world.voxel_count,
               compact.secondary_rays());
    fmt::print("compacted {:.3f} s, {:.2f} million secondary rays a second and core\n", time,
               double(compact.secondary_rays()) / time / 1e6);
    const double part = compact.tracing_part();
    fmt::print("tracing   {:.3f} s, {:.2f} million secondary rays a second and core\n", part * time,
               double(compact.secondary_rays()) / (part * time) / 1e6);
    if (compacted_only) return;
    const double sparse_time = median(without);
    fmt::print("sparse    {:.3f} s, {:.2f} times as long\n", sparse_time, sparse_time / time);
}

}  // namespace
}  // namespace voxelume

int main(int argc, char** argv) {
    const bool compacted_only = argc > 1 && std::string_view(argv[1]) == "--compacted";
    const int first = compacted_only ? 2 : 1;
    if (argc <= first) {
        fmt::print(stderr, "usage: bench_paths [--compacted] SCENE [asset folder ...]\n");
        return 2;
    }
    voxelume::measure(voxelume::read_scene(argv[first], {argv + first + 1, argv + argc}),
                      compacted_only);
}
