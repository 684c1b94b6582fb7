// SPDX-License-Identifier: Apache-2.0
#include "runtime/stages/voxelize/voxelize.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "tests/support/voxelize_fixture.hpp"

namespace voxelume {
namespace {

using glm::ivec3;
using glm::vec3;

std::string covers_as_oracle(const Mesh& mesh, const ivec3& size) {
    return difference(voxels_of(mesh, size, VoxelSet::supercover), exact_supercover(mesh, size));
}

TEST(Supercover, OfATriangleInsideOneLayerIsThatLayer) {
    const Mesh mesh = single_triangle({0.2f, 0.2f, 0.5f}, {2.8f, 0.2f, 0.5f}, {0.2f, 2.8f, 0.5f});
    const VoxelSetOf expected{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {0, 1, 0},
                              {1, 1, 0}, {0, 2, 0}, {2, 1, 0}, {1, 2, 0}};
    // The hypotenuse x + y = 3 touches the corners (2,1) and (1,2).
    EXPECT_EQ(difference(voxels_of(mesh, {7, 5, 3}, VoxelSet::supercover), expected), "");
    EXPECT_EQ(covers_as_oracle(mesh, {7, 5, 3}), "");
}

TEST(Supercover, OfATriangleOnAGridPlaneMarksBothLayersAndThinMarksTheUpper) {
    const Mesh mesh = single_triangle({0.2f, 0.2f, 1.0f}, {2.8f, 0.2f, 1.0f}, {0.2f, 2.8f, 1.0f});
    const VoxelSetOf cover = voxels_of(mesh, {7, 5, 3}, VoxelSet::supercover);
    VoxelSetOf upper, lower;
    for (const ivec3& v : cover) {
        if (v.z == 0) lower.insert(v + ivec3(0, 0, 1));
        if (v.z == 1) upper.insert(v);
    }
    EXPECT_EQ(upper.size(), 8u);
    EXPECT_EQ(difference(lower, upper), "");
    const VoxelSetOf thin = voxels_of(mesh, {7, 5, 3}, VoxelSet::thin);
    EXPECT_FALSE(thin.empty());
    for (const ivec3& v : thin) EXPECT_EQ(v.z, 1);
    EXPECT_EQ(difference(thin, exact_thin(mesh, {7, 5, 3})), "");
}

TEST(Solid, OfABoxOnGridPlanesIsItsVoxelsAndSupercoverTouchesAllAround) {
    const Mesh mesh = box_mesh({1, 1, 1}, {3, 3, 3});
    const ivec3 size(5, 4, 6);
    EXPECT_EQ(difference(voxels_of(mesh, size, VoxelSet::solid),
                         voxels_where(size,
                                      [](ivec3 v) {
                                          return glm::all(glm::greaterThanEqual(v, ivec3(1))) &&
                                                 glm::all(glm::lessThan(v, ivec3(3)));
                                      })),
              "");
    EXPECT_EQ(voxels_of(mesh, size, VoxelSet::supercover).size(), 64u);
}

TEST(Supercover, OfCollinearEqualAndSingleCornersIsThatOfTheSegmentOrPoint) {
    const ivec3 size(21, 12, 13);
    EXPECT_EQ(
        covers_as_oracle(
            single_triangle({3.2f, 3.2f, 3.2f}, {6.7f, 6.7f, 6.7f}, {9.9f, 9.9f, 9.9f}), size),
        "");
    EXPECT_EQ(covers_as_oracle(
                  single_triangle({3.25f, 3.25f, 3.25f}, {3.25f, 3.25f, 3.25f}, {20, 9, 9}), size),
              "");
    const Mesh point = single_triangle({2, 2, 2}, {2, 2, 2}, {2, 2, 2});
    EXPECT_EQ(voxels_of(point, size, VoxelSet::supercover), (VoxelSetOf{{1, 1, 1},
                                                                        {2, 1, 1},
                                                                        {1, 2, 1},
                                                                        {2, 2, 1},
                                                                        {1, 1, 2},
                                                                        {2, 1, 2},
                                                                        {1, 2, 2},
                                                                        {2, 2, 2}}));
    EXPECT_TRUE(voxels_of(point, size, VoxelSet::thin).empty());
}

TEST(Supercover, OfATriangleOneUlpAboveAPlaneIsExact) {
    const ivec3 size(19, 18, 9);
    for (const float z : {7.0f, std::nextafter(7.0f, 8.0f), std::nextafter(7.0f, 6.0f)})
        EXPECT_EQ(covers_as_oracle(
                      single_triangle({1.3f, 1.1f, 7}, {17.2f, 2.4f, 7}, {4.6f, 16.9f, z}), size),
                  "");
}

/// A random triangle of a kind that floats get wrong. `kind` is 0 small, 1 sliver, 2 on half
/// voxels, 3 nearly in a grid plane, 4 large and partly outside, 5 collinear.
Mesh random_triangle(std::mt19937& random, int kind) {
    std::uniform_real_distribution<float> at(-1.0f, 1.0f);
    const auto vector = [&](float size) { return vec3(at(random), at(random), at(random)) * size; };
    const vec3 middle = vec3(17, 10, 9) + vector(6);
    if (kind == 0)
        return single_triangle(middle + vector(4), middle + vector(4), middle + vector(4));
    if (kind == 1) {
        const vec3 a = vector(15);
        return single_triangle(middle - a, middle + a, middle + vector(1e-3f));
    }
    if (kind == 2)
        return single_triangle(glm::round(middle + vector(5)), glm::round(middle * 2.0f) / 2.0f,
                               glm::round(2.0f * (middle + vector(6))) / 2.0f);
    if (kind == 3)
        return single_triangle({middle.x, middle.y, 7}, {middle.y, middle.x, 7},
                               {middle.z, 3, 7 + at(random) * 1e-3f});
    if (kind == 4)
        return single_triangle(middle + vector(90), middle + vector(90), middle + vector(90));
    const vec3 a = glm::round(vector(4) * 16.0f) / 16.0f, b = glm::round(middle * 16.0f) / 16.0f;
    return single_triangle(b, b + a, b + a * 2.0f);
}

TEST(Voxelize, RandomNastyTrianglesMatchTheExactOracle) {
    const ivec3 size(35, 21, 18);
    for (int kind = 0; kind < 6; ++kind)
        for (unsigned seed = 0; seed < 25; ++seed) {
            std::mt19937 random(seed * 6 + unsigned(kind));
            const Mesh mesh = random_triangle(random, kind);
            ASSERT_EQ(covers_as_oracle(mesh, size), "") << "kind " << kind << " seed " << seed;
            if (seed < 6) {
                ASSERT_EQ(difference(voxels_of(mesh, size, VoxelSet::thin), exact_thin(mesh, size)),
                          "")
                    << "kind " << kind << " seed " << seed;
            }
        }
}

TEST(Supercover, OfAGiantTriangleFarBeyondTheFrameIsExact) {
    const Mesh mesh = single_triangle({-9000.3f, -7100.7f, -3000.1f}, {8000.9f, -2000.3f, 5000.7f},
                                      {-3000.2f, 9000.1f, -1000.9f});
    GridFrame frame = unit_frame({40, 39, 25});
    // A point of the plane inside the triangle is moved to the frame's middle.
    const vec3 middle = (mesh.positions[0] + mesh.positions[1] + mesh.positions[2]) / 3.0f;
    frame.origin = glm::dvec3(glm::floor(middle)) - glm::dvec3(20, 19, 12);
    Mesh moved = mesh;
    for (vec3& p : moved.positions) p = vec3(glm::dvec3(p) - frame.origin);
    EXPECT_EQ(covers_as_oracle(moved, frame.size), "");
    EXPECT_FALSE(voxels_of(moved, frame.size, VoxelSet::supercover).empty());
    EXPECT_EQ(
        difference(voxels_of(moved, frame.size, VoxelSet::thin), exact_thin(moved, frame.size)),
        "");
}

TEST(Voxelize, TrianglesOnTheFramesFacesAndOutsideAreClipped) {
    const ivec3 size(17, 16, 5);
    EXPECT_EQ(covers_as_oracle(single_triangle({0, 1, 1}, {0, 9, 1}, {0, 1, 4}), size), "");
    EXPECT_EQ(covers_as_oracle(single_triangle({17, 1, 1}, {17, 9, 1}, {17, 1, 4}), size), "");
    EXPECT_EQ(covers_as_oracle(single_triangle({-5, -3, -2}, {30, 9, 1}, {3, 40, 4}), size), "");
    EXPECT_TRUE(
        voxels_of(single_triangle({-5, 1, 1}, {-2, 9, 1}, {-3, 1, 4}), size, VoxelSet::supercover)
            .empty());
    EXPECT_TRUE(
        voxels_of(single_triangle({25, 1, 1}, {22, 9, 1}, {23, 1, 4}), size, VoxelSet::supercover)
            .empty());
}

TEST(Voxelize, ASplitQuadHasTheSameVoxelsAsTwoTriangles) {
    const auto corner = [](int i, int j) {  // a lattice plane: every split is the same surface
        return vec3(2, 3, 4) + vec3(1.25f, 0.5f, 0.25f) * float(i) +
               vec3(-0.25f, 1, 0.75f) * float(j);
    };
    Mesh two, many;
    add_triangle(two, corner(0, 0), corner(10, 0), corner(10, 10));
    add_triangle(two, corner(0, 0), corner(10, 10), corner(0, 10));
    for (int i = 0; i < 10; ++i)
        for (int j = 0; j < 10; ++j) {
            add_triangle(many, corner(i, j), corner(i + 1, j), corner(i, j + 1));
            add_triangle(many, corner(i + 1, j), corner(i + 1, j + 1), corner(i, j + 1));
        }
    for (const VoxelSet set : {VoxelSet::supercover, VoxelSet::thin})
        EXPECT_EQ(difference(voxels_of(many, {20, 19, 18}, set), voxels_of(two, {20, 19, 18}, set)),
                  "");
}

TEST(Voxelize, OrderOfTrianglesAndCornersMakesNoDifference) {
    Mesh mesh = torus_mesh({16, 15, 9}, 10, 4, 23, 11);
    const ivec3 size(33, 31, 18);
    std::vector<VoxelSetOf> expected;
    const auto sets = {VoxelSet::supercover, VoxelSet::thin, VoxelSet::solid};
    for (const VoxelSet set : sets) expected.push_back(voxels_of(mesh, size, set));
    std::mt19937 random(5);
    std::shuffle(mesh.triangles.begin(), mesh.triangles.end(), random);
    for (glm::uvec3& t : mesh.triangles) t = {t.y, t.z, t.x};
    size_t i = 0;
    for (const VoxelSet set : sets)
        EXPECT_EQ(difference(voxels_of(mesh, size, set), expected[i++]), "");
    // Every second triangle is turned over; for shells that makes no difference, either.
    for (i = 0; i < mesh.triangles.size(); i += 2)
        std::swap(mesh.triangles[i].y, mesh.triangles[i].z);
    for (i = 0; i < 2; ++i)
        EXPECT_EQ(difference(voxels_of(mesh, size, *(sets.begin() + i)), expected[i]), "");
}

TEST(Voxelize, AMapMovesVoxelsAlongAndMirrorsAxes) {
    const Mesh mesh = torus_mesh({16, 15, 9}, 9.3f, 4.1f, 23, 11);
    // The map takes x -> y, y -> z, z -> 40 - x; it doubles lengths in voxels half as large.
    const glm::dmat4 map(glm::dvec4(0, 2, 0, 0), glm::dvec4(0, 0, 2, 0), glm::dvec4(-2, 0, 0, 0),
                         glm::dvec4(80, 0, 0, 1));
    GridFrame frame = unit_frame({41, 33, 31});
    frame.voxel_edge = glm::dvec3(2);
    for (const VoxelSet set : {VoxelSet::supercover, VoxelSet::solid}) {
        const VoxelSetOf expected = voxels_of(mesh, {33, 31, 18}, set);
        VoxelSetOf back;
        for (const ivec3& v :
             occupied_voxels(shared_voxelizer().voxelize(mesh, map, frame, cubes(set))))
            back.insert({v.y, v.z, 39 - v.x});
        EXPECT_EQ(difference(back, expected), "");
    }
}

TEST(Thin, OfAClosedMeshStopsA6ConnectedFlood) {
    const Mesh mesh = torus_mesh({16, 15, 9}, 9.7f, 4.3f, 31, 17);
    const ivec3 size(33, 31, 18);
    const VoxelSetOf wall = voxels_of(mesh, size, VoxelSet::thin);
    const VoxelSetOf solid = voxels_of(mesh, size, VoxelSet::solid);
    VoxelSetOf reached{{0, 0, 0}};
    std::vector<ivec3> open{{0, 0, 0}};
    while (!open.empty()) {
        const ivec3 v = open.back();
        open.pop_back();
        for (int a = 0; a < 3; ++a)
            for (const int step : {-1, 1}) {
                ivec3 n = v;
                n[a] += step;
                if (n[a] < 0 || n[a] >= size[a] || wall.count(n)) continue;
                if (reached.insert(n).second) open.push_back(n);
            }
    }
    size_t inside = 0;
    for (const ivec3& v : solid) inside += !wall.count(v);
    EXPECT_GT(inside, 1000u);
    for (const ivec3& v : solid) EXPECT_TRUE(!reached.count(v) || wall.count(v));
}

void expect_error(const Mesh& mesh, ErrorKind kind, const char* words) {
    try {
        shared_voxelizer().voxelize(mesh, glm::dmat4(1), unit_frame({8, 7, 6}), VoxelizeOptions{});
        FAIL() << "no error";
    } catch (const Error& error) {
        EXPECT_EQ(error.kind(), kind);
        EXPECT_THAT(error.what(), testing::HasSubstr(words));
    }
}

TEST(Voxelize, RefusesMeshesThatAreNone) {
    expect_error(Mesh{}, ErrorKind::input, "no triangles");
    const float infinity = std::numeric_limits<float>::infinity();
    expect_error(single_triangle({1, NAN, 1}, {2, 2, 2}, {3, 1, 2}), ErrorKind::input,
                 "vertex 0 of the mesh is not a finite point");
    expect_error(single_triangle({1, 1, 1}, {2, infinity, 2}, {3, 1, 2}), ErrorKind::input,
                 "vertex 1");
    expect_error(single_triangle({1, 1, 1}, {2, 2, 2}, {3, 1e30f, 2}), ErrorKind::limit,
                 "vertex 2");
    Mesh mesh = single_triangle({1, 1, 1}, {2, 2, 2}, {3, 1, 2});
    mesh.triangles[0].z = 9;
    expect_error(mesh, ErrorKind::input, "names vertex 9, but the mesh has 3");
}

TEST(FrameAround, HoldsTheMeshPlusItsMargin) {
    const GridFrame frame = frame_around(
        single_triangle({1, 2, 3}, {2, 2.5f, 3}, {1.5f, 3.7f, 3.21f}), {0.1, 0.2, 0.05}, 4);
    EXPECT_EQ(frame.size, ivec3(18, 17, 13));
    EXPECT_EQ(frame.origin, glm::dvec3(1, 2, 3) - glm::dvec3(0.4, 0.8, 0.2));
}

}  // namespace
}  // namespace voxelume
