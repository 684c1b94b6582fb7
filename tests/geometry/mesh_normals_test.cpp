// SPDX-License-Identifier: Apache-2.0
#include "runtime/geometry/mesh_normals.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/ext/matrix_transform.hpp>
#include <glm/gtc/matrix_inverse.hpp>
#include <numbers>
#include <random>

#include "kernels/shared/normal.h"
#include "runtime/geometry/mesh_morph.hpp"
#include "tests/support/test_meshes.hpp"

namespace voxelume {
namespace {

using testing::Each;
using testing::ElementsAre;
using testing::IsEmpty;

double degrees_between(const glm::dvec3& a, const glm::dvec3& b) {
    return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b)) * 180 / std::numbers::pi;
}

glm::dvec3 random_direction(std::mt19937& random) {
    std::normal_distribution<double> value;
    return glm::normalize(glm::dvec3(value(random), value(random), value(random)));
}

/// A triangle with a corner at the origin whose face looks along Z.
Mesh one_triangle() {
    Mesh mesh;
    mesh.positions = {{0, 0, 0}, {3, 0, 0}, {0, 2, 0}};
    mesh.triangles = {{0, 1, 2}};
    return mesh;
}

constexpr Shading kSmooth{ShadingKind::smooth, 30};

TEST(MeshNormals, HaveTheCodesOfTheirAxes) {
    EXPECT_EQ(packed_normal({0, 0, 5}), 0u);
    EXPECT_EQ(packed_normal({2, 0, 0}), 0x00007FFFu);
    EXPECT_EQ(packed_normal({0, -1, 0}), 0x80010000u);
    EXPECT_EQ(packed_normal({0, 0, -1}), 0x7FFF7FFFu);
    EXPECT_EQ(packed_normal({1, 1, -2}), 0x5FFF5FFFu) << "3/4 of 32767";
}

TEST(MeshNormals, AreWithinFourThousandthsOfADegreeOfWhatWasPacked) {
    std::mt19937 random(20261);
    double largest = 0;
    for (int i = 0; i < 200'000; ++i) {
        const glm::dvec3 n = random_direction(random);
        const uint32_t code = packed_normal(n * 7.0);
        ASSERT_NE(code, VXL_NO_NORMAL);
        largest = std::max(largest, degrees_between(n, unpacked_normal(code)));
    }
    EXPECT_LT(largest, 0.004);
    EXPECT_GT(largest, 0.001) << "the bound says something";
}

TEST(MeshNormals, AreGivenOnlyWhereTheShadingAsksForThem) {
    Mesh mesh = one_triangle();
    EXPECT_THAT(corner_normals(mesh, {}), IsEmpty());
    EXPECT_THAT(corner_normals(mesh, kSmooth), Each(glm::vec3(0, 0, 1)));
    mesh.normals = {{0, 0, 2}, {0, 3, 4}, {1, 0, 0}};
    EXPECT_THAT(corner_normals(mesh, {ShadingKind::flat, 30}), IsEmpty());
    for (const ShadingKind kind : {ShadingKind::automatic, ShadingKind::smooth})
        EXPECT_THAT(corner_normals(mesh, {kind, 30}),
                    ElementsAre(glm::vec3(0, 0, 1), glm::vec3(0, 0.6f, 0.8f), glm::vec3(1, 0, 0)));
    mesh.triangle_normals = {{2, kNoNormal, 0}};
    EXPECT_THAT(corner_normals(mesh, {}),
                ElementsAre(glm::vec3(1, 0, 0), glm::vec3(0), glm::vec3(0, 0, 1)));
}

TEST(MeshNormals, OfABallAreRadial) {
    const Mesh mesh = ball({0.3, -0.2, 0.5}, 0.7, 96, 48);
    const std::vector<glm::vec3> normals = corner_normals(mesh, kSmooth);
    double largest = 0;
    for (size_t i = 0; i < normals.size(); ++i) {
        const glm::dvec3 p(mesh.positions[mesh.triangles[i / 3][int(i % 3)]]);
        largest = std::max(largest,
                           degrees_between(glm::dvec3(normals[i]), p - glm::dvec3(0.3, -0.2, 0.5)));
    }
    EXPECT_LT(largest, 0.12);
}

/// A cube's corner has three, four, five or six triangles; by angles its normal is always the
/// diagonal.
TEST(MeshNormals, DontDependOnHowAFaceIsCutIntoTriangles) {
    const Mesh cube = box({-1, -1, -1}, {1, 1, 1});
    const std::vector<glm::vec3> round = corner_normals(cube, {ShadingKind::smooth, 90});
    const std::vector<glm::vec3> sharp = corner_normals(cube, {ShadingKind::smooth, 89});
    for (size_t i = 0; i < round.size(); ++i) {
        const glm::uvec3& t = cube.triangles[i / 3];
        const glm::dvec3 p(cube.positions[t[int(i % 3)]]);
        const glm::dvec3 a(cube.positions[t.x]);
        const glm::dvec3 face =
            glm::cross(glm::dvec3(cube.positions[t.y]) - a, glm::dvec3(cube.positions[t.z]) - a);
        EXPECT_LT(degrees_between(glm::dvec3(round[i]), p), 1e-5) << i;
        EXPECT_LT(degrees_between(glm::dvec3(sharp[i]), face), 1e-5) << i;
    }
}

