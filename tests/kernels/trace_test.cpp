// SPDX-License-Identifier: Apache-2.0
#include "runtime/stages/trace/trace.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <random>

#include "kernels/shared/voxel.h"
#include "runtime/stages/index/index.hpp"
#include "tests/oracles/cell_walk.hpp"
#include "tests/support/test_device.hpp"

namespace voxelume {
namespace {

constexpr uint32_t kRays = 4096;

/// A ray in fixed point as in shared/trace.h: exact integers for any size of the grid.
struct SnappedRay {
    glm::dvec3 origin, direction;
};

/// A grid of cubes at the given voxels.
BrickGrid cubes_at(const Device& device, glm::ivec3 size, const std::vector<glm::ivec3>& voxels) {
    BrickGrid grid;
    grid.frame.size = size;
    const glm::ivec3 bricks = grid.frame.bricks();
    std::map<uint32_t, std::vector<uint64_t>> stored;
    for (const glm::ivec3& v : voxels) {
        const uint32_t brick = uint32_t(v.x / 16 + bricks.x * (v.y / 16 + bricks.y * (v.z / 16)));
        auto& masks = stored.try_emplace(brick, 64, 0).first->second;
        const int leaf = (v.x / 4 % 4) + 4 * (v.y / 4 % 4) + 16 * (v.z / 4 % 4);
        masks[size_t(leaf)] |= uint64_t(1) << ((v.x % 4) + 4 * (v.y % 4) + 16 * (v.z % 4));
    }
    std::vector<uint32_t> slots(size_t(bricks.x * bricks.y * bricks.z), kBrickOutside), coordinates;
    std::vector<uint64_t> occupancy;
    for (const auto& [brick, masks] : stored) {
        slots[brick] = uint32_t(coordinates.size());
        coordinates.push_back(brick);
        occupancy.insert(occupancy.end(), masks.begin(), masks.end());
    }
    grid.brick_count = uint32_t(coordinates.size());
    grid.slots = Buffer<uint32_t>(device, "slots", std::span<const uint32_t>(slots));
    grid.coordinates =
        Buffer<uint32_t>(device, "coordinates", std::span<const uint32_t>(coordinates));
    grid.occupancy = Buffer<uint64_t>(device, "occupancy", std::span<const uint64_t>(occupancy));
    return grid;
}

struct TracedHit {
    bool hit;
    float t;
    glm::ivec3 cell;
    int axis;
};

/// Traces rays on a device with the given number of lanes.
std::vector<TracedHit> trace(const Device& device, const Pyramid& pyramid,
                             const std::vector<SnappedRay>& rays) {
    const uint32_t count = uint32_t(rays.size()), stride = (count + 15) / 16 * 16;
    std::vector<float> values(size_t(stride) * VXL_RAY_COMPONENTS, 0.0f);
    for (uint32_t i = 0; i < stride; ++i) values[VXL_RAY_END * stride + i] = -1;
    for (uint32_t i = 0; i < count; ++i) {
        for (uint32_t a = 0; a < 3; ++a) {
            values[(VXL_RAY_OX + a) * stride + i] = float(rays[i].origin[int(a)]);
            values[(VXL_RAY_DX + a) * stride + i] = float(rays[i].direction[int(a)]);
        }
        values[VXL_RAY_END * stride + i] = INFINITY;
    }
    RayBatch batch;
    batch.stride = stride;
    batch.rays = Buffer<float>(device, "rays", std::span<const float>(values));
    batch.hits = Buffer<uint32_t>(device, "hits", size_t(stride) * VXL_HIT_COMPONENTS);
    TraceStage stage(device, features_of(pyramid));
    stage.closest(pyramid, batch, count);
    const std::vector<uint32_t> words = batch.hits.read();
    std::vector<TracedHit> hits;
    for (uint32_t i = 0; i < count; ++i) {
        const uint32_t xy = words[VXL_HIT_CELL * stride + i], za = words[VXL_HIT_FACE * stride + i];
        float t;
        std::memcpy(&t, &words[VXL_HIT_T * stride + i], sizeof t);
        hits.push_back({words[VXL_HIT_VOXEL * stride + i] != VXL_NO_VOXEL,
                        t,
                        {int(xy & 0xFFFF), int(xy >> 16), int(za & 0xFFFF)},
                        int(za >> 16)});
    }
    return hits;
}

/// Rays through a grid: random ones, ones between lattice points (ties), and nearly parallel ones.
std::vector<SnappedRay> difficult_rays(glm::ivec3 size, int fraction_bits, uint32_t seed) {
    std::mt19937 random(seed);
    const double unit = std::ldexp(1.0, -fraction_bits),
                 step = std::ldexp(1.0, -VXL_DIRECTION_BITS);
    auto uniform = [&](double limit) { return limit * double(random()) / 4294967296.0; };
    std::vector<SnappedRay> rays;
    while (rays.size() < kRays) {
        SnappedRay ray;
        const int kind = int(rays.size() % 4);
        for (int a = 0; a < 3; ++a) {
            ray.origin[a] = std::round(uniform(size[a]) / unit) * unit;
            ray.direction[a] = std::round((uniform(2) - 1) / step) * step;
        }
        if (kind == 1) {  // from one half-integer lattice point to another
            for (int a = 0; a < 3; ++a) {
                ray.origin[a] = double(random() % uint32_t(2 * size[a] + 1)) / 2;
                ray.direction[a] = double(int(random() % 33) - 16) / 32;
            }
        }
        if (kind == 2) ray.direction[int(random() % 3)] = step * double(int(random() % 5) - 2);
        if (kind == 3) {  // along a diagonal, off by single units
            const double sign = random() % 2 ? 1 : -1;
            for (int a = 0; a < 3; ++a) ray.direction[a] = sign * (1 - step * double(random() % 3));
        }
        const double largest = std::max(
            {std::abs(ray.direction.x), std::abs(ray.direction.y), std::abs(ray.direction.z)});
        if (largest >= 0.5) rays.push_back(ray);
    }
    return rays;
}

class TraceLanes : public testing::TestWithParam<int> {};

TEST_P(TraceLanes, FindsTheCellThatExactArithmeticFinds) {
    const Device device = test_device(GetParam());
    const glm::ivec3 size(70, 37, 130);
    const uint32_t seed = 20261121;
    std::mt19937 random(seed);
    std::vector<glm::ivec3> voxels;
    for (int i = 0; i < 1500; ++i)
        voxels.push_back({int(random() % 70), int(random() % 37), int(random() % 130)});
    const BrickGrid grid = cubes_at(device, size, voxels);
    const Pyramid pyramid = build_index(device, grid);
    const int fraction_bits = int(std::log2(shape_of(pyramid).fixed_point));
    oracle::VoxelSet set(voxels.begin(), voxels.end());

    const std::vector<SnappedRay> rays = difficult_rays(size, fraction_bits, seed);
    const std::vector<TracedHit> hits = trace(device, pyramid, rays);
    for (size_t i = 0; i < rays.size(); ++i) {
        const oracle::FirstHit expected =
            oracle::first_hit(rays[i].origin, rays[i].direction, size, fraction_bits, set);
        ASSERT_EQ(hits[i].hit, expected.hit) << "seed " << seed << " ray " << i;
        if (!expected.hit) continue;
        EXPECT_EQ(hits[i].cell, expected.cell) << "seed " << seed << " ray " << i;
        EXPECT_EQ(hits[i].axis, expected.axis) << "seed " << seed << " ray " << i;
        EXPECT_NEAR(hits[i].t, expected.t, 4e-7 * expected.t) << "seed " << seed << " ray " << i;
    }
}

INSTANTIATE_TEST_SUITE_P(Lanes, TraceLanes, testing::Values(1, 4, 8, 16));

TEST(Trace, TakesTiesLowestAxisFirst) {
    // T3 of the stress cases: the ray goes from the corner along the diagonal,
    // (000)(100)(110)(111)...
    const Device device = test_device();
    const std::vector<SnappedRay> diagonal = {{{0, 0, 0}, {1, 1, 1}}};
    const auto first = [&](std::vector<glm::ivec3> voxels) {
        return trace(device, build_index(device, cubes_at(device, {4, 4, 4}, voxels)), diagonal)[0];
    };
    EXPECT_TRUE(first({{1, 0, 0}}).hit);
    EXPECT_TRUE(first({{1, 1, 0}}).hit);
    EXPECT_FALSE(first({{0, 1, 0}}).hit);
    EXPECT_FALSE(first({{1, 0, 1}}).hit);
    EXPECT_EQ(first({{2, 2, 1}, {3, 3, 3}}).cell, glm::ivec3(2, 2, 1));
}

}  // namespace
}  // namespace voxelume
