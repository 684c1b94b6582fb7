// SPDX-License-Identifier: Apache-2.0
#include "runtime/stages/voxelize/voxelize_solid.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <set>

#include "runtime/geometry/solid/solid_bounds.hpp"
#include "tests/oracles/analytic_solids.hpp"
#include "tests/support/solid_cases.hpp"
#include "tests/support/test_device.hpp"

namespace voxelume {
namespace {

/// A grid on the host, for questions by voxel or node.
struct HostGrid {
    GridFrame frame;
    std::vector<uint32_t> slots;
    std::vector<uint64_t> occupancy;
    std::vector<int16_t> distance;

    explicit HostGrid(const BrickGrid& grid)
        : frame(grid.frame),
          slots(grid.slots.read()),
          occupancy(grid.occupancy.read()),
          distance(grid.distance.read()) {}

    uint32_t slot(const glm::ivec3& p) const {
        const glm::ivec3 b = p / 16, n = frame.size / 16 + 1;
        return slots[static_cast<size_t>((b.z * n.y + b.y) * n.x + b.x)];
    }
    bool has_voxel(const glm::ivec3& p) const {
        const uint32_t s = slot(p);
        if (s >= kBrickInside) return s == kBrickInside;
        const int leaf = p.x % 16 / 4 + p.y % 16 / 4 * 4 + p.z % 16 / 4 * 16;
        const int bit = p.x % 4 + p.y % 4 * 4 + p.z % 4 * 16;
        return occupancy[s * size_t{64} + leaf] >> bit & 1;
    }
    int node(const glm::ivec3& p) const {
        const int at = p.x % 16 + p.y % 16 * 16 + p.z % 16 * 256;
        return distance[slot(p) * size_t{4096} + at];
    }
    oracle::Vector point(const glm::dvec3& p) const {
        return oracle::Vector(frame.origin + frame.voxel_edge * p);
    }
};

template <class Function>
void for_each(const glm::ivec3& size, Function f) {
    for (int z = 0; z < size.z; ++z)
        for (int y = 0; y < size.y; ++y)
            for (int x = 0; x < size.x; ++x) f(glm::ivec3(x, y, z));
}

size_t voxel_count(const BrickGrid& grid) {
    const HostGrid host(grid);
    size_t count = 0;
    for_each(host.frame.size, [&](const glm::ivec3& p) { count += host.has_voxel(p); });
    return count;
}

GridFrame case_frame() {
    GridFrame frame;
    frame.origin = {-14.5, -15.25, -13.75};
    frame.voxel_edge = {0.5, 0.75, 0.625};
    frame.size = {61, 43, 45};
    return frame;
}

std::vector<SolidCase> all_cases() {
    std::vector<SolidCase> cases = shape_cases();
    for (const SolidCase& c : combination_cases()) cases.push_back(c);
    return cases;
}

size_t ball_voxels(double radius, double centre) {
    Solid ball;
    ball.radius = radius;
    GridFrame frame;
    frame.origin = glm::dvec3(-36 - centre, -37 - centre, -38 - centre);
    frame.size = {73, 75, 77};
    return voxel_count(voxelize_solid(test_device(), ball, glm::dmat4(1), frame,
                                      {Surface::cubes, VoxelSet::solid}));
}

TEST(VoxelizeSolid, ABallHasAsManyVoxelsAsCentresInsideIt) {
    EXPECT_EQ(ball_voxels(32, 0.0), 137376u);  // centred on a voxel's corner
    EXPECT_EQ(ball_voxels(32, 0.5), 137065u);  // on a voxel's centre: 6 centres on the surface
    EXPECT_EQ(ball_voxels(4, 0.0), 280u);
    EXPECT_EQ(ball_voxels(10, 0.0), 4224u);
}

TEST(VoxelizeSolid, ABoxThatEndsBeforeACentreDoesNotHoldItsVoxel) {
    Solid box;
    box.kind = SolidKind::box;
    box.size = {5, 3, 2};
    box.parent_from_solid = moved(glm::dmat4(1), {-2.2, 1.5, 1});  // x up to 0.3, y 0..3, z 0..2
    GridFrame frame;
    frame.origin = {-6, -1, -1};
    frame.size = {8, 6, 5};
    const HostGrid grid(voxelize_solid(test_device(), box, glm::dmat4(1), frame,
                                       {Surface::cubes, VoxelSet::solid}));
    EXPECT_FALSE(grid.has_voxel({6, 2, 2}));  // its centre is at x = 0.5, outside
    EXPECT_TRUE(grid.has_voxel({5, 2, 2}));
    EXPECT_TRUE(grid.has_voxel({1, 1, 1}));  // its centre is at x = -4.5, inside
    EXPECT_FALSE(grid.has_voxel({0, 1, 1}));
    size_t count = 0;
    for_each(frame.size, [&](const glm::ivec3& p) { count += grid.has_voxel(p); });
    EXPECT_EQ(count, 5u * 3 * 2);
}

TEST(VoxelizeSolid, SolidSetsHoldTheCentresThatTheOracleHasInside) {
    const GridFrame frame = case_frame();
    for (const SolidCase& c : all_cases()) {
        const oracle::AnalyticSolid exact(c.solid, glm::dmat4(1));
        const HostGrid grid(voxelize_solid(test_device(), c.solid, glm::dmat4(1), frame,
                                           {Surface::cubes, VoxelSet::solid}));
        for_each(frame.size, [&](const glm::ivec3& p) {
            const long double d = exact.distance(grid.point(glm::dvec3(p) + 0.5));
            if (std::abs(d) < 1e-12) return;
            ASSERT_EQ(grid.has_voxel(p), d < 0) << c.name << " " << p.x << " " << p.y << " " << p.z;
        });
    }
}

TEST(VoxelizeSolid, ThinSetsLetNoPathOfFacesThrough) {
    const GridFrame frame = case_frame();
    for (const SolidCase& c : all_cases()) {
        const oracle::AnalyticSolid exact(c.solid, glm::dmat4(1));
        const HostGrid grid(voxelize_solid(test_device(), c.solid, glm::dmat4(1), frame,
                                           {Surface::cubes, VoxelSet::thin}));
        std::vector<bool> inside;
        for_each(frame.size, [&](const glm::ivec3& p) {
            inside.push_back(exact.distance(grid.point(glm::dvec3(p) + 0.5)) <= 0);
        });
        const auto is_inside = [&](const glm::ivec3& p) -> bool {
            return inside[(p.z * frame.size.y + p.y) * frame.size.x + p.x];
        };
        for_each(frame.size - 1, [&](const glm::ivec3& p) {
            for (int axis = 0; axis < 3; ++axis) {
                glm::ivec3 next = p;
                ++next[axis];
                if (grid.has_voxel(p) || grid.has_voxel(next)) continue;
                ASSERT_EQ(is_inside(p), is_inside(next)) << c.name;
            }
        });
    }
}

TEST(VoxelizeSolid, AShellAroundWholeBricksIsHollow) {
    Solid box;
    box.kind = SolidKind::box;
    box.size = {89.5, 57.5, 71.5};  // voxels; faces a quarter away from the lattice
    const GridFrame frame = frame_around(box, glm::dmat4(1), glm::dvec3(1));
    const HostGrid thin(
        voxelize_solid(test_device(), box, glm::dmat4(1), frame, {Surface::cubes, VoxelSet::thin}));
    EXPECT_TRUE(std::ranges::find(thin.slots, kBrickInside) == thin.slots.end());
    size_t count = 0;
    for_each(frame.size, [&](const glm::ivec3& p) { count += thin.has_voxel(p); });
    EXPECT_EQ(count, 90u * 58 * 72 - 88u * 56 * 70);
}

TEST(VoxelizeSolid, TheSupercoverMissesNoVoxelOfTheSurface) {
    const GridFrame frame = case_frame();
    for (const SolidCase& c : all_cases()) {
        const oracle::AnalyticSolid exact(c.solid, glm::dmat4(1));
        const HostGrid grid(voxelize_solid(test_device(), c.solid, glm::dmat4(1), frame,
                                           {Surface::cubes, VoxelSet::supercover}));
        size_t covered = 0, crossed = 0;
        for_each(frame.size, [&](const glm::ivec3& p) {
            const auto d = std::abs(exact.distance(grid.point(glm::dvec3(p) + 0.5)));
            const bool is_near = d < 0.5 * glm::length(frame.voxel_edge);
            int inside = 0;
            for (int i = 0; is_near && i < 64; ++i) {
                const glm::dvec3 in_voxel(i % 4, i / 4 % 4, i / 16);
                inside += exact.distance(grid.point(glm::dvec3(p) + in_voxel / 3.0)) <= 0;
            }
            const bool is_crossed = inside > 0 && inside < 64;
            const bool is_covered = grid.has_voxel(p);
            ASSERT_TRUE(is_covered || !is_crossed) << c.name;
            // At a corner, 0.44 voxel from the surface, the middle is half a diagonal farther.
            ASSERT_TRUE(!is_covered || d <= 0.76 * glm::length(frame.voxel_edge)) << c.name;
            covered += is_covered, crossed += is_crossed;
        });
        EXPECT_LT(static_cast<double>(covered), 1.45 * static_cast<double>(crossed)) << c.name;
    }
}

TEST(VoxelizeSolid, DistancesAtNodesAreRightToTheUnit) {
    const GridFrame frame = case_frame();
    for (const SolidCase& c : all_cases()) {
        const oracle::AnalyticSolid exact(c.solid, glm::dmat4(1));
        const HostGrid grid(
            voxelize_solid(test_device(), c.solid, glm::dmat4(1), frame, {Surface::smooth, {}}));
        for_each(frame.size + 1, [&](const glm::ivec3& p) {
            const auto d = static_cast<double>(exact.distance(grid.point(p)) / 0.5);
            if (grid.slot(p) >= kBrickInside) {
                ASSERT_GT(std::abs(d), 2.8) << c.name;
                ASSERT_EQ(grid.slot(p), d < 0 ? kBrickInside : kBrickOutside) << c.name;
            } else {
                ASSERT_NEAR(grid.node(p), std::clamp(d * 8192, -32767.0, 32767.0), 1.0) << c.name;
            }
        });
    }
}

TEST(VoxelizeSolid, DistancesFarFromTheOriginAreThoseNearIt) {
    for (const SolidCase& c : all_cases()) {
        const GridFrame near = case_frame();
        GridFrame far =
            near;  // moved by whole voxels: powers of two times the edges, exact in double
        const glm::dvec3 shift = near.voxel_edge * 1048576.0;
        far.origin += shift;
        const VoxelizeOptions smooth{Surface::smooth, {}};
        EXPECT_EQ(
            voxelize_solid(test_device(), c.solid, glm::dmat4(1), near, smooth).distance.read(),
            voxelize_solid(test_device(), c.solid, moved(glm::dmat4(1), shift), far, smooth)
                .distance.read())
            << c.name;
    }
}

TEST(VoxelizeSolid, ExactVoxelsListTheSolid) {
    const Solid solid = combination_cases()[1].solid;
    const BrickGrid grid =
        voxelize_solid(test_device(), solid, glm::dmat4(1), case_frame(), {Surface::exact, {}});
    const std::vector<uint64_t> masks = grid.occupancy.read();
    const std::vector<uint32_t> first = grid.primitive_first.read();
    ASSERT_EQ(first.size(), grid.brick_count * size_t{4096} + 1);
    size_t voxels = 0;
    for (const uint64_t mask : masks) voxels += std::popcount(mask);
    EXPECT_EQ(first.back(), voxels);
    EXPECT_EQ(grid.primitives.read(), std::vector<uint32_t>(voxels, kSolidPrimitive));
    for (size_t v = 0; v + 1 < first.size(); ++v) {
        const size_t x = v % 16, y = v / 16 % 16, z = v / 256 % 16, slot = v / 4096;
        const uint64_t mask = masks[slot * 64 + x / 4 + y / 4 * 4 + z / 4 * 16];
        ASSERT_EQ(first[v + 1] - first[v], mask >> (x % 4 + y % 4 * 4 + z % 4 * 16) & 1);
    }
    EXPECT_EQ(grid.solids.size(), 2u * 32);
    EXPECT_EQ(grid.solids.read_one(3), 2u << 30);  // the solid's own packed attributes
}

TEST(VoxelizeSolid, GridsHaveTheSameBitsForAnyNumberOfLanes) {
    const Solid solid = combination_cases()[2].solid;
    size_t turn = 0;
    for (const VoxelizeOptions options :
         {VoxelizeOptions{Surface::smooth, {}}, VoxelizeOptions{Surface::cubes, VoxelSet::solid},
          VoxelizeOptions{Surface::cubes, VoxelSet::thin}, VoxelizeOptions{Surface::exact, {}}}) {
        const BrickGrid one =
            voxelize_solid(test_device(1), solid, glm::dmat4(1), case_frame(), options);
        for (const int lanes : in_turn<int>({4, 8, 16}, turn++)) {
            const BrickGrid many =
                voxelize_solid(test_device(lanes), solid, glm::dmat4(1), case_frame(), options);
            EXPECT_EQ(one.slots.read(), many.slots.read());
            EXPECT_EQ(one.distance.read(), many.distance.read());
            EXPECT_EQ(one.occupancy.read(), many.occupancy.read());
            EXPECT_EQ(one.primitive_first.read(), many.primitive_first.read());
        }
    }
}

}  // namespace
}  // namespace voxelume
