// SPDX-License-Identifier: Apache-2.0
// Points inside of solids and meshes, and how thin solids are.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "runtime/geometry/solid/solid_inside.hpp"
#include "runtime/geometry/winding_number.hpp"
#include "tests/oracles/analytic_solids.hpp"
#include "tests/support/solid_cases.hpp"
#include "tests/support/test_meshes.hpp"

namespace voxelume {

TEST(SolidInside, AgreesWithTheOracleForEveryKindAndCombination) {
    constexpr uint64_t kSeed = 20261123;
    std::mt19937_64 random(kSeed);
    std::uniform_real_distribution<double> coordinate(-14, 14);
    std::vector<SolidCase> cases = shape_cases();
    for (const SolidCase& combination : combination_cases()) cases.push_back(combination);
    for (const SolidCase& each : cases) {
        const oracle::AnalyticSolid exact(each.solid, glm::dmat4(1));
        int inside = 0;
        for (int i = 0; i < 2000; ++i) {
            const glm::dvec3 p(coordinate(random), coordinate(random), coordinate(random));
            const long double distance = exact.distance(oracle::Vector(p));
            if (std::abs(distance) < 1e-9) continue;
            ASSERT_EQ(is_inside(each.solid, p), distance < 0)
                << each.name << ", seed " << kSeed << ", point " << i;
            inside += distance < 0;
        }
        EXPECT_GT(inside, 20) << each.name;
    }
}

TEST(SolidInside, LeavesOutTheSurface) {
    Solid box;
    box.kind = SolidKind::box, box.size = {7, 5, 3};
    EXPECT_TRUE(is_inside(box, {3.49, 0, 0}));
    EXPECT_FALSE(is_inside(box, {3.5, 0, 0}));
}

TEST(SolidThickness, IsTheShortestWidthAlsoWhenTurnedAndStretched) {
    Solid box;
    box.kind = SolidKind::box, box.size = {7, 5, 3};
    const glm::dmat3 turn(rational_rotation(1, 2, 3, 4));
    EXPECT_NEAR(thickness(box, turn), 3, 1e-12);
    EXPECT_NEAR(thickness(box, turn * glm::dmat3(0.1, 0, 0, 0, 1, 0, 0, 0, 1)), 0.7, 1e-12);
    Solid slab;
    slab.kind = SolidKind::slab, slab.thickness = 0.4;
    const glm::dmat3 sheared(1, 1, 0, 0, 1, 0, 0, 0, 1);  // its planes come nearer to each other
    EXPECT_NEAR(thickness(slab, sheared), 0.4 / std::sqrt(2.0), 1e-12);
    Solid torus;
    torus.kind = SolidKind::torus, torus.radius = 3, torus.tube = 0.25;
    EXPECT_NEAR(thickness(torus, glm::dmat3(2)), 1, 1e-12);
}

TEST(SolidThickness, IsThatOfTheThinnestPartButNotOfWhatIsTakenAway) {
    Solid ball, needle;
    ball.radius = 2;
    needle.kind = SolidKind::cylinder, needle.radius = 0.05, needle.height = 9;
    const glm::dmat3 identity(1);
    EXPECT_NEAR(thickness(combined(SolidKind::union_of, {ball, needle}), identity), 0.1, 1e-12);
    EXPECT_NEAR(thickness(combined(SolidKind::difference_of, {ball, needle}), identity), 4, 1e-12);
}

TEST(WindingNumber, IsOneInsideAndZeroOutside) {
    const Mesh mesh = wavy_ring(60, 40);
    EXPECT_NEAR(winding_number(mesh, {0.31, 0, 0.05}), 1, 1e-6);
    EXPECT_NEAR(winding_number(mesh, {0, 0, 0}), 0, 1e-6);
    EXPECT_NEAR(winding_number(mesh, {3, 2, 1}), 0, 1e-6);
}

TEST(WindingNumber, OfATurnedMeshIsNegativeAndOfAHalfOneAHalf) {
    Mesh mesh = ball({0, 0, 0}, 1, 32, 16);
    const auto half = std::ptrdiff_t(mesh.triangles.size());
    EXPECT_NEAR(winding_number(mesh, {0.1, 0.2, 0.3}), 1, 1e-6);
    std::erase_if(mesh.triangles, [&](const glm::uvec3& t) {
        return mesh.positions[t.x].y + mesh.positions[t.y].y + mesh.positions[t.z].y < 0;
    });
    ASSERT_LT(std::ptrdiff_t(mesh.triangles.size()), half);
    EXPECT_NEAR(winding_number(mesh, {0, 0, 0}), 0.5, 1e-6);
    for (glm::uvec3& t : mesh.triangles) std::swap(t.x, t.y);
    EXPECT_NEAR(winding_number(mesh, {0, 0, 0}), -0.5, 1e-6);
}

}  // namespace voxelume
