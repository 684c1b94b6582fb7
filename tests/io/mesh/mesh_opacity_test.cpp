// SPDX-License-Identifier: Apache-2.0
// The opacity of meshes' surfaces: the alpha of the pictures of OBJ files, map_d, and the alpha of
// vertices.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fmt/format.h>

#include "runtime/io/gltf/gltf_mesh.hpp"
#include "runtime/io/mesh/mesh_reader.hpp"
#include "runtime/io/mesh/mesh_textures.hpp"
#include "tests/support/file_fixture.hpp"
#include "tests/support/writers/gltf_writer.hpp"
#include "tests/support/writers/png_writer.hpp"

namespace voxelume {
namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

/// A row of RGBA texels.
std::string rgba_row(const std::vector<uint32_t>& texels) {
    std::string row;
    for (const uint32_t texel : texels)
        for (int c = 3; c >= 0; --c) row += char(texel >> 8 * c & 255);
    return png_of_rows(int(texels.size()), 8, 6, {row});
}

class MeshOpacity : public FileTest {
  protected:
    void SetUp() override {
        FileTest::SetUp();
        put_bytes(folder / "leaf.png", rgba_row({0xFF800040, 0x10203080}));
        put_bytes(folder / "full.png", rgba_row({0xFF8000FF, 0x102030FF}));
        put_bytes(folder / "none.png", rgba_row({0xFF800000, 0x10203000}));
        put_bytes(folder / "grey.png", png_of_rows(2, 8, 0, {std::string{'\x11', '\x77'}}));
        put_bytes(folder / "long.png",
                  png_of_rows(4, 8, 0, {std::string{'\x11', '\x22', '\x33', '\x44'}}));
        put_bytes(
            folder / "rgb.png",
            png_of_rows(2, 8, 2, {std::string{'\x10', '\x20', '\x60', '\x01', '\x02', '\x02'}}));
    }

