// SPDX-License-Identifier: Apache-2.0
#include "runtime/io/mesh/mesh_reader.hpp"
#include "tests/io/mesh/mesh_refusal.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace voxelume {
namespace {

using glm::uvec3;
using glm::vec3;
using testing::ElementsAre;
using testing::IsEmpty;
using testing::StartsWith;

/// Three vertices for tests of the lines after them.
const std::string kObjVertices = "v 0 0 0\nv 5 0 0\nv 0 3 1\n";

}  // namespace

TEST(MeshObj, HasItsVerticesTrianglesAndGroups) {
    const Mesh mesh = parse_mesh(
        "# two materials\r\nmtllib house.mtl\r\no house\r\n"
        "v 0 0 0\r\nv 5 0 .25\r\nv 5 3 -1.5e0 1.0\r\nv +0 3 1E1\r\nvn 0 0 1\r\nvt 0.5 0.5\r\n"
        "usemtl red brick \r\nf 1 2 3\r\ng roof\r\nusemtl glass\r\nf 1/1 3/1/1 4//1 # last\r\n"
        "usemtl red brick\r\nf -4 -1 \\\r\n -2",
        "house.obj");
    EXPECT_THAT(mesh.positions,
                ElementsAre(vec3(0, 0, 0), vec3(5, 0, 0.25), vec3(5, 3, -1.5), vec3(0, 3, 10)));
    EXPECT_THAT(mesh.triangles, ElementsAre(uvec3(0, 1, 2), uvec3(0, 2, 3), uvec3(0, 3, 2)));
    EXPECT_THAT(mesh.group_names, ElementsAre("red brick", "glass"));
    EXPECT_THAT(mesh.triangle_group, ElementsAre(0u, 1u, 0u));
    EXPECT_THAT(mesh.vertex_colors, IsEmpty());
    EXPECT_THAT(mesh.material_libraries, ElementsAre("house.mtl"));
}

TEST(MeshObj, KeepsTheNamesOfItsMaterialLibrariesOnce) {
    const auto libraries = [](const std::string& lines) {
        return parse_mesh(lines + kObjVertices + "f 1 2 3\n", "a.obj").material_libraries;
    };
    EXPECT_THAT(libraries(""), IsEmpty());
    EXPECT_THAT(libraries("mtllib my house.mtl \r\nmtllib other.mtl\nmtllib my house.mtl\n"),
                ElementsAre("my house.mtl", "other.mtl"));
    EXPECT_THAT(libraries("mtllib\n"), IsEmpty());
    // A name over two lines is none.
    EXPECT_THAT(libraries("mtllib a.mtl \\\n b.mtl\n"), ElementsAre("a.mtl \\"));
    std::string many;
    for (int i = 0; i < 200; ++i) many += "mtllib " + std::to_string(i) + "\n";
    EXPECT_EQ(libraries(many).size(), 64u);
}

// The bytes of both orders, and a name of two units: U+1F600, D83D DE00.
TEST(MeshObj, TextOfUtf16IsRead) {
    for (const bool is_big : {true, false}) {
        std::string bytes;
        const auto add = [&](unsigned unit) {
            const char high = char(unit >> 8), low = char(unit & 255);
            bytes += is_big ? high : low;
            bytes += is_big ? low : high;
        };
        add(0xFEFF);
        for (const char c : kObjVertices + "usemtl ") add(static_cast<unsigned char>(c));
        for (const unsigned unit : {0xE9u, 0x20ACu, 0xD83Du, 0xDE00u, 0xD83Du}) add(unit);
        for (const char c : std::string("\nf 1 2 3")) add(static_cast<unsigned char>(c));
        const Mesh mesh = parse_mesh(bytes, "a.obj");
        EXPECT_THAT(mesh.positions, ElementsAre(vec3(0), vec3(5, 0, 0), vec3(0, 3, 1)));
        EXPECT_THAT(mesh.group_names,
                    ElementsAre("\xC3\xA9\xE2\x82\xAC\xF0\x9F\x98\x80\xEF\xBF\xBD"));
    }
}

