// SPDX-License-Identifier: Apache-2.0
#include "runtime/io/mesh/mesh_reader.hpp"

#include "tests/io/mesh/mesh_refusal.hpp"
#include "tests/io/mesh/mesh_samples.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <bit>
#include <filesystem>
#include <fstream>

#include <unistd.h>

namespace voxelume {
namespace {

namespace fs = std::filesystem;
using glm::uvec3;
using glm::vec3;
using testing::AllOf;
using testing::ElementsAre;
using testing::EndsWith;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::StartsWith;

/// Tests with their own folder, which is removed at the end of the test.
class MeshFile : public testing::Test {
  protected:
    MeshFile() : folder_(fs::temp_directory_path() / fmt::format("voxelume_mesh_{}", getpid())) {
        fs::create_directories(folder_);
    }
    ~MeshFile() override { fs::remove_all(folder_); }

    fs::path write(const std::string& name, const std::string& bytes) const {
        std::ofstream(folder_ / name, std::ios::binary) << bytes;
        return folder_ / name;
    }

    std::string sentence_of(const fs::path& path, ErrorKind kind) const {
        try {
            read_mesh(path);
        } catch (const Error& error) {
            EXPECT_EQ(error.kind(), kind) << error.what();
            EXPECT_THAT(error.what(), StartsWith(path.string()));
            return error.what();
        }
        return "it was accepted";
    }

