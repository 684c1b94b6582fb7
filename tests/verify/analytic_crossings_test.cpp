// SPDX-License-Identifier: Apache-2.0
// Closed-form crossings of lines with solids against hand-computed ones and an inside test.
#include "runtime/verify/analytic/analytic_crossings.hpp"

#include <gtest/gtest.h>

#include <glm/ext/matrix_transform.hpp>
#include <glm/geometric.hpp>
#include <random>

#include "runtime/verify/analytic/polynomial_roots.hpp"
#include "tests/oracles/analytic_solids.hpp"

namespace voxelume {
namespace {

using oracle::Crossings;
using oracle::Line;
using oracle::PlacedSolid;

Solid torus() {
    Solid solid;
    solid.kind = SolidKind::torus;
    solid.radius = 0.7;
    solid.tube = 0.2;
    return solid;
}

void expect_crossings(const Crossings& found, const std::vector<double>& expected) {
    ASSERT_EQ(size_t(found.count), expected.size());
    for (size_t i = 0; i < expected.size(); ++i) {
        EXPECT_NEAR(found.list[i].t, expected[i], 1e-15);
        EXPECT_EQ(found.list[i].enters, i % 2 == 0);
    }
}

TEST(PolynomialRoots, AreThePlacesWhereTheSignChanges) {
    // (t - 1)(t - 2)^2 (t - 3) only touches zero at 2.
    const auto found = oracle::sign_changes({12, -28, 23, -8, 1}, 0.5L, 9);
    ASSERT_EQ(found.size(), 2u);
    EXPECT_NEAR(double(found[0]), 1, 1e-15);
    EXPECT_NEAR(double(found[1]), 3, 1e-15);
}

TEST(AnalyticCrossings, OfATorus) {
    const PlacedSolid solid(torus(), glm::dmat4(1));
    expect_crossings(solid.crossings({{-2, 0, 0}, {1, 0, 0}}), {1.1, 1.5, 2.5, 2.9});
    expect_crossings(solid.crossings({{0.7, 2, 0}, {0, -1, 0}}), {1.8, 2.2});
    expect_crossings(solid.crossings({{0, 2, 0}, {0, -1, 0}}), {});
    const glm::dvec3 n = solid.normal({0, 0.2, 0.7}, 0);
    EXPECT_NEAR(n.y, 1, 1e-15);
    EXPECT_NEAR(solid.normal({0.5, 0, 0}, 0).x, -1, 1e-15) << "the hole's side";
}

TEST(AnalyticCrossings, HaveTheFaceThatTheyGoThrough) {
    Solid box;
    box.kind = SolidKind::box;
    box.size = {2, 4, 6};
    const PlacedSolid solid(box, glm::translate(glm::dmat4(1), {10, 0, 0}));
    const Crossings found = solid.crossings({{10, 5, 1}, {0, -2, 0}});
    ASSERT_EQ(found.count, 2);
    EXPECT_EQ(found.list[0].t, 1.5);
    EXPECT_EQ(found.list[1].t, 3.5);
    EXPECT_EQ(solid.normal({10, 2, 1}, found.list[0].face), glm::dvec3(0, 1, 0));
    EXPECT_EQ(solid.normal({10, -2, 1}, found.list[1].face), glm::dvec3(0, -1, 0));
}

TEST(AnalyticCrossings, CombinationsAreRefused) {
    Solid both;
    both.kind = SolidKind::union_of;
    both.parts = {torus(), torus()};
    EXPECT_THROW(PlacedSolid(both, glm::dmat4(1)), std::invalid_argument);
}

std::vector<Solid> all_shapes() {
    std::vector<Solid> shapes(6);
    shapes[0].radius = 0.6;
    shapes[1].kind = SolidKind::ellipsoid;
    shapes[1].radii = {0.3, 0.7, 0.5};
    shapes[2].kind = SolidKind::box;
    shapes[2].size = {0.7, 0.5, 0.9};
    shapes[3].kind = SolidKind::cylinder;
    shapes[3].radius = 0.4, shapes[3].height = 0.9;
    shapes[4].kind = SolidKind::capsule;
    shapes[4].radius = 0.3, shapes[4].height = 0.8;
    shapes[5] = torus();
    shapes.push_back(Solid{});
    shapes.back().kind = SolidKind::slab;
    shapes.back().thickness = 0.3;
    Solid cone;
    cone.kind = SolidKind::cone;
    cone.radius = 0.8, cone.height = 1.2;
    shapes.push_back(cone);
    cone.radius = 0.5, cone.top_radius = 0.8, cone.height = 1;
    shapes.push_back(cone);
    return shapes;
}

TEST(AnalyticCrossings, SeparateInsideFromOutsideAndHaveTheGradientAsNormal) {
    constexpr unsigned kSeed = 5;
    std::mt19937_64 random(kSeed);
    std::uniform_real_distribution<double> coordinate(-1, 1);
    const auto point = [&] {
        return glm::dvec3{coordinate(random), coordinate(random), coordinate(random)};
    };
    for (const Solid& shape : all_shapes()) {
        glm::dmat4 placed = glm::translate(glm::dmat4(1), 0.1 * point());
        const double angle = 2 * coordinate(random);  // compilers call arguments in any order
        placed = glm::rotate(placed, angle, point());
        placed = glm::scale(placed, glm::dvec3(0.9, -1.2, 1.1));
        const PlacedSolid solid(shape, placed);
        const oracle::AnalyticSolid inside(shape, placed);
        const auto distance = [&](const glm::dvec3& p) {
            return double(inside.distance(oracle::Vector(p)));
        };
        int hits = 0;
        for (int i = 0; i < 2000; ++i) {
            const Line line{3.0 * point(), point()};
            const Crossings found = solid.crossings(line);
            std::vector<double> ends = {found.count > 0 ? found.list[0].t - 20 : -20};
            for (int k = 0; k < found.count; ++k) ends.push_back(found.list[size_t(k)].t);
            ends.push_back(ends.back() + 40);
            bool is_inside = found.count > 0 && !found.list[0].enters;
            for (size_t k = 0; k + 1 < ends.size(); ++k, is_inside = !is_inside) {
                for (const double s : {0.01, 0.3, 0.9}) {
                    const double t = ends[k] + (ends[k + 1] - ends[k]) * s;
                    const double d = distance(line.origin + line.direction * t);
                    if (std::abs(d) < 1e-9) continue;
                    ASSERT_EQ(d < 0, is_inside)
                        << "seed " << kSeed << ", kind " << int(shape.kind) << ", line " << i;
                }
            }
            for (int k = 0; k < found.count; ++k, ++hits) {
                const glm::dvec3 p = line.origin + line.direction * found.list[size_t(k)].t;
                // Coordinates of points on slabs may be large, and are rounded.
                ASSERT_NEAR(distance(p), 0, 1e-12 + 0x1p-52 * glm::length(p));
                const glm::dvec3 n = solid.normal(p, found.list[size_t(k)].face);
                ASSERT_GT(distance(p + 1e-6 * n), 0);
                ASSERT_LT(distance(p - 1e-6 * n), 0);
                ASSERT_EQ(glm::dot(n, line.direction) < 0, found.list[size_t(k)].enters);
            }
        }
        EXPECT_GT(hits, 100) << int(shape.kind);
    }
}

}  // namespace
}  // namespace voxelume
