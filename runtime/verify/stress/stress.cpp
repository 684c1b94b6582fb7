// SPDX-License-Identifier: Apache-2.0
#include "runtime/verify/stress/stress.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <thread>

#include "runtime/verify/stress/stress_leaks.hpp"
#include "runtime/verify/stress/stress_placement.hpp"
#include "runtime/verify/stress/stress_rays.hpp"
#include "runtime/verify/stress/stress_snapping.hpp"
#include "runtime/verify/stress/stress_triangles.hpp"

namespace voxelume {
namespace {

struct Leaks {
    const char* name;
    const char* help;
    Surface surface;
    VoxelSet set;
};

constexpr std::array kLeaks = {
    Leaks{"smooth", "rays into rings' smooth surfaces, alone and along beams", Surface::smooth,
          VoxelSet::supercover},
    Leaks{"exact", "the same into rings of triangles", Surface::exact, VoxelSet::supercover},
    Leaks{"thin", "the same into rings' thin shells of cubes", Surface::cubes, VoxelSet::thin},
    Leaks{"solid", "the same into solid rings of cubes", Surface::cubes, VoxelSet::solid},
};

}  // namespace

const std::vector<StressTest>& stress_tests() {
    static const std::vector<StressTest> tests = [] {
        std::vector<StressTest> all;
        all.reserve(kRayClasses.size() + kLeaks.size() + 5);
        for (const RayClassName& named : kRayClasses)
            all.push_back({named.name, named.help, 1, [kind = named.kind](const StressRun& run) {
                               return stress_rays(kind, run);
                           }});
        all.push_back({"far", "rays from up to 10^7 voxels away, snapped and walked", 1,
                       [](const StressRun& run) { return stress_snapping(SnapClass::far, run); }});
        all.push_back(
            {"denormal", "rays of denormal, huge and zero components", 1,
             [](const StressRun& run) { return stress_snapping(SnapClass::denormal, run); }});
        for (const Leaks& leaks : kLeaks)
            all.push_back({leaks.name, leaks.help, 1, [leaks](const StressRun& run) {
                               return stress_leaks({leaks.surface, leaks.set}, run);
                           }});
        all.push_back(
            {"triangles", "voxels of triangles of ten nasty classes", 80,
             [](const StressRun& run) { return stress_triangles(VoxelSet::supercover, run); }});
        all.push_back({"crosshairs", "thin voxels of the same triangles", 80,
                       [](const StressRun& run) { return stress_triangles(VoxelSet::thin, run); }});
        all.push_back(
            {"placement", "voxels of a lump placed by affine maps", 20000, stress_placement});
        return all;
    }();
    return tests;
}

void for_each_in_parallel(uint64_t count, const std::function<void(uint64_t)>& work) {
    std::atomic<uint64_t> next{0};
    const auto take = [&] {
        for (uint64_t i = next++; i < count; i = next++) work(i);
    };
    const uint64_t maximum = std::max(1u, std::thread::hardware_concurrency());
    std::vector<std::jthread> helpers;
    for (uint64_t i = 1; i < std::min(maximum, count); ++i) helpers.emplace_back(take);
    take();
}

}  // namespace voxelume