TEST(MeshObj, FacesBeforeTheFirstMaterialAreInTheUnnamedGroup) {
    const Mesh mesh =
        parse_mesh(kObjVertices + "f 1 2 3\nusemtl unused\nusemtl b\nf 3 2 1\n", "a.obj");
    EXPECT_THAT(mesh.group_names, ElementsAre("", "b"));
    EXPECT_THAT(mesh.triangle_group, ElementsAre(0u, 1u));
}

TEST(MeshObj, OneMaterialNeedsNoGroupPerTriangle) {
    const Mesh mesh = parse_mesh(kObjVertices + "usemtl b\nf 3 2 1\n", "a.obj");
    EXPECT_THAT(mesh.group_names, ElementsAre("b"));
    EXPECT_THAT(mesh.triangle_group, IsEmpty());
    EXPECT_THAT(parse_mesh(kObjVertices + "g b\nf 3 2 1", "a.obj").group_names, IsEmpty());
}

TEST(MeshObj, VertexColorsBecomeLinearAndWhiteWhereMissing) {
    const Mesh mesh = parse_mesh("v 0 0 0\nv 5 0 0 1 0.5 0.02\nv 0 3 1\nf 1 2 3\n", "a.obj");
    ASSERT_EQ(mesh.vertex_colors.size(), 3u);
    EXPECT_EQ(mesh.vertex_colors[0], vec3(1.0f));
    EXPECT_EQ(mesh.vertex_colors[1], vec3(1.0f, 0.21404114f, 0.00154798757f));
    EXPECT_EQ(mesh.vertex_colors[2], vec3(1.0f));
}

TEST(MeshObj, CornersHaveTheNormalsThatTheyName) {
    const Mesh mesh = parse_mesh(
        "vn 0 0 1\nv 0 0 0\nv 5 0 0\nv 5 3 0\nv 0 3 0\nvn 0 2 0 \nf 1//1 2/7/2 3//-1 4//3\n"
        "f 1 2 3\nf 3//9 2//1 1//0\nvn 1e0 -.5 \\\n 2\n",
        "a.obj");
    EXPECT_THAT(mesh.normals, ElementsAre(vec3(0, 0, 1), vec3(0, 2, 0), vec3(1, -0.5f, 2)));
    EXPECT_THAT(mesh.triangles.size(), 4u);
    EXPECT_THAT(mesh.triangle_normals, ElementsAre(uvec3(0, 1, 1), uvec3(0, 1, 2), uvec3(kNoNormal),
                                                   uvec3(kNoNormal, 0, kNoNormal)));
}

TEST(MeshObj, NormalsFollowTheCornersOfAConcaveFace) {
    const Mesh mesh = parse_mesh(
        "v 0 0 0\nv 4 0 0\nv 1 1 0\nv 0 4 0\nvn 1 0 0\nvn 2 0 0\nvn 3 0 0\nvn 4 0 0\n"
        "f 4//4 1//1 2//2 3//3\n",
        "a.obj");
    EXPECT_EQ(mesh.triangles.size(), 2u);
    EXPECT_EQ(mesh.triangle_normals, mesh.triangles);
}

TEST(MeshObj, NormalsThatAreNoneAreNoMistake) {
    const std::string v = kObjVertices;
    const std::string none = v + "vn nan 0 0\nvn 1\nvn 1e99 0 0\n", face = "f 1//1 2//2 3//3\n";
    EXPECT_THAT(parse_mesh(none + "vn 0 0 2\n" + face, "a.obj").normals,
                ElementsAre(vec3(0), vec3(0), vec3(0), vec3(0, 0, 2)));
    EXPECT_THAT(parse_mesh(none + face, "a.obj").normals, IsEmpty());
    EXPECT_THAT(parse_mesh(none + face, "a.obj").triangle_normals, IsEmpty());
    EXPECT_THAT(parse_mesh(v + "vn 0 0 1\nf 1 2 3\n", "a.obj").normals, IsEmpty());
    EXPECT_THAT(parse_mesh(v + "f 1//1 2//1 3//1\n", "a.obj").triangle_normals, IsEmpty());
}

TEST(MeshObj, AStatementContinuesBehindABackslash) {
    const Mesh mesh = parse_mesh(
        "v 0 0\\\n 0\nvt 0 \\\n1\nv 5 \\\r\n0 0\nv 0 3 1\n# a comment ends here: \\\nf 1\\\n\\\n 2 "
        "3\\",
        "a.obj");
    EXPECT_THAT(mesh.positions, ElementsAre(vec3(0, 0, 0), vec3(5, 0, 0), vec3(0, 3, 1)));
    EXPECT_THAT(mesh.triangles, ElementsAre(uvec3(0, 1, 2)));
}

