// SPDX-License-Identifier: Apache-2.0
// Colours of faces, strips of triangles, and the colours that two programs hide in STL.
#include "tests/io/mesh/mesh_refusal.hpp"
#include "tests/io/mesh/mesh_samples.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace voxelume {
namespace {

using glm::uvec3;
using glm::vec3;
using testing::Each;
using testing::ElementsAre;
using testing::FloatNear;
using testing::HasSubstr;
using testing::IsEmpty;

const std::string kVertices =
    "element vertex 5\nproperty float x\nproperty float y\nproperty float z\n";
const std::string kPositions = "0 0 0\n7 0 0\n7 5 0\n0 5 0\n3 2 9\n";

std::string ply(const std::string& elements, const std::string& body) {
    return "ply\nformat ascii 1.0\n" + kVertices + elements + "end_header\n" + kPositions + body;
}

/// The colour of a corner of a triangle.
vec3 color(const Mesh& mesh, size_t triangle, int corner) {
    return mesh.vertex_colors.at(mesh.triangle_colors.at(triangle)[corner]);
}

/// The binary pyramid with these attribute words, whose header begins with `title`.
Mesh stl(const std::string& title, const std::vector<uint16_t>& words) {
    std::string bytes = samples::stl_binary(title);
    for (size_t i = 0; i < words.size(); ++i) {
        bytes[84 + 50 * i + 48] = char(words[i] & 255);
        bytes[84 + 50 * i + 49] = char(words[i] >> 8);
    }
    return parse_mesh(bytes, "a.stl");
}

}  // namespace

TEST(MeshColors, OfAPlyFaceAreThoseOfAllItsTriangles) {
    const Mesh mesh = parse_mesh(
        ply("element face 2\nproperty uchar green\nproperty list uchar int vertex_indices\n"
            "property uchar red\nproperty uchar blue\n",
            "51 4 0 1 2 3 255 0\n0 3 0 1 4 0 255\n"),
        "a.ply");
    ASSERT_EQ(mesh.triangles.size(), 3u);
    ASSERT_EQ(mesh.triangle_colors.size(), 3u);
    for (int corner = 0; corner < 3; ++corner) {
        EXPECT_EQ(color(mesh, 0, corner), vec3(1, 0.033104766f, 0));
        EXPECT_EQ(color(mesh, 1, corner), vec3(1, 0.033104766f, 0));
        EXPECT_EQ(color(mesh, 2, corner), vec3(0, 0, 1));
    }
}

TEST(MeshColors, OfPlyVerticesGoBeforeThoseOfFaces) {
    const std::string text =
        "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty "
        "float z\nproperty uchar red\nproperty uchar green\nproperty uchar blue\nelement face 1\n"
        "property list uchar int vertex_indices\nproperty uchar red\nproperty uchar green\n"
        "property uchar blue\nend_header\n0 0 0 0 255 0\n5 0 0 0 255 0\n0 3 1 0 255 0\n"
        "3 0 1 2 255 0 0\n";
    const Mesh mesh = parse_mesh(text, "a.ply");
    EXPECT_THAT(mesh.vertex_colors, Each(vec3(0, 1, 0)));
    EXPECT_THAT(mesh.triangle_colors, IsEmpty());
}

TEST(MeshColors, OfPlyFacesThatAreNoColorsAreSkipped) {
    const std::string face = "element face 1\nproperty list uchar int vertex_indices\n";
    const std::string three = "property int red\nproperty int green\nproperty int blue\n";
    EXPECT_THAT(parse_mesh(ply(face + three, "3 0 1 2 9 9 9\n"), "a.ply").vertex_colors, IsEmpty());
    EXPECT_THAT(
        parse_mesh(ply(face + "property uchar red\n", "3 0 1 2 9\n"), "a.ply").vertex_colors,
        IsEmpty());
    const std::string floats = "property float red\nproperty float green\nproperty float blue\n";
    EXPECT_EQ(refusal(ply(face + floats, "3 0 1 2 0.5 1.5 0\n"), "a.ply"),
              "a.ply:18: the face's colour has a part of 1.5; colours are from 0 to 1");
}

TEST(MeshStrips, TurnEveryOtherTriangleRoundAndBeginAgainAtMinusOne) {
    const Mesh mesh = parse_mesh(ply("element tristrips 2\nproperty list int int vertex_indices\n",
                                     "8 0 1 2 3 -1 4 2 1\n5 0 0 1 2 4\n"),
                                 "a.ply");
    EXPECT_THAT(mesh.triangles, ElementsAre(uvec3(0, 1, 2), uvec3(2, 1, 3), uvec3(4, 2, 1),
                                            uvec3(1, 0, 2), uvec3(1, 2, 4)));
}

