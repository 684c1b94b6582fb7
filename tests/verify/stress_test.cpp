// SPDX-License-Identifier: Apache-2.0
// The findings of `voxelume stress`: none in correct kernels, and the fault in faulty ones.
#include "runtime/verify/stress/stress.hpp"

#include <gtest/gtest.h>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <set>
#if defined(__SSE__)
#include <xmmintrin.h>
#endif

#include "runtime/verify/exact/exact_cover.hpp"
#include "runtime/verify/exact/exact_thin.hpp"
#include "runtime/verify/stress/device_walks.hpp"
#include "runtime/verify/stress/ray_classes.hpp"
#include "runtime/verify/stress/stress_rays.hpp"
#include "runtime/verify/stress/triangle_classes.hpp"
#include "tests/oracles/mesh/triangle_overlap.hpp"
#include "tests/support/test_device.hpp"

namespace voxelume {
namespace {

constexpr uint64_t kStressSeed = 20261121;

const StressTest& test_named(const std::string& name) {
    for (const StressTest& test : stress_tests())
        if (test.name == name) return test;
    throw std::out_of_range(name);
}

class Stress : public testing::TestWithParam<std::string> {};

TEST_P(Stress, FindsNothing) {
    const StressTest& test = test_named(GetParam());
    const Device device = test_device();
    // The numbers cover all grids of the rays' classes, all classes of triangles, and both kinds of
    // maps.
    const uint64_t rays = kRayGrids * kRaysOfOneGrid;
    const uint64_t count = std::max<uint64_t>(rays / test.rays_per_case, 27);
    const bool has_triangles = GetParam() == "triangles" || GetParam() == "crosshairs";
    const uint64_t cases = has_triangles ? kTriangleClasses * kTrianglesOfOneGrid : count;
    uint64_t told = 0;
    const StressResult result =
        test.run({device, kStressSeed, 0, cases, [&told](uint64_t tried) { told += tried; }});
    EXPECT_EQ(result.cases, cases);
    EXPECT_EQ(told, cases);
    EXPECT_EQ(result.mismatches, 0u)
        << "seed " << kStressSeed << ", " << result.examples.front().text;
}

std::vector<std::string> names_of_tests() {
    std::vector<std::string> names;
    for (const StressTest& test : stress_tests()) names.push_back(test.name);
    return names;
}

INSTANTIATE_TEST_SUITE_P(Tests, Stress, testing::ValuesIn(names_of_tests()),
                         [](const auto& name) { return name.param; });

// The triangle's snapped corners lie on the other side of the voxel's edge than the corners that
// the ray meets.
TEST(StressFound, ARayAlongAVoxelsEdgeMeetsTheTriangleNextToIt) {
    const StressResult result =
        test_named("exact").run({test_device(), kStressSeed, 6494911, 1, {}});
    EXPECT_EQ(result.cases, 1u);
    EXPECT_EQ(result.mismatches, 0u);
}

std::vector<FixedRay> rays_of_all_classes(const FixedGrid& grid, uint64_t of_each) {
    std::vector<FixedRay> rays;
    for (const RayClassName& named : kRayClasses)
        for (uint64_t i = 0; i < of_each; ++i)
            rays.push_back(ray_of_class(named.kind, grid, kStressSeed, i));
    return rays;
}

std::vector<WalkDigest> digests(const Device& device, const FixedGrid& grid,
                                const std::vector<FixedRay>& rays) {
    DeviceWalks walks(device);
    walks.start(grid, rays, Steps::cells, 1000);
    return walks.digests();
}

TEST(DeviceWalks, AreTheSameForEveryNumberOfLanesAndEachTime) {
    const FixedGrid grid = fixed_grid({64, 61, 37});
    const std::vector<FixedRay> rays = rays_of_all_classes(grid, 1003);
    const std::vector<WalkDigest> expected = digests(test_device(1), grid, rays);
    for (const int lanes : in_turn<int>({4, 16}, 0))
        EXPECT_EQ(digests(test_device(lanes), grid, rays), expected) << lanes;
    for (int i = 0; i < 9; ++i) EXPECT_EQ(digests(test_device(1), grid, rays), expected);
}

TEST(DeviceWalks, DoNotDependOnTheHostsTreatmentOfDenormals) {
#if defined(__SSE__)
    const FixedGrid grid = fixed_grid({64, 61, 37});
    const std::vector<FixedRay> rays = rays_of_all_classes(grid, 501);
    const std::vector<WalkDigest> expected = digests(test_device(), grid, rays);
    const unsigned mode = _mm_getcsr();
    _mm_setcsr(mode | 0x8040u);  // flush to zero, denormals are zero
    const std::vector<WalkDigest> flushed = digests(test_device(), grid, rays);
    _mm_setcsr(mode);
    EXPECT_EQ(flushed, expected);
#else
    GTEST_SKIP() << "only for processors with SSE";
#endif
}

/// The walks extend as far as the largest world, where floats are coarsest.
TEST(DeviceWalks, AreExactToTheEndOfTheLargestWorlds) {
    constexpr uint32_t kMax = 3 * 65536;
    constexpr uint64_t kRays = 24;
    const Device device = test_device();
    DeviceWalks walks(device);
    uint32_t longest = 0;
    for (const glm::ivec3 size : {glm::ivec3(65536), glm::ivec3(65536, 65535, 40001)})
        for (const Steps steps : {Steps::cells, Steps::blocks}) {
            const FixedGrid grid = fixed_grid(size);
            const std::vector<FixedRay> rays = rays_of_all_classes(grid, kRays);
            walks.start(grid, rays, steps, kMax);
            const std::vector<WalkDigest> found = walks.digests();
            for (size_t i = 0; i < rays.size(); ++i) {
                const WalkDigest expected = exact_digest(grid, rays[i], steps, kMax);
                longest = std::max(longest, expected.cells);
                EXPECT_EQ(found[i], expected) << size.z << ", ray " << i;
            }
        }
    EXPECT_GT(longest, 140'000u);
}

TEST(DeviceWalks, ListTheCellsThatTheirDigestsStandFor) {
    const FixedGrid grid = fixed_grid({64, 61, 37});
    DeviceWalks walks(test_device());
    for (const Steps steps : {Steps::cells, Steps::blocks})
        for (const FixedRay& ray : rays_of_all_classes(grid, 3))
            EXPECT_EQ(walks.cells(grid, ray, steps, 170), exact_cells(grid, ray, steps, 170));
}

/// A point of the triangle's region close to which the triangle passes.
glm::ivec3 middle_of(const TriangleOnLattice& t, const TriangleGrid& grid) {
    const glm::ivec3 corner = t[0] / 4096;
    const bool is_in_region = glm::clamp(corner, glm::ivec3(0), grid.region) == corner;
    return is_in_region ? corner : grid.region / 2;
}

TEST(ExactRow, HasTheVoxelsThatSeparatingAxesFind) {
    for (uint64_t number = 0; number < kTriangleClasses * kTrianglesOfOneGrid;
         number += kTrianglesOfOneGrid / 12) {
        const TriangleOnLattice t = stress_triangle(kStressSeed, number);
        const glm::ivec3 middle = middle_of(t, grid_of_triangle(number));
        const glm::ivec3 lowest = glm::min(glm::min(t[0], t[1]), t[2]) / 4096 - 1;
        const glm::ivec3 highest = glm::max(glm::max(t[0], t[1]), t[2]) / 4096 + 1;
        const glm::ivec3 first = glm::max(lowest, middle - 12);
        const glm::ivec3 last = glm::min(highest, middle + 12);
        for (int z = first.z; z <= last.z; ++z) {
            const VoxelRow rows = exact_rows(t, z);
            for (int y = first.y; y <= last.y; ++y) {
                const VoxelRow row = exact_row(t, y, z);
                ASSERT_EQ(y >= rows.first && y <= rows.last, row.first <= row.last)
                    << "triangle " << number << " row " << y << ' ' << z;
                for (int x = first.x; x <= last.x; ++x)
                    ASSERT_EQ(x >= row.first && x <= row.last,
                              oracle::cube_meets_triangle({x, y, z}, t))
                        << "triangle " << number << " voxel " << x << ' ' << y << ' ' << z;
            }
        }
    }
}

TEST(ExactThin, HasTheVoxelsWhoseCrosshairsRationalsMeet) {
    uint64_t count = 0;
    for (uint64_t number = 0; number < kTriangleClasses * kTrianglesOfOneGrid;
         number += kTrianglesOfOneGrid / 16) {
        const TriangleOnLattice t = stress_triangle(kStressSeed, number);
        const glm::ivec3 region = grid_of_triangle(number).region;
        const glm::ivec3 middle = middle_of(t, grid_of_triangle(number));
        const glm::ivec3 first = glm::max(middle - 6, 0), last = glm::min(middle + 6, region - 1);
        std::set<std::array<int, 3>> found;
        for (const glm::ivec3& v : exact_thin(t, region)) found.insert({v.x, v.y, v.z});
        for (glm::ivec3 v = first; v.z <= last.z; ++v.z)
            for (v.y = first.y; v.y <= last.y; ++v.y)
                for (v.x = first.x; v.x <= last.x; ++v.x) {
                    const bool is_met = oracle::crosshair_meets_triangle(v, t);
                    count += is_met;
                    ASSERT_EQ(found.contains({v.x, v.y, v.z}), is_met)
                        << "triangle " << number << " voxel " << v.x << ' ' << v.y << ' ' << v.z;
                }
    }
    EXPECT_GT(count, 2000u);
}

/// The largest magnitude of the terms of a plane: a corner's component times the triangle's area
/// vector.
double largest_plane_term(const TriangleOnLattice& t) {
    const glm::dvec3 a(t[0]), n = glm::cross(glm::dvec3(t[1]) - a, glm::dvec3(t[2]) - a);
    const glm::dvec3 terms = glm::abs(n * a);
    return std::max({terms.x, terms.y, terms.z});
}

TEST(StressTriangles, NeedMoreThan64BitsAndLieWhereFloatsHoldThem) {
    int wide = 0;
    for (uint64_t number = 0; number < 12 * kTriangleClasses * kTrianglesOfOneGrid; number += 7) {
        const TriangleOnLattice t = stress_triangle(kStressSeed, number);
        const glm::ivec3 start = grid_of_triangle(number).start(number % kTrianglesOfOneGrid);
        wide += largest_plane_term(t) > 0x1p63;
        for (const glm::ivec3& corner : t)
            for (int a = 0; a < 3; ++a) {
                const int placed = corner[a] + 4096 * start[a];
                ASSERT_EQ(int(float(placed)), placed) << "triangle " << number;
                ASSERT_LE(std::abs(placed), 16384 * 4096) << "triangle " << number;
            }
    }
    EXPECT_GT(wide, 500);
}

}  // namespace
}  // namespace voxelume