TEST(MeshObj, RefusesDamageWithTheLine) {
    const std::string v = kObjVertices;
    EXPECT_THAT(refusal(v + "f 1 2 4\n", "a.obj"), StartsWith("a.obj:4: the face names vertex 4"));
    EXPECT_THAT(refusal(v + "f 0 1 2\n", "a.obj"), StartsWith("a.obj:4: "));
    EXPECT_THAT(refusal(v + "f 1 2 -4\n", "a.obj"), StartsWith("a.obj:4: "));
    EXPECT_THAT(refusal(v + "f 1 2 99999999999999999999\n", "a.obj"), StartsWith("a.obj:4: "));
    EXPECT_THAT(refusal(v + "f 1 2\n", "a.obj"), StartsWith("a.obj:4: 'f' has 2 corners"));
    EXPECT_THAT(refusal(v + "f\n", "a.obj"), StartsWith("a.obj:4: "));
    EXPECT_THAT(refusal(v + "\nf 1 2 3/x\n", "a.obj"), StartsWith("a.obj:5: \"3/x\""));
    EXPECT_THAT(refusal("v nan 0 0\n" + v, "a.obj"), "a.obj:1: \"nan\" is not a finite number");
    EXPECT_THAT(refusal(v + "v 0 -inf 0\n", "a.obj"), StartsWith("a.obj:4: \"-inf\" is not"));
    EXPECT_THAT(refusal(v + "v 0 1e39 0\n", "a.obj"), StartsWith("a.obj:4: \"1e39\" is beyond"));
    EXPECT_THAT(refusal(v + "v 1 2\n", "a.obj"), StartsWith("a.obj:4: 'v' has 2 numbers"));
    EXPECT_THAT(refusal(v + "v 1 2 3 4 5\n", "a.obj"), StartsWith("a.obj:4: 'v' has 5 numbers"));
    EXPECT_THAT(refusal(v + "v 1 2 3 1 1 1 1\n", "a.obj"), StartsWith("a.obj:4: 'v' has more"));
    EXPECT_THAT(refusal(v + "v 1 2 3 0 0 1.5\n", "a.obj"), StartsWith("a.obj:4: the vertex's"));
    EXPECT_THAT(refusal("Dear reader,\nv 0 0 0\n", "a.obj"),
                StartsWith("a.obj:1: \"Dear\" is no statement"));
    EXPECT_THAT(refusal(v + std::string("f 1 2 3\n\0", 9), "a.obj"), StartsWith("a.obj: byte 32"));
    EXPECT_THAT(refusal("vn 0 0 1\n", "a.obj"), "a.obj: the file has neither faces nor vertices");
}

TEST(MeshObj, ShowsPointsAndLinesWhereThereAreNoFaces) {
    const std::string v = kObjVertices;
    EXPECT_THAT(parse_mesh(v, "a.obj").triangles,
                ElementsAre(uvec3(0, 0, 0), uvec3(1, 1, 1), uvec3(2, 2, 2)));
    EXPECT_THAT(parse_mesh(v + "p 1 -1\nl 1/1 2/2 3/3 1 # round\n", "a.obj").triangles,
                ElementsAre(uvec3(0, 0, 0), uvec3(2, 2, 2), uvec3(0, 1, 1), uvec3(1, 2, 2),
                            uvec3(2, 0, 0)));
    EXPECT_THAT(parse_mesh(v + "l 1 2\nf 1 2 3\np 1\n", "a.obj").triangles,
                ElementsAre(uvec3(0, 1, 2)));
    EXPECT_THAT(parse_mesh(v + "p\nl 1 9 2\nl 3 \\\n1\np x\n", "a.obj").triangles,
                ElementsAre(uvec3(2, 0, 0)))
        << "what isn't a line is skipped";
    EXPECT_EQ(refusal(v + "cstype bezier\ndeg 2\ncurv 0 1 1 2 3\nend\n", "a.obj"),
              "a.obj: the file has free-form curves and surfaces alone, which aren't read");
}

}  // namespace voxelume