TEST(MeshStrips, AreRefusedWhereTheyNameNoVertex) {
    const std::string strips = "element tristrips 1\nproperty list int int vertex_indices\n";
    EXPECT_EQ(refusal(ply(strips, "4 0 1 2 5\n"), "a.ply"),
              "a.ply:15: a strip names vertex 5, and 5 vertices (from 0) precede it");
    EXPECT_THAT(refusal(ply(strips, "4 0 1 -2 3\n"), "a.ply"), HasSubstr("names vertex -2"));
    EXPECT_THAT(refusal(ply("element tristrips 1\nproperty int vertex_indices\n", "4\n"), "a.ply"),
                HasSubstr("the tristrips have no list of whole numbers"));
    EXPECT_THAT(refusal(ply(strips, "3 0 0 1\n"), "a.ply"), HasSubstr("faces, and no triangles"));
}

TEST(MeshColors, OfVisCamHaveBlueInTheLowestBits) {
    const Mesh mesh = stl("made by a test", {0x8000 | 31, 0, 0x8000 | 31 << 10});
    EXPECT_EQ(color(mesh, 0, 0), vec3(0, 0, 1));
    EXPECT_EQ(color(mesh, 1, 1), vec3(1)) << "no colour of its own";
    EXPECT_EQ(color(mesh, 2, 2), vec3(1, 0, 0));
    EXPECT_EQ(color(mesh, 5, 0), vec3(1));
    EXPECT_THAT(stl("made by a test", {31, 7}).vertex_colors, IsEmpty());
}

TEST(MeshColors, OfMagicsHaveRedInTheLowestBitsAndOneOfThePartInTheHeader) {
    const std::string header = std::string("part COLOR=") + '\0' + '\x33' + '\xFF' + '\xFF';
    const Mesh mesh = stl(header, {31, 0x8000 | 31, 16 << 5});
    EXPECT_EQ(color(mesh, 0, 0), vec3(1, 0, 0));
    EXPECT_EQ(color(mesh, 1, 0), vec3(0, 0.033104766f, 1));
    EXPECT_THAT(color(mesh, 2, 1).y, FloatNear(0.2293f, 1e-3f));  // sRGB 16/31
    EXPECT_EQ(mesh.triangle_colors.size(), 6u);
}

TEST(MeshColors, OfObjFromZeroTo255AreBytesWhichIsAssumed) {
    const Mesh mesh = parse_mesh("v 0 0 0 255 0 51\nv 5 0 0\nv 0 3 1 0 255 1\nf 1 2 3\n", "a.obj");
    EXPECT_EQ(mesh.vertex_colors.at(0), vec3(1, 0, 0.033104766f));
    EXPECT_EQ(mesh.vertex_colors.at(1), vec3(1)) << "no colour of its own";
    EXPECT_THAT(mesh.vertex_colors.at(2).z, FloatNear(1 / 255.0f / 12.92f, 1e-8f));
    EXPECT_THAT(mesh.assumptions, ElementsAre(HasSubstr("colours of vertices from 0 to 255")));
    const Mesh plain = parse_mesh("v 0 0 0 1 0 0.2\nv 5 0 0\nv 0 3 1 0 1 0\nf 1 2 3\n", "a.obj");
    EXPECT_EQ(plain.vertex_colors, (std::vector<vec3>{{1, 0, 0.033104766f}, vec3(1), {0, 1, 0}}));
    EXPECT_THAT(plain.assumptions, IsEmpty());
    EXPECT_EQ(refusal("v 0 0 0 0 0 0\nv 5 0 0 0 256 0\nv 0 3 1\nf 1 2 3\n", "a.obj"),
              "a.obj:2: the vertex's colour has a part of 256; colours are from 0 to 1, or to 255");
    EXPECT_THAT(refusal("v 0 0 0 0 0 -1\nv 5 0 0\nv 0 3 1\nf 1 2 3\n", "a.obj"),
                HasSubstr("a.obj:1: the vertex's colour has a part of -1;"));
    EXPECT_THAT(refusal("v 0 0 0 1 0 0\nv 5 0 0 0.5 1.25 0\nv 0 3 1\nf 1 2 3\n", "a.obj"),
                HasSubstr("a.obj:2: the vertex's colour has a part above 1"));
    EXPECT_THAT(refusal("v 0 0 0 1 0 0\nv 5 0 0 0.5 2.5 0\nv 0 3 1\nf 1 2 3\n", "a.obj"),
                HasSubstr("none of the file is above 2.5"));
    EXPECT_THAT(
        parse_mesh("v 0 0 0 99.5 0 0\nv 5 0 0 0 0 0\nv 0 3 1\nf 1 2 3\n", "a.obj").assumptions,
        ElementsAre(HasSubstr("from 0 to 255")));
}

}  // namespace voxelume
