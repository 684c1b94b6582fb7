// SPDX-License-Identifier: Apache-2.0
// The oracles for meshes against brute force over all triangles, and hand-computed cases.
#include <gtest/gtest.h>

#include <random>

#include "tests/oracles/mesh/mesh_distance.hpp"
#include "tests/oracles/mesh/mesh_ray.hpp"
#include "tests/oracles/mesh/triangle_distance.hpp"

namespace voxelume {
namespace {

constexpr unsigned kOracleSeed = 20261121;

/// Random triangles of very different sizes; a tenth of them have no area.
std::vector<oracle::Triangle> random_triangles(int count, std::mt19937& random) {
    std::uniform_real_distribution<double> place(-3, 5), size(-1, 1);
    std::vector<oracle::Triangle> triangles;
    for (int i = 0; i < count; ++i) {
        const glm::dvec3 a(place(random), 2 * place(random), place(random) / 3);
        const double scale = std::exp2(-6 * std::abs(size(random)));
        const auto corner = [&] {
            return a + scale * glm::dvec3(size(random), size(random), size(random));
        };
        const glm::dvec3 b = corner(), c = i % 10 == 0 ? (a + b) / 2.0 : corner();
        triangles.push_back({a, b, c});
    }
    return triangles;
}

/// The first hit by plane and barycentric coordinates, for rays that don't pass near an edge.
double brute_force_hit(const std::vector<oracle::Triangle>& triangles, const glm::dvec3& origin,
                       const glm::dvec3& direction) {
    double nearest = INFINITY;
    for (const oracle::Triangle& t : triangles) {
        const glm::dvec3 u = t[1] - t[0], v = t[2] - t[0], n = glm::cross(u, v);
        const double facing = glm::dot(n, direction);
        if (facing == 0) continue;
        const double at = glm::dot(n, t[0] - origin) / facing;
        const glm::dvec3 p = origin + direction * at - t[0];
        const double a = glm::dot(glm::cross(p, v), n) / glm::dot(n, n);
        const double b = glm::dot(glm::cross(u, p), n) / glm::dot(n, n);
        if (at > 0 && a >= 0 && b >= 0 && a + b <= 1) nearest = std::min(nearest, at);
    }
    return nearest;
}

TEST(MeshDistance, IsTheSmallestDistanceToAnyTriangle) {
    std::mt19937 random(kOracleSeed);
    const std::vector<oracle::Triangle> triangles = random_triangles(397, random);
    const oracle::MeshTree tree(triangles);
    std::uniform_real_distribution<double> place(-8, 9);
    for (int i = 0; i < 500; ++i) {
        const glm::dvec3 p(place(random), place(random), place(random));
        double nearest = INFINITY;
        for (const oracle::Triangle& t : triangles)
            nearest = std::min(nearest, oracle::distance_to_triangle(p, t[0], t[1], t[2]));
        ASSERT_NEAR(oracle::distance_to_mesh(tree, p), nearest, 1e-12 * (1 + nearest))
            << "seed " << kOracleSeed << " point " << i;
    }
}

TEST(MeshRay, FindsTheNearestTriangleOfAll) {
    std::mt19937 random(kOracleSeed);
    const std::vector<oracle::Triangle> triangles = random_triangles(611, random);
    const oracle::MeshTree tree(triangles);
    std::uniform_real_distribution<double> place(-8, 9);
    int hits = 0;
    for (int i = 0; i < 2000; ++i) {
        const glm::dvec3 o(place(random), place(random), place(random));
        const oracle::Triangle& aim = triangles[random() % 61 * 10 + 1 + random() % 9];
        const glm::dvec3 d = (aim[0] + aim[1] + aim[2]) / 3.0 - o;
        const auto found = oracle::first_hit(tree, o, d);
        const double expected = brute_force_hit(triangles, o, d);
        ASSERT_EQ(found.has_value(), !std::isinf(expected))
            << "seed " << kOracleSeed << " ray " << i;
        if (!found) continue;
        ASSERT_NEAR(*found, expected, 1e-9) << "seed " << kOracleSeed << " ray " << i;
        ++hits;
    }
    EXPECT_GT(hits, 1700);
}

TEST(MeshRay, CannotPassBetweenTwoTrianglesOfAFan) {
    const glm::dvec3 hub(0.1, -0.7, 3.3);
    std::vector<oracle::Triangle> fan;
    std::vector<glm::dvec3> rim;
    for (int i = 0; i < 29; ++i)
        rim.emplace_back(2 * std::cos(i * 2 * M_PI / 29), 3 * std::sin(i * 2 * M_PI / 29), 2.9);
    for (size_t i = 0; i < 29; ++i) fan.push_back({hub, rim[i], rim[(i + 1) % 29]});
    const oracle::MeshTree tree(fan);
    std::mt19937 random(kOracleSeed);
    std::uniform_real_distribution<double> part(0, 0.999);
    for (int i = 0; i < 5000; ++i) {
        const glm::dvec3 o(part(random), -part(random), -5 * part(random));
        const glm::dvec3 at = glm::mix(hub, rim[size_t(i) % 29], i % 7 ? part(random) : 0.0);
        EXPECT_TRUE(oracle::first_hit(tree, o, at - o)) << "seed " << kOracleSeed << " ray " << i;
    }
}

TEST(MeshRay, MeasuresTheDistanceToASilhouette) {
    // The tetrahedron is seen along -z from above its top, so the base's three edges are its
    // silhouette.
    const glm::dvec3 a(0, 0, 0), b(4, 0, 0), c(0, 3, 0), top(1, 1, 2);
    const std::vector<oracle::Triangle> faces = {{a, c, b}, {a, b, top}, {b, c, top}, {c, a, top}};
    const auto edges = oracle::silhouette_edges(faces, {1, 1, 100});
    ASSERT_EQ(edges.size(), 3u);
    EXPECT_DOUBLE_EQ(oracle::distance_to_edges(edges, {2, -0.25, 5}, {0, 0, -3}), 0.25);
    EXPECT_DOUBLE_EQ(oracle::distance_to_edges(edges, {-3, -4, 5}, {0, 0, -1}), 5);
    EXPECT_DOUBLE_EQ(oracle::distance_to_edges(edges, {2, -0.25, 5}, {0, 0, 1}),
                     std::hypot(5, 0.25));
    EXPECT_DOUBLE_EQ(oracle::distance_to_edges(edges, {2, -0.5, -1}, {1, 0, 0}),
                     std::hypot(1, 0.5));
}

TEST(MeshRay, CountsOpenEdgesAsSilhouette) {
    const std::vector<oracle::Triangle> sheet = {{{{0, 0, 0}, {2, 0, 0}, {0, 3, 0}}},
                                                 {{{2, 0, 0}, {2, 3, 0}, {0, 3, 0}}}};
    EXPECT_EQ(oracle::silhouette_edges(sheet, {1, 1, 7}).size(), 4u);
}

}  // namespace
}  // namespace voxelume
