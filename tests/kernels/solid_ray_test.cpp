// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <functional>

#include "tests/kernels/solid_probe.hpp"

namespace voxelume {
namespace {

/// Compares a case's hits, normals and misses with the oracle; VXL_TEST_RAYS asks for more rays.
void expect_oracle_hits(const SolidCase& c, unsigned seed) {
    const char* asked = std::getenv("VXL_TEST_RAYS");
    const size_t count = asked ? std::strtoul(asked, nullptr, 10) : 4000;
    const std::vector<Ray> rays = random_rays(seed, count);
    const oracle::AnalyticSolid exact(c.solid, grid_from_solid());
    const std::vector<Hit> hits =
        probe()(make_solid_program(c.solid, grid_from_solid(), GridFrame{}), rays);
    size_t met = 0, unsure = 0;
    double largest_error = 0, largest_turn = 0;
    for (size_t i = 0; i < count; ++i) {
        const auto where = [&] { return fmt::format("{}, seed {}, ray {}", c.name, seed, i); };
        const Ray& ray = rays[i];
        const long double speed = glm::length(oracle::Vector(ray.direction));
        const auto truth =
            exact.first_crossing(ray.origin, oracle::Vector(ray.direction) / speed, 0, 1e6L, 1e-5L);
        const bool is_hit = std::isfinite(hits[i].t) && hits[i].t * speed < 1e6L;
        met += is_hit, unsure += !truth.is_certain;
        if (!truth.is_certain) continue;
        ASSERT_EQ(is_hit, truth.is_hit) << where();
        if (!is_hit) continue;
        // The hit's distance from the surface, in roundings (2^-24) of the way and the solid's
        // size.
        const auto off = static_cast<double>(std::abs(exact.distance(ray.at(hits[i].t))));
        const auto way = static_cast<double>(truth.t);
        if (way > 150) continue;  // a slab out of the grid, nearly parallel to the ray
        ASSERT_NEAR(hits[i].t * static_cast<double>(speed), way, 0.02) << where();
        largest_error = std::max(largest_error, std::ldexp(off / (way + 20), 24));
        oracle::Vector gradient;  // where the kernel's hit is, whose error is told above
        for (int axis = 0; axis < 3; ++axis) {
            oracle::Vector step(0);
            step[axis] = 1e-7L;
            const oracle::Vector p = ray.at(hits[i].t);
            gradient[axis] = exact.distance(p + step) - exact.distance(p - step);
        }
        const auto turn = static_cast<double>(
            glm::length(glm::normalize(gradient) - glm::normalize(oracle::Vector(hits[i].normal))));
        largest_turn = std::max(largest_turn, turn);
    }
    EXPECT_GT(met, count / 5) << c.name;
    EXPECT_LT(unsure, count / 100) << c.name;
    EXPECT_LE(largest_error, 4.0) << c.name;
    // The gradient is of the place, which a float rounds by some 1e-6 of the solid's size: it turns
    // most at a cone's tip, by 2.7e-6 of the rays here, and by less than 1e-6 elsewhere.
    EXPECT_LE(largest_turn, 1e-5) << c.name;
    ::testing::Test::RecordProperty(c.name,
                                    fmt::format("{} hits of {}, {} unsure, error {:.2f} "
                                                "roundings, normal {:.1e}",
                                                met, count, unsure, largest_error, largest_turn));
}

TEST(SolidRay, AgreesWithTheOracleForEveryKind) {
    for (const SolidCase& c : shape_cases()) expect_oracle_hits(c, 21);
}

TEST(SolidRay, AgreesWithTheOracleForCombinations) {
    for (const SolidCase& c : combination_cases()) expect_oracle_hits(c, 22);
}

TEST(SolidRay, AgreesWithTheOracleForShearedShapes) {
    for (SolidCase c : shape_cases()) {
        glm::dmat4 shear(1);
        shear[1] = {0.5, 1.1, -0.25, 0};
        c.solid.parent_from_solid = c.solid.parent_from_solid * shear;
        expect_oracle_hits(c, 23);
    }
}

/// A point on an edge of a convex case's surface, and the outward normals that meet there.
struct EdgePoint {
    glm::dvec3 at, first, second;
};

void expect_hits_at_edges(const Solid& solid, const std::function<EdgePoint(double)>& edge,
                          unsigned seed) {
    std::mt19937 random(seed);
    std::normal_distribution<double> normal;
    std::uniform_real_distribution<double> unit(0, 1);
    std::vector<Ray> rays;
    std::vector<double> ways;
    while (rays.size() < 20000) {
        const EdgePoint point = edge(unit(random));
        const glm::dvec3 d =
            glm::normalize(glm::dvec3(normal(random), normal(random), normal(random)));
        if (glm::dot(d, point.first) > -0.1 || glm::dot(d, point.second) > -0.1) continue;
        const double way = 2 + 30 * unit(random);
        rays.push_back({glm::vec3(point.at - d * way), glm::vec3(d)});
        ways.push_back(way);
    }
    const std::vector<Hit> hits =
        probe()(make_solid_program(solid, glm::dmat4(1), GridFrame{}), rays);
    for (size_t i = 0; i < rays.size(); ++i)
        ASSERT_NEAR(hits[i].t, ways[i], 2e-4) << "seed " << seed << ", ray " << i;
}

TEST(SolidRay, NoRayPassesBetweenCapAndSide) {
    const glm::dvec3 at(40, 35, 45);
    Solid cylinder = shape(SolidKind::cylinder, at), cone = shape(SolidKind::cone, at);
    cylinder.radius = 7, cylinder.height = 11;
    expect_hits_at_edges(
        cylinder,
        [&](double u) {
            const glm::dvec3 out(std::cos(7 * u), 0, std::sin(7 * u));
            return EdgePoint{at + 7.0 * out + glm::dvec3(0, 5.5, 0), out, {0, 1, 0}};
        },
        31);
    cone.radius = 9, cone.top_radius = 4, cone.height = 6;
    expect_hits_at_edges(
        cone,
        [&](double u) {
            const glm::dvec3 out(std::cos(7 * u), 0, std::sin(7 * u));
            return EdgePoint{at + 9.0 * out - glm::dvec3(0, 3, 0),
                             glm::normalize(6.0 * out + glm::dvec3(0, 5, 0)),
                             {0, -1, 0}};
        },
        32);
    cone.top_radius = 0;
    const glm::dvec3 steeper_than_side(0, 0.17, 0);  // rays that go on inside the cone at its tip
    expect_hits_at_edges(
        cone,
        [&](double) {
            return EdgePoint{at + glm::dvec3(0, 3, 0), steeper_than_side, steeper_than_side};
        },
        33);
}

TEST(SolidRay, NoRayPassesBetweenFacesOrBetweenTheShapesOfACombination) {
    const glm::dvec3 at(40, 35, 45);
    Solid box = shape(SolidKind::box, at), bore = shape(SolidKind::cylinder, at);
    box.size = {14, 10, 18};
    expect_hits_at_edges(
        box,
        [&](double u) {
            return EdgePoint{at + glm::dvec3(7, 5, 18 * u - 9), {1, 0, 0}, {0, 1, 0}};
        },
        34);
    Solid left = shape(SolidKind::sphere, at - glm::dvec3(3, 0, 0));
    Solid right = shape(SolidKind::sphere, at + glm::dvec3(3, 0, 0));
    left.radius = right.radius = 5;  // the lens' edge is a circle of radius 4
    expect_hits_at_edges(
        combined(SolidKind::intersection_of, {left, right}),
        [&](double u) {
            const glm::dvec3 out(0, std::cos(7 * u), std::sin(7 * u));
            return EdgePoint{at + 4.0 * out, glm::normalize(glm::dvec3(3, 0, 0) + 4.0 * out),
                             glm::normalize(glm::dvec3(-3, 0, 0) + 4.0 * out)};
        },
        35);
    bore.radius = 3, bore.height = 30;
    expect_hits_at_edges(
        combined(SolidKind::difference_of, {box, bore}),
        [&](double u) {
            const glm::dvec3 out(std::cos(7 * u), 0, std::sin(7 * u));
            return EdgePoint{at + 3.0 * out + glm::dvec3(0, 5, 0), -out, {0, 1, 0}};
        },
        36);
}

}  // namespace
}  // namespace voxelume
