// SPDX-License-Identifier: Apache-2.0
// Meshes that morph into other shapes.
#include "runtime/geometry/mesh_morph.hpp"

#include <gmock/gmock.h>

#include "runtime/base/error.hpp"

namespace voxelume {
namespace {

using testing::HasSubstr;

Mesh irregular_tetrahedron() {
    Mesh mesh;
    mesh.positions = {{1, 0, 0}, {0, 2, 0}, {0, 0, 3}, {-1, -1, -1}};
    mesh.triangles = {{0, 1, 2}, {0, 3, 1}, {0, 2, 3}, {1, 3, 2}};
    return mesh;
}

std::string refusal(const Mesh& from, const Mesh& to) {
    try {
        morphed(from, to, 0.5, "s.json:3:4: models.m");
    } catch (const Error& error) {
        EXPECT_EQ(error.kind(), ErrorKind::input);
        return error.what();
    }
    return "nothing";
}

}  // namespace

TEST(Morph, MovesVerticesAlongStraightWaysAndEndsExactly) {
    const Mesh from = irregular_tetrahedron();
    Mesh to = from;
    for (glm::vec3& p : to.positions) p = glm::vec3(p.y + 0.1f, p.z - 0.3f, p.x * 5);
    EXPECT_EQ(morphed(from, to, 0, "").positions, from.positions);
    EXPECT_EQ(morphed(from, to, 1, "").positions, to.positions);
    const Mesh quarter = morphed(from, to, 0.25, "");
    EXPECT_EQ(quarter.triangles, from.triangles);
    EXPECT_FLOAT_EQ(quarter.positions[2].z, 2.25f);
    EXPECT_FLOAT_EQ(quarter.positions[2].y, 0.25f * 2.7f);
    EXPECT_FLOAT_EQ(quarter.positions[2].x, 0.025f);
}

TEST(Morph, LerpsColorsWhereBothEndsHaveThem) {
    Mesh from = irregular_tetrahedron(), to = from;
    from.vertex_colors.assign(4, {1, 0, 0.5f});
    EXPECT_EQ(morphed(from, to, 0.5, "").vertex_colors, from.vertex_colors);
    to.vertex_colors.assign(4, {0, 1, 0.5f});
    EXPECT_EQ(morphed(from, to, 0.25, "").vertex_colors[3], glm::vec3(0.75f, 0.25f, 0.5f));
}

TEST(Morph, RefusesOtherTopologyWithCounts) {
    Mesh more = irregular_tetrahedron();
    more.positions.push_back({5, 5, 5});
    EXPECT_THAT(refusal(irregular_tetrahedron(), more),
                HasSubstr("s.json:3:4: models.m: the two meshes don't match: 4 vertices and 4 "
                          "triangles here, 5 and 4 there"));
    Mesh other = irregular_tetrahedron();
    std::swap(other.triangles[2].x, other.triangles[2].y);
    EXPECT_THAT(refusal(irregular_tetrahedron(), other),
                HasSubstr("of 4 triangles each, number 3 joins"));
}

TEST(Morph, PutsVerticesOnASphereAlongTheirRays) {
    const Mesh from = irregular_tetrahedron();
    const Mesh ball = morphed_to_sphere(from, {0, 0, 1}, 0.5, 1);
    const glm::vec3 expected[] = {
        {0.35355339f, 0, 1 - 0.35355339f},
        {0, 0.4472136f, 1 - 0.2236068f},
        {0, 0, 1.5f},
        {-0.20412415f, -0.20412415f, 1 - 0.4082483f},
    };
    for (size_t i = 0; i < 4; ++i)
        for (int axis = 0; axis < 3; ++axis)
            EXPECT_FLOAT_EQ(ball.positions[i][axis], expected[i][axis]) << i << ' ' << axis;
    EXPECT_EQ(morphed_to_sphere(from, {0, 0, 1}, 0.5, 0).positions, from.positions);
    EXPECT_FLOAT_EQ(morphed_to_sphere(from, {0, 0, 1}, 0.5, 0.5).positions[2].z, 2.25f);
    EXPECT_EQ(morphed_to_sphere(from, {1, 0, 0}, 9, 1).positions[0], glm::vec3(1, 0, 0));
}

}  // namespace voxelume
