// SPDX-License-Identifier: Apache-2.0
// Clips of glTF files: the scene's objects at random times against an evaluation written here.
#include <gmock/gmock.h>

#include <cmath>
#include <fstream>
#include <random>

#include "runtime/assets/asset_store.hpp"
#include "runtime/import/scene_of_file.hpp"
#include "runtime/io/gltf/gltf_animation.hpp"
#include "runtime/scene/scene_animation.hpp"
#include "runtime/scene_file/read_scene.hpp"
#include "tests/io/gltf/gltf_random_tree.hpp"
#include "tests/support/parsed_gltf.hpp"

namespace voxelume {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;
using Json = nlohmann::json;
class GltfMotionTest : public FileTest {
  protected:
    std::string text_of(const GltfWriter& writer, const ImportOptions& options = {}) {
        std::ofstream(folder / "a.glb", std::ios::binary) << writer.glb();
        AssetStore assets;
        return scene_of_file(folder / "a.glb", "a.glb", options, assets);
    }

    Scene scene_in(const std::string& text) {
        AssetStore assets;
        return parse_scene(text, folder / "a.json", {folder}, [&](const Model& model, bool keeps) {
            return assets.box_of_file(model, keeps);
        });
    }
};

glm::dmat4 object_named(const Scene& scene, const std::string& name) {
    for (const Object& object : scene.objects)
        if (object.name == name) return object.world_from_object;
    ADD_FAILURE() << "no object " << name;
    return glm::dmat4(0);
}

/// A triangle that a clip moves by a sampler of one path.
GltfWriter moved_triangle(const char* path, const std::vector<float>& times,
                          const std::vector<float>& values, const char* name = nullptr) {
    GltfWriter writer = triangle_gltf();
    const int input = writer.accessor(times, "SCALAR", 1);
    const bool is_turn = std::string(path) == "rotation";
    const int output = writer.accessor(values, is_turn ? "VEC4" : "VEC3", is_turn ? 4 : 3);
    Json& animation = writer.json["animations"][0];
    if (name) animation["name"] = name;
    animation["channels"] = {{{"sampler", 0}, {"target", {{"node", 0}, {"path", path}}}}};
    animation["samplers"] = {{{"input", input}, {"output", output}}};
    return writer;
}

}  // namespace

TEST_F(GltfMotionTest, MovesObjectsAsTheFormatSaysAtAnyTime) {
    for (const unsigned seed : {1U, 2U, 3U}) {
        const RandomTree tree(seed);
        const Scene scene = scene_in(text_of(tree.writer()));
        ASSERT_EQ(scene.objects.size(), size_t(RandomTree::kNodes) + 1) << "and the ground";
        std::mt19937 random(seed + 100);
        std::uniform_real_distribution<double> time(-0.5, 8);
        double worst = 0;
        for (int i = 0; i < 100; ++i) {
            const double t = time(random);
            const Scene now = scene_at(scene, 1 + t * scene.animation.fps);
            for (int node = 0; node < RandomTree::kNodes; ++node) {
                const Matrix4 expected = tree.world_rows(node, t);
                const glm::dmat4 map = object_named(now, "node " + std::to_string(node));
                for (int row = 0; row < 3; ++row)
                    for (int column = 0; column < 4; ++column)
                        worst = std::max(worst, std::abs(map[column][row] -
                                                         expected[size_t(row)][size_t(column)]));
            }
        }
        EXPECT_LT(worst, 1e-6) << "seed " << seed;
    }
}

TEST_F(GltfMotionTest, HasAsManyFramesAsItsClipAndAFiner) {
    const std::string text =
        text_of(moved_triangle("translation", {0, 0.5F, 2}, {0, 0, 0, 10, 0, 0, 10, 10, 0}));
    const Scene scene = scene_in(text);
    EXPECT_EQ(scene.animation.frames, 49);
    EXPECT_TRUE(scene.objects[0].moves);
    EXPECT_EQ(glm::dvec3(scene_at(scene, 7).objects[0].world_from_object[3]), glm::dvec3(5, 0, 0));
    EXPECT_THAT(text, HasSubstr("\"target\": \"objects.object.position\""));
    EXPECT_GE(scene.fitted.shown.max.x, 17) << "the world holds all frames";
    const GltfWriter still = triangle_gltf();
    EXPECT_THAT(text_of(still), Not(HasSubstr("animation")));
    EXPECT_EQ(scene_in(text_of(still)).animation.frames, 1);
}

