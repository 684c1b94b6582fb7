// SPDX-License-Identifier: Apache-2.0
// The maps that glTF files and libraries of OBJ files name, in the meshes that are read.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "runtime/image/srgb.hpp"
#include "runtime/io/gltf/gltf_mesh.hpp"
#include "runtime/io/image/png.hpp"
#include "runtime/io/mesh/mesh_reader.hpp"
#include "runtime/io/mesh/mesh_textures.hpp"
#include "tests/support/file_fixture.hpp"
#include "tests/support/writers/gltf_writer.hpp"

namespace voxelume {
namespace {

using Json = nlohmann::json;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Pointwise;

/// A PNG of two texels, with these codes in all channels.
std::string two_texels(uint8_t first, uint8_t second) {
    static const std::vector<float> linear = srgb_levels();
    Image image{2, 1, {}, {}, {}};
    for (const char* channel : {"R", "G", "B"})
        image.planes[channel] = Plane<float>{linear[first], linear[second]};
    return png_bytes(image, {});
}

std::string uri_of(const std::string& bytes) {
    return "data:image/png;base64," + GltfWriter::base64(bytes);
}

Mesh mesh_with(const Json& material, const std::string& image) {
    GltfWriter writer = triangle_gltf();
    Json& primitive = writer.json["meshes"][0]["primitives"][0];
    for (const char* set : {"TEXCOORD_0", "TEXCOORD_1"})
        primitive["attributes"][set] =
            writer.accessor(std::vector<float>{0, 0, 1, 0, 0, 1}, "VEC2", 2);
    primitive["material"] = 0;
    writer.json["materials"] = nlohmann::json::array({material});
    writer.json["images"] = {{{"uri", image}}};
    writer.json["textures"] = {{{"source", 0}}};
    return gltf_mesh(GltfFile(writer.gltf(), "a.gltf"), 0);
}

Json moved(double u, double v, std::vector<double> scale, double turn = 0, int set = 0) {
    return {
        {"index", 0},
        {"texCoord", set},
        {"extensions",
         {{"KHR_texture_transform", {{"offset", {u, v}}, {"scale", scale}, {"rotation", turn}}}}}};
}

TEST(MeshMaps, OfGltfHaveTheirPlacesByThoseOfTheBaseColor) {
    const Mesh mesh =
        mesh_with({{"emissiveFactor", {1, 0, 0}},
                   {"emissiveTexture", moved(0.25, 0.5, {3, 8})},
                   {"pbrMetallicRoughness",
                    {{"baseColorTexture", moved(0.5, -1, {2, 4})},
                     {"metallicRoughnessTexture", moved(0, 0, {1, 1}, 1.5707963267948966)}}}},
                  uri_of(two_texels(0, 255)));
    ASSERT_EQ(mesh.textures.size(), 3u) << testing::PrintToString(mesh.notes);
    EXPECT_THAT(mesh.group_textures, ElementsAre(2u));
    const Texture& base = mesh.textures[2];
    // u of the base is 0.5 + 2 u', of the emission 0.25 + 3 u'.
    EXPECT_THAT(base.maps[kEmissionMap].transform,
                Pointwise(testing::FloatNear(1e-6f), {1.5f, 0.f, -0.5f, 0.f, 2.f, 2.5f}));
    // A quarter of a turn: (v', -u').
    EXPECT_THAT(base.maps[kGlossMap].transform,
                Pointwise(testing::FloatNear(1e-6f), {0.f, 0.25f, 0.25f, -0.5f, 0.f, 0.25f}));
    // Numbers are plain means, colours means of light.
    const auto last_of = [&](size_t map) {
        return mesh.textures[base.maps[map].texture].image->texels.back() & 255;
    };
    EXPECT_EQ(last_of(kGlossMap), 128u);
    EXPECT_EQ(last_of(kEmissionMap), 188u);
}

TEST(MeshMaps, OfGltfWithCoordinatesOfTheirOwnAreShownAsTheirMeanWithANote) {
    const Mesh mesh = mesh_with({{"emissiveFactor", {1, 1, 1}},
                                 {"emissiveTexture", moved(0, 0, {1, 1}, 0, 1)},
                                 {"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}}},
                                uri_of(two_texels(0, 255)));
    ASSERT_EQ(mesh.textures.size(), 2u);
    EXPECT_EQ(mesh.textures[0].image->width, 1);
    EXPECT_EQ(mesh.textures[0].image->texels.at(0) & 255, 188u);
    EXPECT_THAT(mesh.notes, ElementsAre(HasSubstr("emissive texture of its materials[0] is shown "
                                                  "as its mean")));
}

TEST(MeshMaps, OfGltfThatCantBeReadAreNeitherEmissiveNorMetal) {
    const Mesh mesh =
        mesh_with({{"emissiveFactor", {1, 1, 1}},
                   {"emissiveTexture", {{"index", 0}}},
                   {"pbrMetallicRoughness", {{"metallicRoughnessTexture", {{"index", 0}}}}}},
                  uri_of("no picture"));
    ASSERT_EQ(mesh.textures.size(), 3u);
    EXPECT_EQ(mesh.textures[0].image->texels, std::vector<uint32_t>{0xFF00B300});
    EXPECT_EQ(mesh.textures[1].image->texels, std::vector<uint32_t>{0xFF000000});
    EXPECT_EQ(mesh.textures[2].image->texels, std::vector<uint32_t>{0xFFFFFFFF});
    EXPECT_EQ(mesh.notes.size(), 2u) << testing::PrintToString(mesh.notes);
}

TEST(MeshMaps, OfGltfAreLeftOutWhereNothingIsEmissiveAndOfGlassAndCoats) {
    const Json gloss = {{"metallicRoughnessTexture", {{"index", 0}}}};
    EXPECT_TRUE(mesh_with({{"emissiveTexture", {{"index", 0}}}}, uri_of(two_texels(1, 2)))
                    .textures.empty());
    for (const char* extension : {"KHR_materials_transmission", "KHR_materials_clearcoat"})
        EXPECT_TRUE(
            mesh_with({{"pbrMetallicRoughness", gloss},
                       {"extensions",
                        {{extension, {{"transmissionFactor", 1}, {"clearcoatFactor", 1}}}}}},
                      uri_of(two_texels(1, 2)))
                .textures.empty());
}

class MeshMapFiles : public FileTest {
  protected:
    Mesh read(const std::string& library) const {
        put_bytes(folder / "a.obj",
                  "mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 0 1\nusemtl m\n"
                  "f 1/1 2/2 3/3\n");
        put_bytes(folder / "a.mtl", "newmtl m\n" + library);
        put_bytes(folder / "a.png", two_texels(0, 200));
        return read_mesh(folder / "a.obj");
    }
};

TEST_F(MeshMapFiles, OfLibrariesJoinRoughnessAndMetalness) {
    const Mesh mesh = read("map_Kd -s 2 4 -o 0.5 0.25 a.png\nmap_Pr a.png\nmap_Ke -s 3 1 a.png\n");
    ASSERT_EQ(mesh.textures.size(), 4u) << testing::PrintToString(mesh.notes);
    const Texture& base = mesh.textures[mesh.group_textures.at(0)];
    EXPECT_EQ(base.image, mesh.textures[0].image);
    const Texture& gloss = mesh.textures[base.maps[kGlossMap].texture];
    EXPECT_EQ(gloss.image->texels.at(0), 0xFFFF00FFu) << "metalness is its factor";
    EXPECT_EQ(gloss.image->texels.at(1), 0xFFFFC8FFu);
    // u is 0.5 + 2 u', 1 - v is 0.25 + 4 (1 - v'), and of the map 3 u' and v'.
    EXPECT_THAT(base.maps[kEmissionMap].transform,
                Pointwise(testing::FloatNear(1e-6f), {1.5f, 0.f, -0.75f, 0.f, 0.25f, 0.8125f}));
    const std::string bytes = "mtllib a.mtl\n";
    EXPECT_EQ(companion_files(bytes, folder / "a.obj").size(), 4u);
}

TEST_F(MeshMapFiles, OfLibrariesAreReadOnceForAllMaterials) {
    put_bytes(folder / "a.png", two_texels(0, 200));
    put_bytes(folder / "a.mtl",
              "newmtl m\nmap_Ke a.png\nmap_Pr a.png\nnewmtl n\nmap_Ke -o 0.5 0 a.png\n"
              "map_Pr a.png\n");
    put_bytes(folder / "a.obj",
              "mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 0 1\nusemtl m\n"
              "f 1/1 2/2 3/3\nusemtl n\nf 1/1 3/3 2/2\n");
    const Mesh mesh = read_mesh(folder / "a.obj");
    ASSERT_EQ(mesh.textures.size(), 4u) << "two maps, and white with either of two places of them";
    const Texture &m = mesh.textures[mesh.group_textures.at(0)],
                  &n = mesh.textures[mesh.group_textures.at(1)];
    for (const size_t map : {kGlossMap, kEmissionMap})
        EXPECT_EQ(m.maps[map].texture, n.maps[map].texture);
    EXPECT_NE(m.maps[kGlossMap].texture, m.maps[kEmissionMap].texture) << "numbers, and colours";
    EXPECT_NE(m.maps[kEmissionMap].transform, n.maps[kEmissionMap].transform);
}

TEST_F(MeshMapFiles, OfLibrariesThatDifferInSizeHaveThatOfTheLarger) {
    Image tall{1, 3, {}, {}, {}};
    for (const char* channel : {"R", "G", "B"}) tall.planes[channel] = Plane<float>{0, 1, 0};
    put_bytes(folder / "tall.png", png_bytes(tall, {}));
    const Mesh mesh = read("map_Pr a.png\nmap_Pm tall.png\n");
    const Texture& base = mesh.textures[mesh.group_textures.at(0)];
    const TextureImage& gloss = *mesh.textures[base.maps[kGlossMap].texture].image;
    EXPECT_EQ(gloss.width, 1);
    EXPECT_EQ(gloss.height, 3);
    EXPECT_EQ(gloss.texels.at(1) >> 16 & 0xFF, 0xFFu);
}

TEST_F(MeshMapFiles, OfLibrariesThatArentThereAreNeitherEmissiveNorMetal) {
    const Mesh mesh = read("map_Pr none.png\nmap_Pm other.png\nmap_Ke none.png\n");
    ASSERT_EQ(mesh.textures.size(), 3u);
    EXPECT_EQ(mesh.textures[0].image->texels, std::vector<uint32_t>{0xFF00B3FF});
    EXPECT_EQ(mesh.textures[1].image->texels, std::vector<uint32_t>{0xFF000000});
    EXPECT_EQ(mesh.notes.size(), 3u) << testing::PrintToString(mesh.notes);
}

}  // namespace
}  // namespace voxelume