    fs::path folder_;
};

}  // namespace

TEST(MeshStl, CornersAtTheSamePlaceAreOneVertexInOrderOfAppearance) {
    const Mesh mesh = parse_mesh(
        "SOLID two\nfacet normal 0 0 0\nouter loop\nvertex 0 0 -0.0\nvertex 5 0 0\nvertex 0 3 1\n"
        "endloop\nendfacet\nendsolid two\nsolid\nfacet normal 0 0 1 outer loop vertex 5 0 0\n"
        "vertex 0 0 0 vertex 0 -3 1.0000001 endloop endfacet endsolid",
        "a.stl");
    EXPECT_THAT(mesh.positions,
                ElementsAre(vec3(0, 0, 0), vec3(5, 0, 0), vec3(0, 3, 1), vec3(0, -3, 1.0000001f)));
    EXPECT_EQ(std::bit_cast<uint32_t>(mesh.positions[0].z), 0u);
    EXPECT_THAT(mesh.triangles, ElementsAre(uvec3(0, 1, 2), uvec3(1, 0, 3)));
}

TEST(MeshStl, RefusesDamageWithLineOrByte) {
    const std::string ascii = samples::stl_ascii();
    EXPECT_THAT(refusal("solid\nfacet normal 0 0 1\nouter loop\nvertex 0 0 nan\n", "a.stl"),
                "a.stl:4: \"nan\" is not a finite number");
    EXPECT_THAT(refusal("solid\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nendloop\n", "a.stl"),
                "a.stl:5: 'vertex' should stand where \"endloop\" does");
    EXPECT_THAT(refusal(ascii.substr(0, 60), "a.stl"),
                "a.stl:4: the line ends where a number should stand");
    EXPECT_THAT(refusal("solid\nendsolid\n", "a.stl"), StartsWith("a.stl: the mesh has no tri"));
    EXPECT_THAT(refusal("Dear reader", "a.stl"), StartsWith("a.stl: byte 11: "));

    EXPECT_THAT(refusal("solid\nfacet", "a.stl"),
                "a.stl:2: the file ends where 'normal' should follow");

    const std::string binary = samples::stl_binary("solid");
    std::string infinite = binary;
    infinite.replace(84 + 12 + 4, 4, "\x00\x00\x80\x7F", 4);
    EXPECT_THAT(refusal(infinite, "a.stl"), StartsWith("a.stl: byte 100: facet 0 "));
    EXPECT_THAT(refusal(binary.substr(0, 200), "a.stl"),
                AllOf(StartsWith("a.stl: byte 80: "), HasSubstr("6 facets, which take 384 bytes")));
    EXPECT_THAT(refusal(binary + "x", "a.stl"), StartsWith("a.stl: byte 80: "));
}

TEST(MeshReader, TheSameMeshComesFromEveryFormat) {
    const samples::Pyramid pyramid;
    constexpr float kLinearColors[5][3] = {{1, 0, 0},
                                           {0, 0.0331047662f, 0},
                                           {0, 0, 0.13286832f},
                                           {1, 1, 1},
                                           {0.00303526991f, 0.00699541019f, 0.0129830325f}};
    for (const bool with_colors : {false, true}) {
        for (const auto& [name, bytes] : samples::all(with_colors)) {
            const Mesh mesh = parse_mesh(bytes, name);
            ASSERT_EQ(mesh.positions.size(), 5u) << name;
            ASSERT_EQ(mesh.triangles.size(), 6u) << name;
            for (int i = 0; i < 5; ++i) {
                const double* const p = pyramid.positions[i];
                EXPECT_EQ(mesh.positions[static_cast<size_t>(i)], vec3(p[0], p[1], p[2])) << name;
            }
            for (int i = 0; i < 6; ++i) {
                const uint32_t* const t = pyramid.triangles[i];
                EXPECT_EQ(mesh.triangles[static_cast<size_t>(i)], uvec3(t[0], t[1], t[2])) << name;
            }
            EXPECT_THAT(mesh.group_names, IsEmpty()) << name;
            if (with_colors && !name.ends_with(".stl")) {
                ASSERT_EQ(mesh.vertex_colors.size(), 5u) << name;
                for (size_t i = 0; i < 5; ++i) {  // 20/255 differs between text and bytes
                    for (int k = 0; k < 3; ++k) {
                        EXPECT_FLOAT_EQ(mesh.vertex_colors[i][k], kLinearColors[i][k]) << name;
                    }
                }
            } else {
                EXPECT_THAT(mesh.vertex_colors, IsEmpty()) << name;
            }
        }
    }
}

TEST(MeshReader, TheContentDecidesWhereItSaysWhatItIs) {
    for (const auto& [name, bytes] : samples::all(false)) {
        if (!name.ends_with(".obj")) {
            EXPECT_EQ(parse_mesh(bytes, "scan.obj").triangles.size(), 6u) << name;
            EXPECT_EQ(parse_mesh(bytes, "scan").triangles.size(), 6u) << name;
        }
    }
    EXPECT_EQ(parse_mesh(samples::obj(false), "SCAN.OBJ").triangles.size(), 6u);
    EXPECT_THAT(refusal(samples::obj(false), "scan.txt"),
                HasSubstr(".obj, .ply, .stl, .gltf and .glb are read"));
}

TEST(MeshReader, TrianglesWithoutAreaAndUnusedVerticesAreKept) {
    const Mesh mesh = parse_mesh("v 0 0 0\nv 5 0 0\nv 0 3 1\nv 9 9 9\nf 1 1 2\n", "a.obj");
    EXPECT_EQ(mesh.positions.size(), 4u);
    EXPECT_THAT(mesh.triangles, ElementsAre(uvec3(0, 0, 1)));
}

TEST_F(MeshFile, IsReadByItsPath) {
    for (const auto& [name, bytes] : samples::all(true)) {
        EXPECT_EQ(read_mesh(write(name, bytes)).triangles.size(), 6u) << name;
    }
}

TEST_F(MeshFile, ThatIsMissingOrNoFileIsRefused) {
    EXPECT_THAT(sentence_of(folder_ / "none.obj", ErrorKind::input), HasSubstr("no such"));
    EXPECT_THAT(sentence_of(folder_ / "none" / "a.obj", ErrorKind::input), HasSubstr("no such"));
    EXPECT_THAT(sentence_of(folder_, ErrorKind::input), HasSubstr("a directory"));
    EXPECT_THAT(sentence_of("/dev/null", ErrorKind::input), HasSubstr("device or pipe"));
    EXPECT_THAT(sentence_of(write("empty.stl", ""), ErrorKind::input), HasSubstr("is empty"));
}

TEST_F(MeshFile, OfMoreThan16GibibytesIsALimit) {
    const fs::path path = write("huge.ply", "ply\n");
    fs::resize_file(path, (uintmax_t{16} << 30) + 1);  // sparse, so it takes no space on the disk
    EXPECT_THAT(sentence_of(path, ErrorKind::limit), HasSubstr("17179869185 bytes"));
}

}  // namespace voxelume