TEST(MeshNormals, JoinVerticesAtOnePosition) {
    const Mesh joined = ball({0, 0, 0}, 1, 24, 12);
    Mesh apart;
    for (const glm::uvec3& t : joined.triangles) {
        const auto first = uint32_t(apart.positions.size());
        for (int i = 0; i < 3; ++i) apart.positions.push_back(joined.positions[t[i]]);
        apart.triangles.emplace_back(first, first + 1, first + 2);
    }
    EXPECT_EQ(corner_normals(apart, kSmooth), corner_normals(joined, kSmooth));
}

TEST(MeshNormals, AFanOfManyFacesKeepsItsFacesNormalsAtTheTip) {
    Mesh cone;
    constexpr uint32_t kFaces = 200'000;
    cone.positions.emplace_back(0, 1, 0);
    for (uint32_t i = 0; i < kFaces; ++i) {
        const double turn = 2 * std::numbers::pi * i / kFaces;
        cone.positions.emplace_back(std::cos(turn), 0, -std::sin(turn));
        cone.triangles.emplace_back(0, 1 + i, 1 + (i + 1) % kFaces);
    }
    const std::vector<glm::vec3> normals = corner_normals(cone, kSmooth);
    EXPECT_LT(degrees_between(glm::dvec3(normals[0]), {1, 1, 0}), 0.1);
}

TEST(MeshNormals, FollowPlanesThroughAMap) {
    Mesh mesh = one_triangle();
    mesh.normals = {{1, 2, 3}, {-2, 1, 4}, {0, 1, 1}};
    glm::dmat4 map = glm::rotate(glm::dmat4(1), 0.7, glm::dvec3(1, 2, -1));
    map = glm::scale(map, {2, 0.5, 3});
    map[1][0] += 0.4;
    const std::vector<glm::vec3> normals = corner_normals(mesh, {});
    const std::vector<uint32_t> codes =
        packed_normals(mesh, normals, glm::inverseTranspose(glm::dmat3(map)));
    for (size_t i = 0; i < 3; ++i) {
        const glm::dvec3 n(mesh.normals[i]);
        const glm::dvec3 u = glm::cross(n, {1, 0, 0}), v = glm::cross(n, {0, 1, 0});
        const glm::dvec3 there = unpacked_normal(codes[i]);
        EXPECT_LT(std::abs(degrees_between(there, glm::dmat3(map) * u) - 90), 0.01);
        EXPECT_LT(std::abs(degrees_between(there, glm::dmat3(map) * v) - 90), 0.01);
        EXPECT_GT(glm::dot(there, glm::dmat3(map) * n), 0);
    }
}

TEST(MeshNormals, ThatPointToTheBackAreTurnedOver) {
    Mesh mesh = one_triangle();
    mesh.normals = {{0, 0.1f, -1}, {0.2f, 0, -1}, {0, 0, -1}};
    const std::vector<uint32_t> codes =
        packed_normals(mesh, corner_normals(mesh, {}), glm::dmat3(1));
    for (const uint32_t code : codes) EXPECT_GT(unpacked_normal(code).z, 0.9);
}

TEST(MeshNormals, AreNoneWhereACornerHasNone) {
    Mesh mesh = one_triangle();
    mesh.triangles.push_back({0, 2, 1});
    mesh.normals = {{0, 0, 1}, {0, 0, 0}};
    mesh.triangle_normals = {{0, 0, 0}, {0, 1, 0}};
    const std::vector<uint32_t> codes =
        packed_normals(mesh, corner_normals(mesh, {}), glm::dmat3(1));
    EXPECT_THAT(codes, ElementsAre(0u, 0u, 0u, VXL_NO_NORMAL, VXL_NO_NORMAL, VXL_NO_NORMAL));
}

TEST(MeshNormals, TurnWithAMorph) {
    Mesh from = one_triangle(), to = one_triangle();
    from.normals = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    to.normals = {{0, 4, 0}, {0, 1, 0}, {0, 2, 0}};
    const Mesh half_way = morphed(from, to, 0.5, "here");
    EXPECT_THAT(half_way.normals, ElementsAre(glm::vec3(0.5f, 0.5f, 0), glm::vec3(0, 1, 0),
                                              glm::vec3(0, 0.5f, 0.5f)));
    to.normals.clear();
    EXPECT_THAT(morphed(from, to, 0.5, "here").normals, IsEmpty());
    const Mesh sphere = morphed_to_sphere(from, {0, 0, -1}, 1, 1);
    const std::vector<glm::vec3> normals = corner_normals(sphere, {});
    EXPECT_LT(degrees_between(glm::dvec3(normals[1]), {3, 0, 1}), 1e-4);
}

}  // namespace
}  // namespace voxelume
