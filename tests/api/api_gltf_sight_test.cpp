// SPDX-License-Identifier: Apache-2.0
// glTF files in place of scenes, in other sizes, with emissive objects, and seen by their own
// cameras.
#include <gmock/gmock.h>

#include <cmath>

#include "tests/api/api_gltf_fixture.hpp"

namespace voxelume::v1 {

using testing::HasSubstr;
using testing::Not;
using Json = nlohmann::json;

TEST_F(ApiGltf, OfAnotherSizeMovesAndLooksTheSame) {
    GltfWriter writer = triangle_gltf();
    const int times = writer.accessor(std::vector<float>{0, 1}, "SCALAR", 1);
    const int places = writer.accessor(std::vector<float>{0, 0, 0, 2, 1, 0}, "VEC3", 3);
    writer.json["animations"] = {
        {{"channels",
          {{{"sampler", 0}, {"target", {{"node", 0}, {"path", "translation"}}}},
           {{"sampler", 0}, {"target", {{"node", 2}, {"path", "translation"}}}}}},
         {"samplers", {{{"input", times}, {"output", places}}}}}};
    writer.json["extensions"]["KHR_lights_punctual"]["lights"] = {
        {{"type", "point"}, {"intensity", 400}}, {{"type", "directional"}}};
    writer.json["nodes"] = {{{"mesh", 0}},
                            {{"translation", {3, 2, 20}}, {"children", {2, 3, 4}}},
                            {{"camera", 0}},
                            {{"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}},
                            {{"extensions", {{"KHR_lights_punctual", {{"light", 1}}}}}}};
    writer.json["scenes"][0]["nodes"] = {0, 1};
    for (const Json& camera :
         {Json{{"type", "perspective"}, {"perspective", {{"yfov", 0.6}, {"znear", 1}}}},
          Json{{"type", "orthographic"},
               {"orthographic", {{"xmag", 6}, {"ymag", 6}, {"znear", 1}, {"zfar", 50}}}}}) {
        writer.json["cameras"] = Json::array({camera});
        scene_of(writer);
        const auto picture = [&](const ImportOptions& options) {
            const Scene scene = scene_of_file(folder / "a.glb", options, {.cache = no_cache});
            EXPECT_EQ(scene.frames(), 25);
            return render_image(scene, *device, 13, {.cache = no_cache});
        };
        const Image own = picture({.size = {60, 45}});
        const Image large = picture({.fit = 300, .size = {60, 45}});
        size_t seen = 0, other = 0;
        for (size_t i = 0; i < own.object_ids().size(); ++i) {
            seen += own.object_ids()[i] == 1;
            other += own.object_ids()[i] != large.object_ids()[i] ||
                     std::abs(own.plane("G")[i] - large.plane("G")[i]) > 0.01;
        }
        EXPECT_GT(seen, 100u) << camera;
        EXPECT_LT(other, 10u) << camera;
    }
}

TEST_F(ApiGltf, EmissiveObjectsShareTheRaysOfEachPoint) {
    const auto scene_with = [&](int count) {
        GltfWriter writer = triangle_gltf();
        writer.json["materials"] = {{{"name", "m"}, {"emissiveFactor", {1, 1, 1}}}};
        writer.json["meshes"][0]["primitives"][0]["material"] = 0;
        writer.json["nodes"] = Json::array();
        writer.json["scenes"][0]["nodes"] = Json::array();
        for (int i = 0; i < count; ++i) {
            writer.json["nodes"].push_back({{"mesh", 0}, {"translation", {9 * i, 0, 0}}});
            writer.json["scenes"][0]["nodes"].push_back(i);
        }
        return scene_of(writer);
    };
    EXPECT_THAT(scene_with(1), Not(HasSubstr("\"spots\": 72")));
    EXPECT_THAT(scene_with(3), HasSubstr("\"spots\": 24}"));
    EXPECT_THAT(scene_with(72), HasSubstr("\"spots\": 1}"));
    EXPECT_THAT(scene_with(72), Not(HasSubstr("global")));
    EXPECT_THAT(scene_with(73), HasSubstr("\"light\": \"global\""));
}

TEST_F(ApiGltf, ACameraBelowHasNoGroundAboveIt) {
    GltfWriter writer = triangle_gltf();
    writer.json["cameras"] = {
        {{"type", "perspective"}, {"perspective", {{"yfov", 0.6}, {"znear", 1}}}}};
    for (const double height : {1.0, -1.0}) {
        writer.json["nodes"] = {{{"mesh", 0}}, {{"camera", 0}, {"translation", {0, height, 9}}}};
        writer.json["scenes"][0]["nodes"] = {0, 1};
        EXPECT_EQ(scene_of(writer).find("\"ground\"") != std::string::npos, height > 0);
        EXPECT_THAT(scene_of(writer, {.ground = true}), HasSubstr("\"ground\""));
        EXPECT_THAT(scene_of(writer, {.longitude = 20, .own_camera = false}),
                    HasSubstr("\"ground\""));
    }
}

}  // namespace voxelume::v1