TEST_F(GltfMotionTest, ShowsTheClipThatIsAskedFor) {
    GltfWriter writer = moved_triangle("translation", {0, 1}, {1, 1, 1, 2, 1, 1}, "walk");
    writer.json["animations"].push_back(writer.json["animations"][0]);
    writer.json["animations"].push_back(writer.json["animations"][0]);
    writer.json["animations"][1].erase("name");
    writer.json["animations"][2]["channels"][0]["target"]["path"] = "scale";
    EXPECT_THAT(gltf_clip_names(parsed_gltf(writer)), ElementsAre("walk", "clip 2", "walk 3"));
    EXPECT_EQ(gltf_clip(parsed_gltf(writer), 1).seconds, 1);
    EXPECT_THAT(text_of(writer), HasSubstr("objects.object.position"));
    ImportOptions options;
    options.clip = "walk 3";
    EXPECT_THAT(text_of(writer, options), HasSubstr("objects.object.scale"));
    options.clip = "wlak";
    const Error error = error_of([&] { text_of(writer, options); });
    EXPECT_EQ(error.kind(), ErrorKind::usage);
    EXPECT_THAT(error.what(), HasSubstr("has no clip \"wlak\"; did you mean \"walk\"?"));
}

TEST_F(GltfMotionTest, ObjectsThatVanishByTheirScaleBecomeTiny) {
    const std::string text = text_of(moved_triangle("scale", {0, 1}, {0, 0, 0, 2, 2, 2}));
    const Scene scene = scene_in(text);
    EXPECT_NEAR(scene.objects[0].world_from_object[0].x, 2e-4, 1e-12);
    EXPECT_EQ(scene_at(scene, 25).objects[0].world_from_object[0].x, 2);
}

TEST_F(GltfMotionTest, ObjectsThatAScaleTurnsInsideOutAreThereInEveryFrame) {
    GltfWriter writer = moved_triangle("scale", {0, 1}, {1, 2, 3, -1, 2, -3});
    writer.json["nodes"].push_back({{"children", {0}}});
    writer.json["scenes"][0]["nodes"] = {1};
    Json channel = writer.json["animations"][0]["channels"][0];
    channel["target"]["node"] = 1;
    const std::string one = text_of(writer);
    writer.json["animations"][0]["channels"].push_back(channel);
    for (const std::string& text : {one, text_of(writer)}) {
        const Scene scene = scene_in(text);
        for (int frame = 1; frame <= 25; ++frame) {
            const Object object = scene_at(scene, frame).objects[0];
            const double share = 1 - (frame - 1) / 12.0, x = text == one ? share : share * share;
            if (object.visible) {
                // A ten-thousandth of the longest side, 2, stays, and floats are rounded.
                EXPECT_NEAR(object.world_from_object[0].x, x, 2.1e-4) << frame;
            } else {
                EXPECT_EQ(frame, 13);
            }
        }
        EXPECT_EQ(scene_at(scene, 13).objects[0].visible, text == one);
    }
}

TEST_F(GltfMotionTest, ThatLeavesTheReachOfScenesIsRefused) {
    EXPECT_THAT(error_of([&] {
                    text_of(moved_triangle("translation", {0, 1}, {0, 0, 0, 1e9F, 0, 0}));
                }).what(),
                HasSubstr("a.glb: reaches farther than scenes do, which is 1000000000 m"));
}

