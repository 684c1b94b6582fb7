// SPDX-License-Identifier: Apache-2.0
#include "runtime/io/mesh/mesh_reader.hpp"
#include "tests/io/mesh/mesh_refusal.hpp"
#include "tests/io/mesh/mesh_samples.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace voxelume {
namespace {

using glm::uvec3;
using glm::vec3;
using testing::AllOf;
using testing::Each;
using testing::ElementsAre;
using testing::EndsWith;
using testing::HasSubstr;
using testing::StartsWith;

std::string ply(const std::string& vertex, const std::string& face, const std::string& body) {
    return "ply\nformat ascii 1.0\nelement vertex 3\n" + vertex + "element face 1\n" + face +
           "end_header\n" + body;
}
const std::string kPlyVertex = "property float x\nproperty float y\nproperty float z\n";
const std::string kPlyFace = "property list uchar int vertex_indices\n";

}  // namespace

TEST(MeshPly, TakesPropertiesInAnyOrderAndSkipsOthers) {
    const Mesh mesh = parse_mesh(
        "ply\r\nformat ascii 1.0\r\ncomment any\r\nCreated by Blender3D 247\r\nelement vertex "
        "4\r\nproperty list uchar float "
        "w\r\n"
        "property double z\r\nproperty uchar blue\r\nproperty float nx\r\nproperty uchar red\r\n"
        "property short x\r\nproperty uchar green\r\nproperty float y\r\nelement edge 1\r\n"
        "property int a\r\nelement face 1\r\nproperty uchar flag\r\n"
        "property list uchar uint vertex_index\r\nproperty list uchar float uv\r\nend_header\r\n"
        "1 7 0.5 255 nan 0 0 51 0\r\n0 -1e-3 255 nan 0 5 51 0\r\n0 0 255 nan 0 5 51 3\r\n"
        "2 1 1 0 255 nan 0 0 51 3\r\n9\r\n\r\n1 4 3 2 1 0 2 0.5 nan\r\n",
        "a.ply");
    EXPECT_THAT(mesh.positions,
                ElementsAre(vec3(0, 0, 0.5), vec3(5, 0, -1e-3f), vec3(5, 3, 0), vec3(0, 3, 0)));
    EXPECT_THAT(mesh.triangles, ElementsAre(uvec3(3, 2, 1), uvec3(3, 1, 0)));
    EXPECT_THAT(mesh.vertex_colors, Each(vec3(0.0f, 0.033104766f, 1.0f)));
}

TEST(MeshPly, VerticesHaveNormals) {
    const std::string normal = "property float nx\nproperty double nz\nproperty float ny\n";
    const Mesh mesh = parse_mesh(ply(kPlyVertex + normal, kPlyFace,
                                     "0 0 0 1 3 2\n5 0 0 nan 0 0\n0 3 1 0 -1e-2 0\n3 0 1 2\n"),
                                 "a.ply");
    EXPECT_THAT(mesh.normals, ElementsAre(vec3(1, 2, 3), vec3(0), vec3(0, 0, -0.01f)));
    EXPECT_TRUE(mesh.triangle_normals.empty()) << "as the positions";
    const std::string two = "property float nx\nproperty float ny\n";
    EXPECT_TRUE(
        parse_mesh(ply(kPlyVertex + two, kPlyFace, "0 0 0 1 3\n5 0 0 inf 0\n0 3 1 0 -1\n3 0 1 2\n"),
                   "a.ply")
            .normals.empty());
}

TEST(MeshPly, TakesFloatColors) {
    const Mesh mesh = parse_mesh(
        ply(kPlyVertex + "property float red\nproperty float green\nproperty float blue\n",
            kPlyFace, "0 0 0 1 0.5 0\n5 0 0 1 0.5 0\n0 3 1 1 0.5 0\n3 0 1 2"),
        "a.ply");
    EXPECT_THAT(mesh.vertex_colors, Each(vec3(1.0f, 0.21404114f, 0.0f)));
}

TEST(MeshPly, KeepsTheNameOfItsTexture) {
    const auto texture = [](const std::string& first, const std::string& second) {
        return parse_mesh("ply\n" + first + "format ascii 1.0\n" + second + "element vertex 3\n" +
                              kPlyVertex + "element face 1\n" + kPlyFace +
                              "end_header\n0 0 0\n5 0 0\n0 3 1\n3 0 1 2",
                          "a.ply")
            .texture;
    };
    EXPECT_EQ(texture("comment any\n", "comment TextureFile\n"), "");
    EXPECT_EQ(texture("", "comment TextureFile my wood.png\r\n"), "my wood.png");
    EXPECT_EQ(texture("comment TextureFile a.png\n", "comment TextureFile b.png\n"), "a.png");
}

