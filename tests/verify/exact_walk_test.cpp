// SPDX-License-Identifier: Apache-2.0
// The walk in 64-bit integers that `voxelume stress` trusts, against rational numbers.
#include "runtime/verify/exact/exact_walk.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "runtime/verify/stress/ray_classes.hpp"
#include "tests/oracles/cell_walk.hpp"
#include "tests/oracles/rational_walk.hpp"

namespace voxelume {
namespace {

constexpr uint64_t kWalkSeed = 20261121;

oracle::Rational3 in_voxels(const std::array<int64_t, 3>& values, int bits) {
    oracle::Rational3 result;
    for (size_t a = 0; a < 3; ++a) {
        result[a] = mpq_class(long(values[a]));
        mpq_div_2exp(result[a].get_mpq_t(), result[a].get_mpq_t(), mp_bitcnt_t(bits));
    }
    return result;
}

std::vector<oracle::RationalCell> expected_cells(const FixedGrid& grid, const FixedRay& ray,
                                                 size_t maximum) {
    return oracle::rational_walk(in_voxels(ray.origin, grid.fraction_bits),
                                 in_voxels(ray.direction, 22), grid.size, maximum);
}

/// The cells of a list that are the first outside the block that the ray left before.
std::vector<oracle::RationalCell> first_of_blocks(const std::vector<oracle::RationalCell>& cells) {
    std::vector<oracle::RationalCell> first;
    for (const oracle::RationalCell& c : cells) {
        if (!first.empty()) {
            const glm::ivec3 before = first.back().cell;
            const int log2 = block_log2(before);
            if ((before >> log2) == (c.cell >> log2)) continue;
        }
        first.push_back(c);
    }
    return first;
}

class ExactWalk : public testing::TestWithParam<RayClassName> {};

TEST_P(ExactWalk, EntersTheCellsThatRationalsEnter) {
    for (const glm::ivec3 size : {glm::ivec3(7, 5, 3), glm::ivec3(64, 61, 37),
                                  glm::ivec3(1024, 700, 1000), glm::ivec3(16384, 3, 9000),
                                  glm::ivec3(65536, 65536, 65536), glm::ivec3(23, 65535, 40001)})
        for (uint64_t number = 0; number < 150; ++number) {
            const FixedGrid grid = fixed_grid(size);
            const FixedRay ray = ray_of_class(GetParam().kind, grid, kWalkSeed, number);
            const auto expected = expected_cells(grid, ray, 300);
            const auto cells = exact_cells(grid, ray, Steps::cells, 300);
            ASSERT_EQ(cells.size(), expected.size()) << size.x << " ray " << number;
            for (size_t i = 0; i < cells.size(); ++i) {
                ASSERT_EQ(cells[i].cell, expected[i].cell) << size.x << " ray " << number;
                ASSERT_EQ(cells[i].axis, expected[i].axis) << size.x << " ray " << number;
            }
        }
}

TEST_P(ExactWalk, LeavesBlocksWhereTheirLastCellIsLeft) {
    constexpr size_t kMaxCells = 2000;  // walks through the first two grids are shorter
    for (const glm::ivec3 size :
         {glm::ivec3(33, 64, 50), glm::ivec3(600, 300, 400), glm::ivec3(65536, 40001, 65536)})
        for (uint64_t number = 0; number < 150; ++number) {
            const FixedGrid grid = fixed_grid(size);
            const FixedRay ray = ray_of_class(GetParam().kind, grid, kWalkSeed, number);
            const auto all = expected_cells(grid, ray, kMaxCells);
            const auto expected = first_of_blocks(all);
            const size_t maximum = all.size() < kMaxCells ? 1 << 20 : expected.size();
            const auto cells = exact_cells(grid, ray, Steps::blocks, uint32_t(maximum));
            ASSERT_EQ(cells.size(), expected.size()) << size.x << " ray " << number;
            for (size_t i = 0; i < cells.size(); ++i) {
                ASSERT_EQ(cells[i].cell, expected[i].cell) << size.x << " ray " << number;
                ASSERT_EQ(cells[i].axis, expected[i].axis) << size.x << " ray " << number;
            }
        }
}

/// Compares whole walks with those of the oracle in 128 bits.
void expect_walks_of_128_bits(RayClass kind, const glm::ivec3& size, uint64_t count) {
    const FixedGrid grid = fixed_grid(size);
    for (uint64_t number = 0; number < count; ++number) {
        const FixedRay ray = ray_of_class(kind, grid, kWalkSeed, number);
        glm::dvec3 o, d;
        for (int a = 0; a < 3; ++a) {
            o[a] = std::ldexp(double(ray.origin[size_t(a)]), -grid.fraction_bits);
            d[a] = std::ldexp(double(ray.direction[size_t(a)]), -22);
        }
        const auto expected = oracle::cells_crossed(o, d, grid.size, grid.fraction_bits);
        const auto cells = exact_cells(grid, ray, Steps::cells, 1 << 20);
        ASSERT_EQ(cells.size(), expected.size()) << "ray " << number;
        for (size_t i = 0; i < cells.size(); ++i) {
            ASSERT_EQ(cells[i].cell, expected[i].cell) << "ray " << number;
            ASSERT_NEAR(cells[i].t, expected[i].t_in, 2e-7 * expected[i].t_in);
        }
    }
}

TEST_P(ExactWalk, AgreesWithTheWalkIn128Bits) {
    expect_walks_of_128_bits(GetParam().kind, {70, 37, 130}, 3000);
}

TEST_P(ExactWalk, AgreesWithTheWalkIn128BitsThroughTheLargestWorld) {
    expect_walks_of_128_bits(GetParam().kind, {40001, 300, 65536}, 60);
}

TEST_P(ExactWalk, HasRaysInTheirFixedPoint) {
    for (uint64_t number = 0; number < 5000; ++number) {
        const FixedGrid grid = fixed_grid(number % 2 ? glm::ivec3(64, 61, 37) : glm::ivec3(65536));
        const FixedRay ray = ray_of_class(GetParam().kind, grid, kWalkSeed, number);
        int64_t longest = 0;
        for (size_t a = 0; a < 3; ++a) {
            ASSERT_GE(ray.origin[a], 0);
            ASSERT_LE(ray.origin[a], grid.size[int(a)] * grid.unit());
            longest = std::max(longest, std::abs(ray.direction[a]));
        }
        ASSERT_GE(longest, 1 << 21) << "ray " << number;
        ASSERT_LE(longest, 1 << 22) << "ray " << number;
    }
}

INSTANTIATE_TEST_SUITE_P(Classes, ExactWalk, testing::ValuesIn(kRayClasses),
                         [](const auto& named) { return std::string(named.param.name); });

TEST(ExactDigest, DependsOnTheCellsAndOnTheirOrder) {
    const FixedGrid grid = fixed_grid({64, 61, 37});
    const FixedRay ray{{10 << 17, 20 << 17, 30 << 17}, {1 << 22, 1 << 22, -(1 << 22)}};
    FixedRay later = ray;
    later.origin[0] += 1;  // y and z are now crossed after x, not at once
    FixedRay sooner = ray;
    sooner.origin[1] += 1;
    const WalkDigest digest = exact_digest(grid, ray, Steps::cells, 1000);
    EXPECT_EQ(digest, exact_digest(grid, ray, Steps::cells, 1000));
    EXPECT_NE(digest.hash, exact_digest(grid, later, Steps::cells, 1000).hash);
    EXPECT_NE(digest.hash, exact_digest(grid, sooner, Steps::cells, 1000).hash);
    EXPECT_EQ(exact_digest(grid, ray, Steps::cells, 5).cells, 5u);
}

}  // namespace
}  // namespace voxelume
