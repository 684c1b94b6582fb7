// SPDX-License-Identifier: Apache-2.0
// glTF files in place of scenes: materials, camera and lights of the scene that is made of them.
#include <gmock/gmock.h>

#include <algorithm>

#include "tests/api/api_gltf_fixture.hpp"

namespace voxelume::v1 {

using testing::HasSubstr;
using testing::Not;
using Json = nlohmann::json;

TEST_F(ApiGltf, EachNodeIsAnObjectOfTheModelOfItsMesh) {
    GltfWriter writer = triangle_gltf();
    writer.json["meshes"][0]["name"] = "wedge";
    writer.json["nodes"] = {{{"mesh", 0}, {"name", "a"}},
                            {{"mesh", 0}, {"name", "a"}, {"translation", {1, 2, 3}}},
                            {{"mesh", 0}, {"scale", {1, 0, 1}}}};
    writer.json["scenes"][0]["nodes"] = {0, 1, 2};
    const std::string scene = scene_of(writer);
    EXPECT_THAT(scene,
                HasSubstr("\"wedge\": {\"mesh\": \"a.glb\", \"part\": 1, \"surface\": \"exact\"}"));
    EXPECT_THAT(scene, HasSubstr("{\"name\": \"a\", \"model\": \"wedge\"}"));
    EXPECT_THAT(scene, HasSubstr("\"name\": \"a 2\""));
    EXPECT_THAT(scene, HasSubstr("\"matrix\": [[1, 0, 0, 1], [0, 1, 0, 2], [0, 0, 1, 3]]"));
    EXPECT_THAT(scene, Not(HasSubstr("\"name\": \"wedge\""))) << "a flat node can't be placed";
    const Scene read = scene_of_file(folder / "a.glb");
    const std::string quarter = scene_of(writer, {.fit = 2});  // in place of 8 m
    EXPECT_THAT(quarter, HasSubstr("[[0.25, 0, 0, 0.25], [0, 0.25, 0, 0.5], [0, 0, 0.25, 0.75]]"));
}

TEST_F(ApiGltf, MaterialsAreOursAsFarAsTheyGo) {
    EXPECT_THAT(
        with_material({{"pbrMetallicRoughness",
                        {{"baseColorFactor", {0.5, 0.25, 1, 0.5}},
                         {"metallicFactor", 0},
                         {"roughnessFactor", 0.5}}}}),
        HasSubstr("\"m\": {\"color\": [0.5, 0.25, 1], \"metallic\": 0, \"roughness\": 0.5}"));
    EXPECT_THAT(with_material({{"pbrMetallicRoughness", {{"roughnessFactor", 0}}}}),
                HasSubstr("\"metallic\": 1, \"roughness\": 0}"));
    EXPECT_THAT(with_material({{"extensions", {{"KHR_materials_ior", {{"ior", 1.75}}}}}}),
                HasSubstr("\"roughness\": 1, \"ior\": 1.75}"));
    EXPECT_THAT(with_material({{"alphaMode", "BLEND"},
                               {"pbrMetallicRoughness",
                                {{"baseColorFactor", {1, 1, 1, 0.25}}, {"metallicFactor", 0}}}}),
                HasSubstr("\"opacity\": 0.25"));
    for (const double cutoff : {0.2, 0.4}) {
        const std::string masked =
            with_material({{"alphaMode", "MASK"},
                           {"alphaCutoff", cutoff},
                           {"pbrMetallicRoughness", {{"baseColorFactor", {1, 1, 1, 0.3}}}}});
        EXPECT_EQ(masked.find("\"opacity\": 0") != masked.npos, cutoff == 0.4) << masked;
    }
    const Json transmission = {{"transmissionFactor", 1}};
    EXPECT_THAT(with_material({{"extensions", {{"KHR_materials_transmission", transmission}}}}),
                HasSubstr("\"opacity\": 0.05"));
    const std::string glass =
        with_material({{"pbrMetallicRoughness", {{"metallicFactor", 0}, {"roughnessFactor", 0.25}}},
                       {"extensions",
                        {{"KHR_materials_transmission", transmission},
                         {"KHR_materials_ior", {{"ior", 1.75}}},
                         {"KHR_materials_volume",
                          {{"thicknessFactor", 1},
                           {"attenuationDistance", 2},
                           {"attenuationColor", {1, 0.36787944117144233, 0.1353352832366127}}}}}}});
    EXPECT_THAT(glass, HasSubstr("\"roughness\": 0.25, \"transmission\": 1, \"ior\": 1.75, "
                                 "\"absorption\": [0, 0.5, 1]"));
    EXPECT_THAT(glass, HasSubstr("\"shadow\": \"filtered\""));
    const Json coat = {{"clearcoatFactor", 0.5}, {"clearcoatRoughnessFactor", 0.25}};
    EXPECT_THAT(with_material({{"pbrMetallicRoughness", {{"metallicFactor", 0}}},
                               {"extensions",
                                {{"KHR_materials_clearcoat", coat},
                                 {"KHR_materials_specular", {{"specularFactor", 0.75}}}}}}),
                HasSubstr("\"roughness\": 1, \"specular\": 0.75, \"coat\": 0.5, "
                          "\"coat_roughness\": 0.25"));
    const Json mapped = {{"clearcoatFactor", 1}, {"clearcoatTexture", {{"index", 0}}}};
    EXPECT_THAT(with_material({{"extensions", {{"KHR_materials_clearcoat", mapped}}}}),
                Not(HasSubstr("coat")));
    const Json strength = {{"KHR_materials_emissive_strength", {{"emissiveStrength", 8}}}};
    EXPECT_THAT(with_material({{"emissiveFactor", {1, 0.5, 0}}, {"extensions", strength}}),
                HasSubstr("\"emission\": [8, 4, 0]"));
}

TEST_F(ApiGltf, UnlitMaterialsHaveTheirColourInAnyLight) {
    const Json unlit = {{"pbrMetallicRoughness", {{"baseColorFactor", {0.5, 0.25, 1, 1}}}},
                        {"emissiveFactor", {0, 1, 0}},
                        {"extensions", {{"KHR_materials_unlit", Json::object()}}}};
    const std::string scene = with_material(unlit);
    EXPECT_THAT(scene, HasSubstr("\"m\": {\"color\": [0, 0, 0], \"specular\": 0, "
                                 "\"emission\": [0.5, 0.25, 1]}"));
    EXPECT_THAT(scene, HasSubstr("\"spots\": 0"));
    const Image image = render_image(
        scene_of_file(folder / "a.glb", {.size = {40, 30}}, {.cache = no_cache}).with_samples(1),
        *device, 1, {.cache = no_cache});
    size_t shown = 0;
    for (size_t i = 0; i < image.object_ids().size(); ++i) {
        if (image.object_ids()[i] != 1) continue;
        ++shown;
        EXPECT_NEAR(image.plane("R")[i], 0.5, 1e-6);
        EXPECT_NEAR(image.plane("G")[i], 0.25, 1e-6);
        EXPECT_NEAR(image.plane("B")[i], 1, 1e-6);
    }
    EXPECT_GT(shown, 50u);
}

TEST_F(ApiGltf, UnlitBlackIsNotEmissiveWithoutSpots) {
    const Json black = {{"pbrMetallicRoughness", {{"baseColorFactor", {0, 0, 0, 1}}}},
                        {"extensions", {{"KHR_materials_unlit", Json::object()}}}};
    EXPECT_THAT(with_material(black), Not(HasSubstr("\"spots\": 0")));
    EXPECT_NO_THROW(scene_of_file(folder / "a.glb"));
}

/// Light on the same way through the model loses the same, however large the model is made.
TEST_F(ApiGltf, GlassKeepsItsColourInAnotherSize) {
    GltfWriter writer = triangle_gltf();  // its longest side is 7 m
    writer.json["materials"] = {
        {{"name", "m"},
         {"extensions",
          {{"KHR_materials_transmission", {{"transmissionFactor", 1}}},
           {"KHR_materials_volume",
            {{"thicknessFactor", 1},
             {"attenuationDistance", 2},
             {"attenuationColor", {1, 0.36787944117144233, 0.1353352832366127}}}}}}}};
    writer.json["meshes"][0]["primitives"][0]["material"] = 0;
    EXPECT_THAT(scene_of(writer), HasSubstr("\"absorption\": [0, 0.5, 1]"));
    EXPECT_THAT(scene_of(writer, {.fit = 3.5}), HasSubstr("\"absorption\": [0, 1, 2]"));
}

TEST_F(ApiGltf, PointsOfScaledNodesHaveVoxelsOfTheWorldsSize) {
    GltfWriter writer = triangle_gltf();
    writer.json["meshes"][0]["primitives"][0]["mode"] = 0;
    for (const double scale : {0.001, 1.0, 100.0}) {
        writer.json["nodes"][0]["scale"] = {scale, scale, scale};
        const Json scene = Json::parse(scene_of(writer));
        const Json& model = scene["models"]["mesh 1"];
        EXPECT_EQ(model["surface"], "cubes");
        const double edge = model["voxel_size"], world = scene["world"]["voxel_size"];
        EXPECT_NEAR(edge * scale / world, 1, 1e-3) << scale;  // both have four digits
        EXPECT_NEAR(world, 7 * scale / 32, 7 * scale / 64) << scale;
    }
}

/// Positions that are one point have no size that voxels could have.
TEST_F(ApiGltf, APointThatMovesIsAScene) {
    GltfWriter writer = triangle_gltf();
    Json& primitive = writer.json["meshes"][0]["primitives"][0];
    primitive = {
        {"mode", 0},
        {"attributes", {{"POSITION", writer.accessor(std::vector<float>{1, 2, 3}, "VEC3", 3)}}}};
    Json& animation = writer.json["animations"][0];
    animation["channels"] = {{{"sampler", 0}, {"target", {{"node", 0}, {"path", "translation"}}}}};
    animation["samplers"] = {
        {{"input", writer.accessor(std::vector<float>{0, 1}, "SCALAR", 1)},
         {"output", writer.accessor(std::vector<float>{0, 0, 0, 4, 0, 0}, "VEC3", 3)}}};
    EXPECT_THAT(scene_of(writer), HasSubstr("cubes"));
}

TEST_F(ApiGltf, UnlitMaterialsOfColouredVerticesAreMatteWhichInfoSays) {
    GltfWriter writer = triangle_gltf();
    writer.json["meshes"][0]["primitives"][0]["attributes"]["COLOR_0"] =
        writer.accessor(std::vector<float>(9, 0.5f), "VEC3", 3);
    writer.json["materials"] = {
        {{"name", "m"}, {"extensions", {{"KHR_materials_unlit", Json::object()}}}}};
    writer.json["meshes"][0]["primitives"][0]["material"] = 0;
    EXPECT_THAT(scene_of(writer), HasSubstr("\"m\": {\"color\": [1, 1, 1]}"));
    const Facts facts = describe_file(folder / "a.glb");
    const auto& members = std::get<std::vector<Facts>>(facts.value);
    const auto notes = std::ranges::find(members, "notes", &Facts::name);
    ASSERT_NE(notes, members.end());
    const auto& sentences = std::get<std::vector<Facts>>(notes->value);
    ASSERT_EQ(sentences.size(), 1u);
    EXPECT_THAT(std::get<std::string>(sentences[0].value), HasSubstr("KHR_materials_unlit"));
}

TEST_F(ApiGltf, TheFilesCameraAndLightsGoBeforeThoseOfAStudio) {
    GltfWriter writer = triangle_gltf();
    writer.json["cameras"] = {
        {{"type", "perspective"}, {"perspective", {{"yfov", 0.6}, {"znear", 1}}}}};
    writer.json["extensions"]["KHR_lights_punctual"]["lights"] = {
        {{"type", "directional"}, {"intensity", 3}}, {{"type", "point"}, {"intensity", 0}}};
    writer.json["nodes"].push_back({{"camera", 0}, {"translation", {3, 2, 20}}});
    for (const int light : {0, 1})
        writer.json["nodes"].push_back(
            {{"name", "sol"}, {"extensions", {{"KHR_lights_punctual", {{"light", light}}}}}});
    writer.json["scenes"][0]["nodes"] = {0, 1, 2, 3};
    const std::string scene = scene_of(writer, {.size = {400, 400}});
    EXPECT_THAT(scene,
                HasSubstr("\"observer\": {\"position\": [3, 2, 20], \"look_at\": [3, 2, 10], "
                          "\"up\": [0, 1, 0]"));
    EXPECT_THAT(scene, HasSubstr("\"angle\": 34.377468"));  // 0.6 rad of a square picture
    EXPECT_THAT(scene,
                HasSubstr("{\"name\": \"sol\", \"type\": \"directional\", \"direction\": [0, 0, "
                          "-1], \"intensity\": 1}"));
    EXPECT_THAT(scene, Not(HasSubstr("sun")));
    EXPECT_THAT(scene, Not(HasSubstr("\"ground\""))) << "its end would show";
    EXPECT_THAT(scene_of(writer, {.ground = true}), HasSubstr("\"ground\""));
    EXPECT_THAT(scene_of(writer, {.own_camera = false}), Not(HasSubstr("[3, 2, 20]")));
    EXPECT_NO_THROW(scene_of_file(folder / "a.glb"));
}

}  // namespace voxelume::v1
