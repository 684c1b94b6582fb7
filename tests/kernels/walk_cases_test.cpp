// SPDX-License-Identifier: Apache-2.0
// The walks of the stress cases T1 to T22 (tests/CASES.md), on the device, cell by cell.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <optional>

#include "runtime/stages/index/index.hpp"
#include "runtime/verify/stress/device_walks.hpp"
#include "runtime/verify/stress/ray_classes.hpp"
#include "tests/oracles/rational_walk.hpp"
#include "tests/support/test_device.hpp"

namespace voxelume {
namespace {

using glm::ivec3;
using glm::vec3;

/// One device and its kernels for all cases. It is never freed, because its platform may be gone
/// before.
DeviceWalks& walks() {
    static DeviceWalks* const shared = new DeviceWalks(test_device());
    return *shared;
}

using Cells = std::vector<std::array<int, 3>>;

/// The cells of a ray as rays of a scene pass them: snapped, and clipped to the grid.
Cells device_cells(const vec3& origin, const vec3& direction, const ivec3& size,
                   uint32_t maximum = 1000) {
    const FixedGrid grid = fixed_grid(size);
    const FloatRay ray{origin, direction};
    const auto snapped = walks().snap(grid, {&ray, 1});
    Cells cells;
    if (!snapped[0]) return cells;
    for (const EnteredCell& c : walks().cells(grid, *snapped[0], Steps::cells, maximum))
        cells.push_back({c.cell.x, c.cell.y, c.cell.z});
    return cells;
}

/// The cells of the unrounded ray, in rational numbers.
Cells exact_cells_of(const vec3& origin, const vec3& direction, const ivec3& size) {
    Cells cells;
    for (const auto& c :
         oracle::rational_walk(oracle::rationals(origin.x, origin.y, origin.z),
                               oracle::rationals(direction.x, direction.y, direction.z), size))
        cells.push_back({c.cell.x, c.cell.y, c.cell.z});
    return cells;
}

/// (1,2,3) as 123.
Cells cells_of(std::initializer_list<int> digits) {
    Cells cells;
    for (const int d : digits) cells.push_back({d / 100, d / 10 % 10, d % 10});
    return cells;
}

const Cells kRowOfEight = cells_of({0, 100, 200, 300, 400, 500, 600, 700});

TEST(WalkCases, T1AlongAnAxis) {
    EXPECT_EQ(device_cells({.5f, .5f, .5f}, {1, 0, 0}, ivec3(8)), kRowOfEight);
}

TEST(WalkCases, T2NegativeZeroIsZero) {
    EXPECT_EQ(device_cells({.5f, .5f, .5f}, {1, -0.0f, 0}, ivec3(8)), kRowOfEight);
    EXPECT_EQ(device_cells({.5f, .5f, .5f}, {1, 0, -0.0f}, ivec3(8)), kRowOfEight);
}

TEST(WalkCases, T3UpTheDiagonalLowestAxisFirst) {
    EXPECT_EQ(device_cells({0, 0, 0}, {1, 1, 1}, ivec3(4)),
              cells_of({0, 100, 110, 111, 211, 221, 222, 322, 332, 333}));
}

TEST(WalkCases, T4DownTheDiagonalLowestAxisFirst) {
    EXPECT_EQ(device_cells({4, 4, 4}, {-1, -1, -1}, ivec3(4)),
              cells_of({333, 233, 223, 222, 122, 112, 111, 11, 1, 0}));
}

TEST(WalkCases, T5UnequalSteps) {
    EXPECT_EQ(device_cells({.25f, .25f, .25f}, {1, 2, 3}, ivec3(8)),
              cells_of({0, 1, 11, 12, 112, 122, 123, 124, 134, 135, 235, 245, 246, 247, 257}));
}

TEST(WalkCases, T6InAGridPlane) {
    EXPECT_EQ(device_cells({0, 1, .5f}, {1, 0, 0}, ivec3(4)), cells_of({10, 110, 210, 310}));
}

TEST(WalkCases, T7FromAnEdgeBackwards) {
    EXPECT_EQ(device_cells({2, 2, .5f}, {-1, 1, 0}, ivec3(4)), cells_of({120, 20, 30}));
}

TEST(WalkCases, T8InThroughACorner) {
    EXPECT_THAT(device_cells({-1, -1, -1}, {1, 1, 1}, ivec3(4), 4),
                testing::ElementsAreArray(cells_of({0, 100, 110, 111})));
}

TEST(WalkCases, T9InThroughAnEdge) {
    EXPECT_EQ(device_cells({-1, 4.5f, .5f}, {2, -1, 0}, ivec3(4)),
              cells_of({30, 130, 230, 220, 320}));
}

TEST(WalkCases, T10AlongTheUpperSideIsOutside) {
    EXPECT_EQ(device_cells({-1, .5f, 4}, {1, 0, 0}, ivec3(4)), Cells());
    // The coordinate is one unit of fixed point below 4; 3.9999998 is half a unit below and is
    // snapped to 4.
    EXPECT_EQ(device_cells({-1, .5f, 3.9999995f}, {1, 0, 0}, ivec3(4)),
              cells_of({3, 103, 203, 303}));
}

TEST(WalkCases, T11DecimalFractions) {
    // Snapping to 24 bits decides the ties that the decimals mean, so the list is the snapped
    // ray's.
    const vec3 d(.1f, .2f, .3f);
    EXPECT_EQ(device_cells(d, d, ivec3(1024), 4000).size(), 2047u);
    const FixedGrid grid = fixed_grid(ivec3(8));
    const FloatRay ray{d, d};
    const FixedRay snapped = walks().snap(grid, {&ray, 1})[0].value();
    vec3 origin, direction;
    for (int a = 0; a < 3; ++a) {
        origin[a] = std::ldexp(float(snapped.origin[size_t(a)]), -grid.fraction_bits);
        direction[a] = std::ldexp(float(snapped.direction[size_t(a)]), -22);
    }
    const Cells cells = device_cells(d, d, ivec3(8));
    EXPECT_EQ(cells, exact_cells_of(origin, direction, ivec3(8)));
    EXPECT_EQ(cells.size(), exact_cells_of(d, d, ivec3(8)).size());
    EXPECT_EQ(cells.back(), exact_cells_of(d, d, ivec3(8)).back());
}

TEST(WalkCases, T12OneUnitBelowTheDiagonal) {
    const vec3 d(1, 1 - 0x1p-21f, 1);
    const Cells cells = device_cells({0, 0, 0}, d, ivec3(4096), 13000);
    EXPECT_EQ(cells.size(), 12286u);
    EXPECT_EQ(cells, exact_cells_of({0, 0, 0}, d, ivec3(4096)));
    EXPECT_EQ(Cells(cells.begin(), cells.begin() + 6), cells_of({0, 100, 101, 111, 211, 212}));
}

TEST(WalkCases, T13ALoopOfAnotherProgramEnds) {
    // The ray goes from (-668,-340,77) to (404,-64,-784) in cells of 16, moved by 43, 23 and 50
    // cells.
    const vec3 o(-668 / 16.f + 43, -340 / 16.f + 23, 77 / 16.f + 50);
    const vec3 d = vec3(404 + 668, -64 + 340, -784 - 77) / 16.f / 128.f;
    const FixedGrid grid = fixed_grid({100, 60, 70});
    const FloatRay ray{o, d};
    const auto cells = walks().cells(grid, *walks().snap(grid, {&ray, 1})[0], Steps::cells, 300);
    size_t count = 0;
    while (count < cells.size() && cells[count].t < 128) ++count;
    EXPECT_EQ(count, 138u);
    EXPECT_EQ(cells[0].cell, ivec3(-42 + 43, -22 + 23, 4 + 50));
    EXPECT_EQ(cells[137].cell, ivec3(25 + 43, -5 + 23, -49 + 50));
}

TEST(WalkCases, T14TinyComponentsAndAnyLength) {
    const vec3 o(.5f, .5f, .5f);
    EXPECT_EQ(device_cells(o, {1, 1e-30f, 0}, ivec3(8)), kRowOfEight);
    EXPECT_EQ(device_cells(o, {1, 1e-45f, 0}, ivec3(8)), kRowOfEight);
    EXPECT_EQ(device_cells(o, {1e30f, 1e30f, 0}, ivec3(8)), device_cells(o, {1, 1, 0}, ivec3(8)));
    const vec3 d(.3f, -.7f, .9f);
    for (const float scale : {0x1p-100f, 0x1p100f})
        EXPECT_EQ(device_cells({1, 7, .25f}, d * scale, ivec3(8)),
                  device_cells({1, 7, .25f}, d, ivec3(8)));
}

TEST(WalkCases, T15FromAMillionAndTenMillionVoxelsAway) {
    for (const float far : {1e6f, 1e7f}) {
        EXPECT_EQ(device_cells({-far, .5f, .5f}, {1, 0, 0}, ivec3(8)), kRowOfEight);
        EXPECT_EQ(device_cells({-far, -far, 2.5f}, {1, 1, 0}, ivec3(4)),
                  exact_cells_of({-far, -far, 2.5f}, {1, 1, 0}, ivec3(4)));
    }
}

TEST(WalkCases, T15ThroughTheLargestWorld) {
    const ivec3 size(65536, 40000, 300);
    Cells row;
    for (int x = 0; x < 1000; ++x) row.push_back({x, 39999, 7});
    for (const float far : {0.0f, 1e6f, 1e7f}) {
        EXPECT_EQ(device_cells({-far, 39999.5f, 7.25f}, {1, 0, 0}, size), row);
        Cells diagonal = exact_cells_of({-far, -far, 2.5f}, {1, 1, 0}, size);
        diagonal.resize(1000);
        EXPECT_EQ(device_cells({-far, -far, 2.5f}, {1, 1, 0}, size), diagonal);
    }
}

TEST(WalkCases, T17WithinTheGridsSidesAndEdges) {
    for (const float side : {0.0f, 5.0f})
        for (const float along : {-1.0f, 1.0f})
            for (int axis = 0; axis < 3; ++axis) {
                vec3 in_side(side), in_edge(side), d(0);
                in_side[axis] = 2.5f, in_edge[axis] = 2.25f;
                in_side[(axis + 1) % 3] = 1.5f;
                d[axis] = along;
                EXPECT_EQ(device_cells(in_side, d, ivec3(5)), exact_cells_of(in_side, d, ivec3(5)));
                EXPECT_EQ(device_cells(in_edge, d, ivec3(5)), exact_cells_of(in_edge, d, ivec3(5)));
                d[(axis + 1) % 3] = -along;
                EXPECT_EQ(device_cells(in_side, d, ivec3(5)), exact_cells_of(in_side, d, ivec3(5)));
            }
}

TEST(WalkCases, T18RaysThatOtherProgramsLose) {
    const std::pair<vec3, vec3> rays[] = {
        {{0, 0, -1}, {0, 0, 1}},          // on the grid's edge (Dr.Jit 311)
        {{0, 1, -1}, {-0.0f, 0, 1}},      // on a grid line, with a negative zero
        {{-1, 9, 1.5f}, {1, 0, 0}},       // parallel to an axis, past the grid
        {{1.5f, 1.5f, 1.5f}, {0, 1, 0}},  // two components that are zero (hyperion 909)
        {{4, 2, 2}, {-1, 0, 0}},          // from the upper side inwards
    };
    for (const auto& [o, d] : rays)
        EXPECT_EQ(device_cells(o, d, ivec3(4)), exact_cells_of(o, d, ivec3(4)))
            << o.x << ' ' << o.y << ' ' << o.z;
}

TEST(WalkCases, T18AWorldWithoutVoxelsEndsEveryRay) {  // gvdb 115: empty masks
    const ivec3 size(70, 37, 130);
    const FixedGrid grid = fixed_grid(size);
    GridFrame frame;
    frame.size = size;
    const Device device = test_device();
    BrickGrid bricks = cubes_of(device, VoxelBits(size), frame);
    // One brick is stored nevertheless, without a voxel.
    std::vector<uint32_t> slots = bricks.slots.read();
    slots[7] = 0;
    bricks.brick_count = 1;
    bricks.slots = {device, "slots", std::span<const uint32_t>(slots)};
    const std::array<uint32_t, 1> number = {7};
    bricks.coordinates = {device, "coordinates", std::span<const uint32_t>(number)};
    const std::array<uint64_t, 64> masks{};
    bricks.occupancy = {device, "occupancy", std::span<const uint64_t>(masks)};
    const Pyramid pyramid = build_index(device, bricks);
    DeviceHits hits(device, pyramid);
    std::vector<FixedRay> rays;
    for (const RayClassName& named : kRayClasses)
        for (uint64_t i = 0; i < 101; ++i) rays.push_back(ray_of_class(named.kind, grid, 18, i));
    hits.start(grid, rays);
    for (const auto& hit : hits.hits()) EXPECT_FALSE(hit);
}

TEST(WalkCases, T19TheReverseRayHasTheReverseList) {
    const FixedGrid grid = fixed_grid({64, 61, 37});
    int compared = 0;
    for (uint64_t number = 0; number < 400; ++number) {
        // Directions have 17 bits, so that after a whole t the ray is at a place of the fixed point
        // again.
        FixedRay ray = ray_of_class(RayClass::random, grid, 19, number), back;
        int64_t t = 1000;
        for (size_t a = 0; a < 3; ++a) {
            ray.direction[a] = ray.direction[a] / 32 * 32 + 32;
            ray.origin[a] = ray.origin[a] / 2 * 2 + 1;  // never on a plane: ties are very rare
            const int64_t d = ray.direction[a], side = grid.size[int(a)] * grid.unit();
            const int64_t room = d > 0 ? side - ray.origin[a] : ray.origin[a];
            if (d != 0) t = std::min(t, room * 32 / std::abs(d));
        }
        if (t < 1) continue;
        for (size_t a = 0; a < 3; ++a) {
            back.origin[a] = ray.origin[a] + t * (ray.direction[a] / 32);
            back.direction[a] = -ray.direction[a];
        }
        const auto forth_cells = walks().cells(grid, ray, Steps::cells, 170);
        const auto back_cells = walks().cells(grid, back, Steps::cells, 170);
        Cells forth, reverse;
        for (const EnteredCell& c : forth_cells)
            if (c.t < float(t)) forth.push_back({c.cell.x, c.cell.y, c.cell.z});
        for (const EnteredCell& c : back_cells)
            if (c.t < float(t)) reverse.insert(reverse.begin(), {c.cell.x, c.cell.y, c.cell.z});
        EXPECT_EQ(forth, reverse) << "ray " << number;
        ++compared;
    }
    EXPECT_GT(compared, 300);
}

TEST(WalkCases, T22EveryPairOfHalfIntegerPointsOfSixCubed) {
    const FixedGrid grid = fixed_grid(ivec3(6));
    const int places = 13 * 13 * 13;
    const auto point = [](int i) { return ivec3(i % 13, i / 13 % 13, i / 169); };
    std::vector<FixedRay> rays;
    for (int from = 0; from < places; from += 1) {
        rays.clear();
        for (int to = 0; to < places; ++to) {
            if (from == to) continue;
            ivec3 way = point(to) - point(from);
            const int longest = std::max({std::abs(way.x), std::abs(way.y), std::abs(way.z)});
            const int shift = 21 - (std::bit_width(unsigned(longest)) - 1);
            FixedRay ray;
            for (size_t a = 0; a < 3; ++a) {
                ray.origin[a] = point(from)[int(a)] * grid.unit() / 2;
                ray.direction[a] = int64_t(way[int(a)]) * (int64_t{1} << shift);
            }
            rays.push_back(ray);
        }
        walks().start(grid, rays, Steps::cells, 100);
        const std::vector<WalkDigest> device = walks().digests();
        for (size_t i = 0; i < rays.size(); ++i)
            ASSERT_EQ(device[i], exact_digest(grid, rays[i], Steps::cells, 100))
                << "from point " << from << ", ray " << i;
    }
}

}  // namespace
}  // namespace voxelume
