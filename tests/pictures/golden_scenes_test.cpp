// SPDX-License-Identifier: Apache-2.0
// Golden bits of what the scenes of scenes/ have too little of: maps, glass, surfaces of each kind,
// light from skies and near things. A changed hash shows in every run; whether the changed picture
// is right, the slow tests say, which compare such pictures with exact ones.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>

#include "tests/oracles/image_hash.hpp"
#include "tests/pictures/golden_hash.hpp"
#include "tests/pictures/textures/mapped_sheet.hpp"
#include "tests/support/finned_ball.hpp"
#include "tests/support/test_device.hpp"

namespace voxelume {
namespace {

/// Texels that differ from place to place.
oracle::Picture texels(int seed) {
    oracle::Picture picture{16, 12, {}};
    for (int i = 0; i < 16 * 12; ++i)
        picture.texels.push_back({uint8_t((i * 37 + seed) % 251), uint8_t((i * 91 + seed) % 241),
                                  uint8_t((i * 13 + 2 * seed) % 239)});
    return picture;
}

class GoldenScenes : public MappedSheetTest, public testing::WithParamInterface<const char*> {
  protected:
    GoldenScenes() : MappedSheetTest("exact") {}

    /// A room without a ceiling, seen from before its open side.
    static Json room(const char* light) {
        const Json clay = {{"color", {0.8, 0.6, 0.4}},
                           {"checker", {{"color", {0.2, 0.3, 0.5}}, {"size", 0.35}}}};
        Json scene = {
            {"voxelume", 1},
            {"world",
             {{"voxel_size", 0.05},
              {"ambient", {0.1, 0.1, 0.12}},
              {"background", {0.3, 0.5, 0.8}},
              {"bounds", {{"min", {-1.6, -1, -1.6}}, {"max", {1.6, 1.2, 1.6}}}}}},
            {"materials", {{"clay", clay}}},
            {"models",
             {{"floor", {{"shape", "box"}, {"size", {3, 0.1, 3}}, {"surface", "exact"}}},
              {"wall", {{"shape", "box"}, {"size", {3, 2, 0.1}}, {"surface", "cubes"}}}}},
            {"objects",
             {{{"model", "floor"}, {"material", "clay"}, {"position", {0, -0.9, 0}}},
              {{"model", "wall"}, {"material", "clay"}, {"position", {0, 0.1, 1.45}}}}},
            {"lights",
             {{{"type", "point"}, {"position", {0.7, 1.1, -1.2}}, {"intensity", 0.9}},
              {{"type", "disk"},
               {"position", {-0.8, 1.1, -0.6}},
               {"direction", {0.5, -1, 0.4}},
               {"radius", 0.15},
               {"intensity", 6},
               {"spots", 4}}}},
            {"observer",
             {{"position", {0.3, 0.5, -3}},
              {"look_at", {0, -0.2, 0}},
              {"display", {{"shape", "pyramid"}, {"angles", {50, 38}}}}}},
            {"render",
             {{"size", {64, 48}}, {"samples", 2}, {"light", light}, {"depth", 3}, {"bounces", 4}}}};
        return scene;
    }

    static void add(Json& scene, const std::string& model, const std::string& material,
                    const Json& where) {
        Json object = {{"model", model}, {"material", material}};
        object.update(where);
        scene["objects"].push_back(object);
    }

