// SPDX-License-Identifier: Apache-2.0
#include "runtime/verify/stress/stress_snapping.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "runtime/verify/stress/device_walks.hpp"
#include "runtime/verify/stress/stress_random.hpp"
#include "runtime/verify/stress/stress_rays.hpp"

namespace voxelume {
namespace {

constexpr size_t kSnapBatch = 1u << 14;
constexpr uint32_t kMaxCells = 300;

constexpr std::array kSizes = {glm::ivec3(64, 61, 37), glm::ivec3(1000, 300, 700),
                               glm::ivec3(7, 5, 3), glm::ivec3(16384, 16384, 16384),
                               glm::ivec3(65536, 40000, 65536)};

FixedGrid grid_of_batch(uint64_t first) {
    return fixed_grid(kSizes[first / kSnapBatch % kSizes.size()]);
}

/// A ray towards a point of the grid, or past it.
FloatRay from_far(const FixedGrid& grid, StressRandom& random) {
    const double way = std::pow(10.0, random.uniform(0, 7));
    FloatRay ray;
    for (int a = 0; a < 3; ++a) {
        const double target = random.uniform(-0.1, 1.1) * grid.size[a];
        const double direction = random.uniform(-1, 1);
        ray.origin[a] = float(target - direction * way);
        ray.direction[a] = float(direction);
    }
    if (random.below(4) == 0) {  // the ray lies in a plane across an axis
        const int axis = int(random.below(3));
        ray.direction[axis] = 0;
        ray.origin[axis] = float(random.between(0, grid.size[axis]));
    }
    if (ray.direction == glm::vec3(0)) ray.direction.x = 1;
    return ray;
}

float odd_component(StressRandom& random) {
    constexpr std::array<float, 10> kOdd = {0.0f,    -0.0f,  1e-45f, -1e-45f, 1e-38f,
                                            -1e-30f, 1e-30f, 1e-7f,  -1e-6f,  0.5f};
    return kOdd[random.below(kOdd.size())];
}

FloatRay of_odd_numbers(const FixedGrid& grid, StressRandom& random) {
    FloatRay ray;
    for (int a = 0; a < 3; ++a) {
        ray.origin[a] = random.below(2)
                            ? float(random.uniform(0, grid.size[a]))
                            : float(random.between(0, 1) * grid.size[a]) + odd_component(random);
        if (random.below(8) == 0) ray.origin[a] = odd_component(random);
        ray.direction[a] = odd_component(random);
    }
    ray.direction[int(random.below(3))] = float(random.sign() * random.uniform(0.5, 2));
    const int power = int(random.between(-100, 100));
    for (int a = 0; a < 3; ++a) ray.direction[a] = std::ldexp(ray.direction[a], power);
    return ray;
}

std::string text_of(const FloatRay& ray) {
    return fmt::format("origin ({:a},{:a},{:a}), direction ({:a},{:a},{:a})", ray.origin.x,
                       ray.origin.y, ray.origin.z, ray.direction.x, ray.direction.y,
                       ray.direction.z);
}

/// Compares a batch's snapped rays, and the walks of those that are not idle.
void try_batch(DeviceWalks& walks, SnapClass kind, uint64_t seed, const StressBatch& batch,
               StressResult& result) {
    const FixedGrid grid = grid_of_batch(batch.start);
    std::vector<FloatRay> rays;
    rays.reserve(batch.size);
    for (size_t i = 0; i < batch.size; ++i)
        rays.push_back(float_ray(kind, grid, seed, batch.start + i));
    const std::vector<std::optional<FixedRay>> snapped = walks.snap(grid, rays);
    std::vector<FixedRay> walked;
    std::vector<size_t> source;
    const auto is_compared = [&](size_t i) { return i >= batch.first && i < batch.end; };
    for (size_t i = 0; i < batch.size; ++i) {
        const std::string fault = snap_fault(grid, rays[i], snapped[i] ? &*snapped[i] : nullptr);
        if (!fault.empty() && is_compared(i))
            note_mismatch(result, batch.start + i, [&] { return text_of(rays[i]) + ": " + fault; });
        if (!fault.empty() || !snapped[i]) continue;
        walked.push_back(*snapped[i]);
        source.push_back(i);
    }
    result.cases += batch.end - batch.first;
    if (walked.empty()) return;
    walks.start(grid, walked, Steps::cells, kMaxCells);
    const std::vector<WalkDigest> device = walks.digests();
    for (size_t i = 0; i < walked.size(); ++i) {
        if (!is_compared(source[i])) continue;
        const WalkDigest exact = exact_digest(grid, walked[i], Steps::cells, kMaxCells);
        result.cells += exact.cells;
        if (device[i] != exact)
            note_mismatch(result, batch.start + source[i], [&] {
                return fmt::format("{}: {}: {} cells, exact are {}", text_of(rays[source[i]]),
                                   describe(grid, walked[i]), device[i].cells, exact.cells);
            });
    }
}

}  // namespace

FloatRay float_ray(SnapClass kind, const FixedGrid& grid, uint64_t seed, uint64_t number) {
    StressRandom random(seed, 400 + uint64_t(kind), number);
    return kind == SnapClass::far ? from_far(grid, random) : of_odd_numbers(grid, random);
}

StressResult stress_snapping(SnapClass kind, const StressRun& run) {
    DeviceWalks walks(run.device);
    StressResult result;
    for_each_batch(run, kSnapBatch, [&](const StressBatch& batch) {
        try_batch(walks, kind, run.seed, batch, result);
    });
    return result;
}

}  // namespace voxelume