TEST_F(GltfMotionTest, CamerasAndLightsMoveFrameByFrame) {
    GltfWriter writer = moved_triangle(
        "rotation", {0, 1}, {0, 0, 0, 1, 0, float(std::sqrt(0.5)), 0, float(std::sqrt(0.5))});
    writer.json["cameras"] = {
        {{"type", "perspective"}, {"perspective", {{"yfov", 0.6}, {"znear", 1}}}}};
    writer.json["extensions"]["KHR_lights_punctual"]["lights"] = {{{"type", "spot"}}};
    writer.json["nodes"][0]["children"] = {1, 2};
    writer.json["nodes"].push_back({{"camera", 0}, {"translation", {3, 2, 20}}});
    writer.json["nodes"].push_back({{"name", "lamp"},
                                    {"translation", {0, 9, 1}},
                                    {"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}});
    const Scene scene = scene_in(text_of(writer));
    // A quarter about Y takes (3, 2, 20) to (20, 2, -3), and -Z to -X.
    const Scene last = scene_at(scene, 25);
    EXPECT_LT(glm::distance(last.observer.position, glm::dvec3(20, 2, -3)), 1e-6);
    EXPECT_LT(glm::distance(glm::dvec3(last.lights[0].position), glm::dvec3(1, 9, 0)), 1e-6);
    EXPECT_LT(glm::distance(glm::dvec3(last.lights[0].direction), glm::dvec3(-1, 0, 0)), 1e-6);
    EXPECT_LT(glm::distance(scene.observer.position, glm::dvec3(3, 2, 20)), 1e-6);
}

TEST_F(GltfMotionTest, CamerasAndLightsThatAScaleFlattensKeepTheirDirection) {
    for (const std::vector<float>& values :
         {std::vector<float>{1, 1, 1, 1, 1, 0}, {1, 1, 1, 0, 0, 0}, {0, 0, 0, 1, 1, 1}}) {
        GltfWriter writer = moved_triangle("scale", {0, 1}, values);
        writer.json["cameras"] = {
            {{"type", "perspective"}, {"perspective", {{"yfov", 0.6}, {"znear", 1}}}}};
        writer.json["extensions"]["KHR_lights_punctual"]["lights"] = {{{"type", "spot"}}};
        writer.json["nodes"][0]["children"] = {1};
        writer.json["nodes"].push_back({{"camera", 0},
                                        {"translation", {3, 2, 20}},
                                        {"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}});
        const Scene scene = scene_in(text_of(writer));
        for (int frame = 1; frame <= 25; ++frame) {
            const Scene now = scene_at(scene, frame);
            const glm::dvec3 ahead(0, 0, -1);
            EXPECT_LT(glm::distance(now.observer.world_from_observer[2], ahead), 1e-6) << frame;
            EXPECT_LT(glm::distance(glm::dvec3(now.lights[0].direction), ahead), 1e-6) << frame;
        }
    }
}

TEST(GltfClips, ThatAreDamagedAreRefused) {
    const auto refused = [](GltfWriter writer, const std::function<void(Json&)>& damage) {
        damage(writer.json);
        return std::string(error_of([&] { gltf_clip(parsed_gltf(writer), 0); }).what());
    };
    const GltfWriter good = moved_triangle("translation", {0, 1}, {0, 0, 0, 1, 0, 0});
    EXPECT_THAT(refused(moved_triangle("translation", {1, 1}, {0, 0, 0, 1, 0, 0}), [](Json&) {}),
                HasSubstr("animations[0].samplers[0]: a key at 1 s comes after one at 1 s"));
    EXPECT_THAT(refused(moved_triangle("translation", {0, 1, 2}, {0, 0, 0, 1, 0, 0}), [](Json&) {}),
                HasSubstr("3 keys, and 2 values"));
    EXPECT_THAT(refused(moved_triangle("rotation", {0}, {0, 0, 0, 0}), [](Json&) {}),
                HasSubstr("a rotation is [0, 0, 0, 0]"));
    EXPECT_THAT(refused(moved_triangle("translation", {0}, {NAN, 0, 0}), [](Json&) {}),
                HasSubstr("isn't a number"));
    EXPECT_THAT(refused(moved_triangle("translation", {NAN}, {0, 0, 0}), [](Json&) {}),
                HasSubstr("time isn't a number"));
    const auto in_animation = [&](const char* path, const Json& value) {
        return refused(
            good, [&](Json& json) { json["animations"][0][Json::json_pointer(path)] = value; });
    };
    EXPECT_THAT(in_animation("/samplers/0/interpolation", "CUBIC"), HasSubstr("no interpolation"));
    EXPECT_THAT(in_animation("/samplers/0/interpolation", "CUBICSPLINE"),
                HasSubstr("2 keys, and 2 values"));
    EXPECT_THAT(in_animation("/samplers/0/output", 99), HasSubstr("the file has 3 of these"));
    EXPECT_THAT(in_animation("/channels/0/sampler", 1), HasSubstr("the file has 1 of these"));
    EXPECT_THAT(in_animation("/channels/0/target/node", 7), HasSubstr("the file has 1 of these"));
    EXPECT_THAT(refused(good,
                        [](Json& json) {
                            Json& channels = json["animations"][0]["channels"];
                            channels.push_back(channels[0]);
                        }),
                HasSubstr("what another channel changes already"));
}

}  // namespace voxelume