    void expect_bits(const Json& json, const std::string& name) const {
        const Scene scene = parse_scene(json.dump(), folder / "scene.json", {});
        RenderReport report;
        const Image image = render(test_device(), scene, report);
        EXPECT_EQ(report.not_finite, 0u);
        expect_golden(std::string("scenes/") + name + "/" + GetParam(), oracle::image_hash(image));
    }
};

INSTANTIATE_TEST_SUITE_P(Lights, GoldenScenes, testing::Values("local", "global"));

TEST_P(GoldenScenes, Maps) {
    GltfWriter writer;
    const int p = writer.accessor(
        std::vector<float>{-0.5f, -0.4f, -0.3f, 0.6f, -0.4f, -0.2f, 0, 0.7f, 0, 0.1f, -0.3f, 0.6f},
        "VEC3", 3);
    const int t = writer.accessor(std::vector<float>{0, 0, 1.5f, 0, 0.2f, 2, 1, 1}, "VEC2", 2);
    const int i =
        writer.accessor(std::vector<uint16_t>{0, 2, 1, 0, 1, 3, 1, 2, 3, 2, 0, 3}, "SCALAR", 1);
    const auto map = [](int number) { return Json{{"index", number}}; };
    add_maps(writer, {texels(1), texels(77), texels(160)},
             {{"pbrMetallicRoughness",
               {{"baseColorTexture", map(0)}, {"metallicRoughnessTexture", map(1)}}},
              {"emissiveFactor", {1, 1, 1}},
              {"emissiveTexture", map(2)}});
    writer.show(p, t, i);
    put_bytes(folder / "thing.gltf", writer.gltf());
    Json scene = room(GetParam());
    scene["materials"]["worn"] = {
        {"base_color", {0.9, 0.8, 0.7}}, {"metallic", 0.9}, {"roughness", 0.7}};
    scene["materials"]["glows"] = {{"color", {0.5, 0.5, 0.5}}, {"emission", {0.6, 0.4, 0.2}}};
    for (const char* surface : {"exact", "smooth", "cubes"})
        scene["models"][surface] = {
            {"mesh", "thing.gltf"}, {"surface", surface}, {"voxel_size", 0.05}};
    add(scene, "exact", "worn", {{"position", {-0.9, -0.3, 0.2}}, {"turn", {30, 10, 0}}});
    add(scene, "smooth", "worn", {{"position", {0, -0.4, -0.4}}, {"placement", "instance"}});
    add(scene, "cubes", "glows", {{"position", {0.9, -0.3, 0.3}}, {"turn", {-40, 0, 20}}});
    add(scene, "exact", "glows",
        {{"position", {0.1, 0.6, 0.8}}, {"scale", 0.6}, {"placement", "instance"}});
    expect_bits(scene, "maps");
}

TEST_P(GoldenScenes, Glass) {
    Json scene = room(GetParam());
    const Json clear = {{"diffuse", 0.05}, {"refraction", 0.9}, {"reflection", 0.1},
                        {"fresnel", true}, {"ior", 1.5},        {"absorption", {0.4, 0.1, 0.6}}};
    scene["materials"]["clear"] = clear;
    scene["materials"]["air"] = {{"diffuse", 0}, {"refraction", 1}, {"ior", 1}};
    scene["materials"]["frosted"] = {
        {"base_color", {0.8, 1, 0.9}}, {"transmission", 1}, {"roughness", 0.4}, {"coat", 0.4}};
    scene["materials"]["veil"] = {{"color", {1, 0.3, 0.2}}, {"opacity", 0.4}};
    scene["materials"]["mirror"] = {{"diffuse", 0.1}, {"reflection", 0.9}};
    scene["render"]["shadow"] = "filtered";
    for (const char* surface : {"exact", "smooth", "cubes"}) {
        const Json look = {{"surface", surface}, {"voxel_size", 0.05}, {"set", "solid"}};
        Json& ball = scene["models"][std::string(surface) + " ball"] = look;
        ball.update({{"shape", "sphere"}, {"radius", 0.35}});
        Json& block = scene["models"][std::string(surface) + " block"] = look;
        block.update({{"shape", "box"}, {"size", {0.5, 0.5, 0.5}}});
        if (surface != std::string("cubes")) ball.erase("set"), block.erase("set");
    }
    add(scene, "exact ball", "clear", {{"position", {-1, -0.5, -0.2}}});
    add(scene, "exact ball", "air",
        {{"position", {-1, -0.5, -0.2}}, {"scale", 0.6}, {"priority", 1}});
    add(scene, "cubes block", "clear", {{"position", {-0.25, -0.6, -0.5}}});
    add(scene, "cubes block", "clear", {{"position", {0.25, -0.6, -0.5}}, {"priority", 1}});
    add(scene, "smooth ball", "clear",
        {{"position", {1, -0.5, -0.3}}, {"turn", {10, 20, 30}}, {"placement", "instance"}});
    add(scene, "exact ball", "frosted", {{"position", {0.7, -0.5, 0.6}}});
    add(scene, "smooth block", "veil", {{"position", {-0.5, 0.2, 0.4}}, {"turn", {0, 30, 0}}});
    add(scene, "exact block", "mirror", {{"position", {0.2, 0.2, 1}}, {"turn", {0, -20, 0}}});
    expect_bits(scene, "glass");
}

TEST_P(GoldenScenes, Surfaces) {
    write_obj(folder / "fin.obj", finned_ball(0.02, 0.6, 24));
    Json scene = room(GetParam());
    scene["materials"]["red"] = {{"color", {0.9, 0.2, 0.1}}, {"specular", 0.4}, {"shininess", 20}};
    scene["models"]["nut"] = {{"surface", "smooth"},
                              {"voxel_size", 0.05},
                              {"shape", "difference"},
                              {"parts",
                               {{{"shape", "sphere"}, {"radius", 0.4}},
                                {{"shape", "cylinder"}, {"radius", 0.2}, {"height", 1}},
                                {{"shape", "box"}, {"size", {0.3, 0.3, 1}}}}}};
    scene["models"]["rounded"] = {{"shape", "torus"},   {"radius", 0.3},
                                  {"tube", 0.12},       {"surface", "cubes"},
                                  {"voxel_size", 0.05}, {"normals", "surface"}};
    scene["models"]["finned"] = {{"mesh", "fin.obj"}, {"surface", "smooth"}, {"voxel_size", 0.05}};
    scene["models"]["soft"] = {
        {"mesh", "fin.obj"}, {"surface", "exact"}, {"shading", "smooth"}, {"voxel_size", 0.05}};
    add(scene, "nut", "red", {{"position", {-1, -0.4, 0}}, {"turn", {40, 30, 0}}});
    add(scene, "rounded", "red", {{"position", {0, -0.6, -0.6}}, {"turn", {0, -20, 0}}});
    add(scene, "finned", "red", {{"position", {0.9, -0.3, 0.2}}});
    add(scene, "soft", "clay",
        {{"matrix", {{0.7, 0.2, 0, 0}, {0, -0.6, 0.1, 0.1}, {0.1, 0, 0.8, 0.7}}},
         {"placement", "instance"}});
    add(scene, "rounded", "clay",
        {{"position", {0.2, 0.5, 0.3}}, {"turn", {15, 70, 0}}, {"placement", "instance"}});
    add(scene, "finned", "clay",
        {{"position", {-0.6, 0.4, 0.6}}, {"scale", {-0.8, 0.8, 0.6}}, {"placement", "instance"}});
    expect_bits(scene, "surfaces");
}

TEST_P(GoldenScenes, Skies) {
    put_bytes(folder / "around.hdr",
              "#?RADIANCE\n\n-Y 2 +X 2\n\x40\x50\x60\x80\x20\x20\x20\x80"
              "\x60\x30\x20\x80\x10\x20\x20\x80");
    Json scene = room(GetParam());
    scene["world"]["sky"] = {{"kind", "map"}, {"file", "around.hdr"}, {"samples", 4}};
    scene["world"]["medium"] = {
        {"absorption", {0.05, 0.1, 0.15}},
        {"scattering", {0.2, 0.2, 0.15}},
        {"anisotropy", 0.4},
        {"density", {{"kind", "height"}, {"base", -0.9}, {"scale_height", 0.6}}}};
    scene["materials"]["lamp"] = {{"color", {0, 0, 0}}, {"emission", {4, 3, 2}}};
    scene["materials"]["paint"] = {{"base_color", {0.2, 0.5, 0.3}}, {"roughness", 0.25}};
    scene["models"]["ball"] = {{"shape", "sphere"}, {"radius", 0.3}, {"surface", "exact"}};
    scene["models"]["dice"] = {
        {"shape", "box"}, {"size", {0.3, 0.3, 0.3}}, {"surface", "cubes"}, {"voxel_size", 0.05}};
    add(scene, "ball", "paint", {{"position", {-0.6, -0.55, -0.1}}});
    add(scene, "dice", "lamp", {{"position", {0.1, -0.7, -0.2}}});
    add(scene, "dice", "clay", {{"position", {0.8, -0.7, 0.2}}, {"turn", {30, 0, 0}}});
    add(scene, "ball", "lamp", {{"position", {0.9, 0.5, 0.8}}, {"scale", 0.4}});
    expect_bits(scene, "skies");
}

}  // namespace
}  // namespace voxelume