TEST(MeshPly, RefusesDamageWithTheLine) {
    const std::string body = "0 0 0\n5 0 0\n0 3 1\n";
    const auto damaged = [&](const std::string& rest) {
        return refusal(ply(kPlyVertex, kPlyFace, rest), "a.ply");
    };
    EXPECT_THAT(damaged(body + "3 0 1 3\n"), StartsWith("a.ply:13: a face names vertex 3"));
    EXPECT_THAT(damaged(body + "3 0 1 -1\n"), StartsWith("a.ply:13: a face names vertex -1"));
    EXPECT_THAT(damaged(body + "2 0 1\n"), StartsWith("a.ply:13: a face has 2 corners"));
    EXPECT_THAT(damaged(body + "3 0 1\n"), StartsWith("a.ply:13: the line ends"));
    EXPECT_THAT(damaged(body + "3 0 1 2 2\n"), StartsWith("a.ply:13: \"2\" is one value more"));
    EXPECT_THAT(damaged(body + "3 0 1 2\nmore\n"), StartsWith("a.ply:14: data behind"));
    EXPECT_THAT(damaged(body + "3000000 0 1 2\n"), StartsWith("a.ply:13: a list of 3000000"));
    EXPECT_THAT(damaged("0 0 0\n5 0 inf\n0 3 1\n3 0 1 2\n"), StartsWith("a.ply:11: \"inf\""));
    EXPECT_THAT(damaged("0 0 0\n5 0 0\n0 3 1e39\n3 0 1 2\n"), StartsWith("a.ply:12: \"1e39\""));
    EXPECT_THAT(damaged("0 0 0\n5 0 0\n0 3 1          \n\n"),
                StartsWith("a.ply:14: the file ends"));
    EXPECT_THAT(damaged("0 0 0\n"), AllOf(StartsWith("a.ply: "), HasSubstr("promises 3 elements")));
}

TEST(MeshPly, RefusesHeadersThatItCantFollow) {
    const std::string body = "0 0 0\n5 0 0\n0 3 1\n3 0 1 2\n";
    EXPECT_THAT(refusal("ply\nformat ascii 2.0\n", "a.ply"), StartsWith("a.ply:2: "));
    EXPECT_THAT(refusal("ply\nformat ascii 1.0\nelement vertex x\n", "a.ply"),
                StartsWith("a.ply:3: \"x\""));
    EXPECT_THAT(refusal("ply\nformat ascii 1.0\nproperty int x\n", "a.ply"),
                StartsWith("a.ply:3: "));
    EXPECT_THAT(refusal("ply\nformat ascii 1.0\nelement vertex 3", "a.ply"),
                EndsWith("ends inside the PLY header"));
    EXPECT_THAT(refusal(ply("property quad x\n", kPlyFace, body), "a.ply"),
                StartsWith("a.ply:4: "));
    EXPECT_THAT(refusal(ply("property float x\n", kPlyFace, body), "a.ply"), HasSubstr("'y'"));
    EXPECT_THAT(refusal(ply(kPlyVertex + "property float x\n", kPlyFace, body), "a.ply"),
                HasSubstr("two properties 'x'"));
    EXPECT_THAT(refusal(ply(kPlyVertex + "property int red\n", kPlyFace, body), "a.ply"),
                HasSubstr("'red' must be"));
    EXPECT_THAT(refusal(ply(kPlyVertex, "property float a\n", body), "a.ply"),
                HasSubstr("'vertex_indices'"));
    EXPECT_THAT(refusal("Dear reader", "a.ply"), StartsWith("a.ply:1: "));
}

TEST(MeshPly, ACountBeyondTheFileIsRefusedBeforeMemoryIsTaken) {
    for (const std::string format : {"ascii", "binary_little_endian", "binary_big_endian"}) {
        EXPECT_THAT(refusal("ply\nformat " + format + " 1.0\nelement vertex 999999999999999999\n" +
                                kPlyVertex + "element face 1\n" + kPlyFace + "end_header\n0 0 0\n",
                            "a.ply"),
                    HasSubstr("promises 999999999999999999 elements 'vertex'"));
    }
}

TEST(MeshPly, BinaryDamageIsRefusedWithTheByte) {
    const std::string whole = samples::ply_binary(false, false);
    const size_t header = whole.find("end_header\n") + 11;
    std::string nan = whole;
    nan.replace(header + 16 + 12, 4, "\x00\x00\xC0\x7F", 4);  // z of vertex 1
    EXPECT_THAT(refusal(nan, "a.ply"), AllOf(StartsWith("a.ply: byte "), HasSubstr("vertex 1 ")));
    std::string index = whole;
    index[index.size() - 4] = 5;
    EXPECT_THAT(
        refusal(index, "a.ply"),
        StartsWith("a.ply: byte " + std::to_string(whole.size() - 4) + ": a face names vertex 5"));
    EXPECT_THAT(refusal(whole + "more", "a.ply"),
                StartsWith("a.ply: byte " + std::to_string(whole.size()) + ": data behind"));
    EXPECT_NO_THROW(parse_mesh(whole + "\n", "a.ply"));
}

}  // namespace voxelume