    Mesh read(const std::string& library) const {
        put_bytes(folder / "a.obj",
                  "mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 0 1\nusemtl m\n"
                  "f 1/1 2/2 3/3\n");
        put_bytes(folder / "a.mtl", "newmtl m\n" + library);
        return read_mesh(folder / "a.obj");
    }
};

/// The texels of the first level, as 0xAABBGGRR.
std::vector<uint32_t> texels_of(const Mesh& mesh) {
    const TextureImage& image = *mesh.textures.at(mesh.group_textures.at(0)).image;
    return {image.texels.begin(), image.texels.begin() + image.width};
}

TEST_F(MeshOpacity, IsTheAlphaOfTheColorsPicture) {
    for (const char* library : {"map_Kd leaf.png\n", "map_Kd leaf.png\nmap_d leaf.png\n",
                                "map_Kd -s 2 2 leaf.png\nmap_d leaf.png\n",
                                "map_Kd -s 2 2 leaf.png\nmap_d -s 2 2 leaf.png\n"}) {
        const Mesh mesh = read(library);
        ASSERT_EQ(mesh.textures.size(), 1u);
        EXPECT_EQ(mesh.textures[0].alpha, kAlphaBlend) << library;
        EXPECT_THAT(texels_of(mesh), ElementsAre(0x400080FFu, 0x80302010u));
        EXPECT_THAT(mesh.notes, IsEmpty());
    }
}

TEST_F(MeshOpacity, IsFullWhereAPictureHasNoAlphaOrNothingElse) {
    for (const char* file : {"full.png", "none.png", "grey.png"})
        EXPECT_EQ(read(std::string("map_Kd ") + file).textures.at(0).alpha, kAlphaOpaque) << file;
    const Mesh mesh = read("map_Kd full.png\nmap_d full.png\n");
    EXPECT_EQ(mesh.textures.at(0).alpha, kAlphaOpaque);
    EXPECT_THAT(mesh.notes, ElementsAre("its texture \"full.png\" shows no opacity, as map_d "
                                        "wants: it has no alpha"));
}

TEST_F(MeshOpacity, OfAPictureOfItsOwnIsItsAlphaOrTheMeanOfItsChannels) {
    const Mesh grey = read("map_Kd leaf.png\nmap_d grey.png\n");
    EXPECT_THAT(texels_of(grey), ElementsAre(0x110080FFu, 0x77302010u));
    EXPECT_EQ(grey.textures.at(0).alpha, kAlphaBlend);
    EXPECT_THAT(texels_of(read("map_Kd full.png\nmap_d leaf.png\n")),
                ElementsAre(0x400080FFu, 0x80302010u));
    EXPECT_THAT(texels_of(read("map_Kd full.png\nmap_d rgb.png\n")),
                ElementsAre(0x300080FFu, 0x02302010u));
    EXPECT_THAT(texels_of(read("map_Kd full.png\nmap_d long.png\n")),
                ElementsAre(0x110080FFu, 0x220080FFu, 0x33302010u, 0x44302010u));
}

TEST_F(MeshOpacity, WithoutAPictureOfColorsIsThatOfWhite) {
    const Mesh mesh = read("Kd 1 0 0\nmap_d -clamp on -s 3 2 -o 0.5 0 grey.png\n");
    EXPECT_THAT(texels_of(mesh), ElementsAre(0x11FFFFFFu, 0x77FFFFFFu));
    EXPECT_EQ(mesh.textures[0].wrap_u, TextureWrap::clamp);
    ASSERT_EQ(mesh.triangle_uvs.size(), 1u);
    const glm::vec2 corner = mesh.uvs.at(mesh.triangle_uvs[0].y);
    EXPECT_EQ(corner, glm::vec2(3.5f, 1.0f));
}

TEST_F(MeshOpacity, ThatCantBeShownIsNoted) {
    EXPECT_THAT(read("map_Kd full.png\nmap_d -s 2 2 grey.png\n").notes,
                ElementsAre("its texture \"grey.png\" isn't shown as map_d says, which has "
                            "other options than map_Kd"));
    EXPECT_THAT(read("map_Kd leaf.png\nmap_d -s 2 2 leaf.png\n").notes,
                ElementsAre(testing::HasSubstr("isn't shown as map_d says")));
    EXPECT_THAT(read("map_Kd full.png\nmap_d lost.png\n").notes,
                ElementsAre("its texture \"lost.png\" isn't in its folder"));
    const Mesh mesh = read("map_Kd lost.png\nmap_d grey.png\n");
    EXPECT_EQ(mesh.notes.size(), 1u);
    EXPECT_THAT(texels_of(mesh), ElementsAre(0x11FFFFFFu, 0x77FFFFFFu));
}

TEST_F(MeshOpacity, IsReadOnceForMaterialsThatShareItAndIsACompanionOfItsMesh) {
    put_bytes(folder / "a.mtl",
              "newmtl m\nmap_Kd full.png\nmap_d grey.png\nnewmtl n\nmap_Kd full.png\n"
              "map_d grey.png\nnewmtl o\nmap_Kd full.png\n");
    put_bytes(folder / "b.obj",
              "mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nusemtl m\nf 1/1 2/1 3/1\n"
              "usemtl n\nf 1/1 2/1 3/1\nusemtl o\nf 1/1 2/1 3/1\n");
    const Mesh mesh = read_mesh(folder / "b.obj");
    EXPECT_THAT(mesh.group_textures, ElementsAre(0u, 0u, 1u));
    EXPECT_EQ(mesh.textures.at(1).alpha, kAlphaOpaque);
    std::vector<std::string> names;
    for (const auto& file : companion_files("mtllib a.mtl\n", folder / "b.obj"))
        names.push_back(file.filename());
    EXPECT_THAT(names, Contains("grey.png"));
}

/// A triangle in PLY with a property of its vertices; `comment` is a line of the header.
std::string ply_of(const std::string& property, const std::vector<std::string>& values,
                   const std::string& comment = "") {
    return "ply\nformat ascii 1.0\n" + comment +
           "element vertex 3\nproperty float x\nproperty float y\nproperty float z\nproperty " +
           property +
           "\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0 " +
           values[0] + "\n1 0 0 " + values[1] + "\n0 1 0 " + values[2] + "\n3 0 1 2\n";
}

TEST_F(MeshOpacity, OfVerticesOfPlyIsAPlaceOnARampOfAlphas) {
    for (const auto& [type, scale] : {std::pair("uchar alpha", 255.0),
                                      {"float alpha", 1.0},
                                      {"ushort diffuse_alpha", 65535.0}}) {
        std::vector<std::string> values;
        for (const double share : {1.0, 0.2, 0.0})
            values.push_back(fmt::format("{}", share * scale));
        const Mesh mesh = parse_mesh(ply_of(type, values), "a.ply");
        ASSERT_EQ(mesh.textures.size(), 1u) << type;
        EXPECT_EQ(mesh.textures[0].alpha, kAlphaBlend);
        const TextureImage& image = *mesh.textures[0].image;
        const int expected[] = {255, 51, 0};
        for (size_t i = 0; i < 3; ++i) {
            const auto texel = size_t(mesh.uvs.at(i).x * float(image.width));
            EXPECT_EQ(image.texels.at(texel) >> 24, unsigned(expected[i])) << type << i;
        }
    }
}

TEST_F(MeshOpacity, OfVerticesThatAllAreOpaqueOrAllAreNothingIsNone) {
    EXPECT_THAT(parse_mesh(ply_of("uchar alpha", {"255", "255", "255"}), "a.ply").textures,
                IsEmpty());
    EXPECT_THAT(parse_mesh(ply_of("uchar alpha", {"0", "0", "0"}), "a.ply").textures, IsEmpty());
    EXPECT_THAT(parse_mesh(ply_of("char alpha", {"7", "0", "0"}), "a.ply").textures, IsEmpty());
}

TEST_F(MeshOpacity, OfVerticesAlongsideATextureIsNoted) {
    const Mesh mesh = parse_mesh(
        ply_of("uchar alpha", {"255", "9", "255"}, "comment TextureFile grey.png\n"), "a.ply");
    EXPECT_THAT(mesh.textures, IsEmpty());
    EXPECT_THAT(mesh.notes, Contains(HasSubstr("the alpha of its vertices isn't shown")));
}

/// A glTF triangle whose vertices have these alphas, of a material.
Mesh gltf_with(const nlohmann::json& material) {
    GltfWriter writer = triangle_gltf();
    nlohmann::json& primitive = writer.json["meshes"][0]["primitives"][0];
    primitive["attributes"]["COLOR_0"] =
        writer.accessor(std::vector<float>{1, 1, 1, 1, 1, 1, 1, 0.5f, 1, 1, 1, 0}, "VEC4", 4);
    primitive["attributes"]["TEXCOORD_0"] =
        writer.accessor(std::vector<float>{0, 0, 1, 0, 0, 1}, "VEC2", 2);
    primitive["material"] = 0;
    writer.json["materials"] = nlohmann::json::array({material});
    writer.json["images"] = {
        {{"uri", "data:image/png;base64," + GltfWriter::base64(rgba_row({0x112233FF}))}}};
    writer.json["textures"] = {{{"source", 0}}};
    return gltf_mesh(GltfFile(writer.gltf(), "a.gltf"), 0);
}

TEST_F(MeshOpacity, OfVerticesOfGltfCountsWhereAlphaModeAsksForIt) {
    EXPECT_THAT(gltf_with({{"name", "m"}}).textures, IsEmpty());
    EXPECT_EQ(gltf_with({{"alphaMode", "BLEND"}}).textures.at(0).alpha, kAlphaBlend);
    const Mesh mesh = gltf_with({{"alphaMode", "MASK"}, {"alphaCutoff", 0.2}});
    EXPECT_EQ(mesh.textures.at(0).alpha, 51u);
    EXPECT_THAT(mesh.notes, IsEmpty());
    ASSERT_EQ(mesh.uvs.size(), 3u);
    EXPECT_FLOAT_EQ(mesh.uvs[1].x, 128.0f / 256);
    const Mesh both = gltf_with(
        {{"alphaMode", "BLEND"}, {"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}}});
    EXPECT_EQ(both.textures.at(0).image->width, 1);
    EXPECT_THAT(both.notes, ElementsAre("the alpha of its vertices isn't shown where they have its "
                                        "materials[0]: that has textures"));
}

}  // namespace
}  // namespace voxelume
