// SPDX-License-Identifier: Apache-2.0
// Scenes of an animation's frames, against those scenes written by hand.
#include "runtime/scene/scene_animation.hpp"
#include "runtime/scene_file/read_scene.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "runtime/assets/asset_store.hpp"
#include "runtime/render/renderer.hpp"
#include "tests/oracles/image_hash.hpp"
#include "tests/support/file_fixture.hpp"
#include "tests/support/test_device.hpp"

namespace voxelume {
namespace {

using nlohmann::json;

/// A scene in which everything can move, at the places that the tests' tracks name.
json still_scene() {
    return json::parse(R"({"voxelume": 1,
        "world": {"voxel_size": 0.1, "bounds": {"min": [-1, -0.7, -1.2], "max": [1, 0.7, 1.2]},
                  "background": [0.1, 0.2, 0.3],
                  "medium": {"absorption": [0.1, 0.2, 0.3], "color": [0.5, 0.5, 0.5],
                             "density": {"kind": "height", "base": -0.5, "scale_height": 0.4}}},
        "materials": {"red": {"color": [0.8, 0.1, 0.1], "specular": 0.3}, "blue": {"color": [0.1, 0.2, 0.9]}},
        "models": {"block": {"shape": "difference", "surface": "exact", "parts": [
                       {"shape": "box", "size": [0.9, 0.5, 0.7]},
                       {"shape": "cylinder", "radius": 0.15, "height": 0.6, "position": [0.2, 0.3, 0]}]},
                   "egg": {"shape": "ellipsoid", "radii": [0.2, 0.3, 0.25], "surface": "smooth"}},
        "objects": [{"name": "block", "model": "block", "material": "red", "placement": "world"},
                    {"name": "egg", "model": "egg", "position": [0.5, 0.3, -0.4], "placement": "world"}],
        "lights": [{"name": "key", "type": "spot", "position": [-1, 2, -3], "look_at": [0, 0, 0], "angle": 50,
                    "intensity": 9},
                   {"type": "directional", "direction": [1, -1, 1], "intensity": 0.4}],
        "observer": {"position": [0.3, 0.4, -3], "look_at": [0, 0, 0],
                     "display": {"shape": "pyramid", "angles": [44, 34], "near": 0.5, "far": 6}},
        "render": {"size": [48, 36]}})");
}

Scene parse(const json& scene) {
    return parse_scene(scene.dump(), "s.json", {});
}

json key(double frame, json value) {
    return {{"frame", frame}, {"value", std::move(value)}};
}

json track(const char* target, std::vector<json> keys, const char* interpolation = nullptr) {
    json track = {{"target", target}, {"keys", std::move(keys)}};
    if (interpolation != nullptr) track["interpolation"] = interpolation;
    return track;
}

json animated(std::vector<json> tracks) {
    json scene = still_scene();
    scene["animation"] = {{"frames", 20}, {"fps", 10}, {"tracks", std::move(tracks)}};
    return scene;
}

std::string image_of(const Scene& scene) {
    RenderReport report;
    return fmt::format("{:016x}", oracle::image_hash(render(test_device(), scene, report)));
}

/// An object that moves keeps its voxels while it does, so that of the scene that stands still gets
/// the same.
void expect_same_image(const Scene& a, const json& written_by_hand) {
    Scene still = parse(written_by_hand);
    for (size_t number = 0; number < still.objects.size(); ++number)
        still.objects[number].moves = a.objects[number].moves;
    EXPECT_EQ(image_of(a), image_of(still));
}

}  // namespace

TEST(SceneAnimation, IsTheSceneOfFrameOneWhenRead) {
    const Scene scene = parse(animated(
        {track("objects.egg.position", {key(-3, {1, 0, 0}), key(5, {0, 0, 1})}, "linear")}));
    ASSERT_TRUE(moves(scene));
    EXPECT_EQ(glm::dvec3(scene.objects[1].world_from_object[3]), glm::dvec3(0.5, 0, 0.5));
    EXPECT_TRUE(scene.objects[1].moves);
    EXPECT_FALSE(scene.objects[0].moves);
    EXPECT_FALSE(moves(parse(still_scene())));
    EXPECT_FALSE(moves(parse(animated({}))));
}

TEST(SceneAnimation, CountsTimeInSecondsFromFrameOne) {
    const Scene scene = parse(animated({json::parse(R"({"target": "lights.key.intensity",
        "keys": [{"time": 0, "value": 2}, {"time": 1.5, "value": 8}]})")}));
    EXPECT_EQ(scene_at(scene, 1).lights[0].intensity.x, 2);
    EXPECT_EQ(scene_at(scene, 16).lights[0].intensity.x, 8);
    EXPECT_EQ(scene_at(scene, 8.5).lights[0].intensity.x, 5);
    EXPECT_EQ(scene_at(scene, 1000).lights[0].intensity.x, 8);
}

TEST(SceneAnimation, ShowsWhatASceneWrittenByHandShows) {
    const Scene moving = parse(animated(
        {track("objects.egg.position", {key(1, {0.5, 0.3, -0.4}), key(9, {-0.3, 0.1, -0.4})}),
         track("objects.egg.turn", {key(1, {0, 0, 0}), key(9, {80, 0, 40})}),
         track("objects.egg.scale", {key(1, 1), key(9, 2)}),
         track("objects.egg.material", {key(3, "red"), key(5, "blue")}),
         track("objects.block.visible", {key(1, true), key(7, false)}),
         track("models.block.parts[1].position[1]", {key(1, 0.3), key(9, 0.1)}),
         track("models.block.parts[1].radius", {key(1, 0.15), key(9, 0.25)}),
         track("lights.key.position", {key(1, {-1, 2, -3}), key(9, {1, 2, -3})}),
         track("lights[1].color", {key(1, {1, 1, 1}), key(9, {0, 0.5, 1})}),
         track("materials.red.color", {key(1, {0.8, 0.1, 0.1}), key(9, {0.4, 0.3, 0.1})}),
         track("materials.blue.reflection", {key(1, 0), key(9, 0.5)}),
         track("world.medium.density.base", {key(1, -0.5), key(9, 0.5)}),
         track("world.medium.absorption", {key(1, {0.1, 0.2, 0.3}), key(9, {0.3, 0.2, 0.1})}),
         track("world.ambient", {key(1, {0, 0, 0}), key(9, {0.2, 0.2, 0.2})}),
         track("observer.position", {key(1, {0.3, 0.4, -3}), key(9, {-0.5, 0.4, -3})}),
         track("observer.display.angles", {key(1, {44, 34}), key(9, {36, 26})})}));

    json first = still_scene();
    first["objects"][1]["material"] = "red";  // before the first key its value holds
    expect_same_image(moving, first);

    json half = still_scene();
    half["objects"][1].update({{"position", {0.1, 0.2, -0.4}},
                               {"turn", {40, 0, 20}},
                               {"scale", 1.5},
                               {"material", "blue"}});
    json& hole = half["models"]["block"]["parts"][1];
    hole["position"][1] = 0.2;
    hole["radius"] = 0.2;
    half["lights"][0]["position"] = {0, 2, -3};
    half["lights"][1]["color"] = {0.5, 0.75, 1};
    half["materials"]["red"]["color"] = {0.8 * 0.5 + 0.4 * 0.5, 0.1 * 0.5 + 0.3 * 0.5, 0.1};
    half["materials"]["blue"]["reflection"] = 0.25;
    json& medium = half["world"]["medium"];
    medium["density"]["base"] = 0;
    medium["absorption"] = {0.2, 0.2, 0.2};
    half["world"]["ambient"] = {0.1, 0.1, 0.1};
    half["observer"]["position"] = {0.3 * 0.5 + -0.5 * 0.5, 0.4, -3};
    half["observer"]["display"]["angles"] = {40, 30};
    expect_same_image(scene_at(moving, 5), half);

    EXPECT_FALSE(scene_at(moving, 7).objects[0].visible);
    json without = still_scene();
    without["objects"].erase(0);
    json hidden = still_scene();
    hidden["objects"][0]["visible"] = false;
    // The objects' numbers differ; everything else is equal.
    RenderReport report;
    EXPECT_EQ(render(test_device(), parse(hidden), report).planes,
              render(test_device(), parse(without), report).planes);
}

TEST(SceneAnimation, KeepsWhatWasChangedAfterReading) {
    Scene scene = parse(
        animated({track("models.egg.radii", {key(1, {0.2, 0.3, 0.25}), key(9, {0.4, 0.3, 0.25})}),
                  track("observer.position", {key(1, {0, 0, -3}), key(9, {0, 0, -2})}),
                  track("world.ambient", {key(1, {0, 0, 0}), key(9, {1, 1, 1})})}));
    resize(scene, {20, 10});
    scene.world.voxel_size *= 2;
    scene.models[1].voxel_size *= 4;
    scene.observer.display.voxels = {3, 4, 5};
    const Scene now = scene_at(scene, 5);
    EXPECT_EQ(now.world.voxel_size, scene.world.voxel_size);
    EXPECT_EQ(now.models[1].voxel_size, scene.models[1].voxel_size);
    EXPECT_EQ(now.observer.display.voxels, glm::ivec3(3, 4, 5));
    EXPECT_EQ(now.render.size, glm::ivec2(20, 10));
    EXPECT_DOUBLE_EQ(now.models[1].solid->radii.x, 0.3);
    EXPECT_EQ(now.world.ambient, glm::vec3(0.5f));
    EXPECT_EQ(now.observer.position, glm::dvec3(0, 0, -2.5));
}

TEST(SceneAnimation, FindsTheExtentOfModelsAgain) {
    const Scene scene =
        parse(animated({track("objects.egg.position", {key(1, {0, 0, 0}), key(9, {8, 0, 0})}),
                        track("objects.block.model", {key(1, "block"), key(5, "egg")}),
                        track("objects.egg.visible", {key(1, true), key(9, false)})}));
    EXPECT_EQ(scene_at(scene, 1).models[1].extent.max.x, 1);
    const Scene later = scene_at(scene, 9);
    EXPECT_EQ(later.models[0].extent.min, later.models[0].extent.max);
    EXPECT_EQ(later.models[1].extent.max.x, 1);
    EXPECT_EQ(later.objects[0].model, 1);
}

class SceneFiles : public FileTest {
  protected:
    void SetUp() override {
        FileTest::SetUp();
        for (int number = 7; number <= 9; ++number)
            put_bytes(folder / fmt::format("m.{:03}.obj", number),
                      fmt::format("v 0 0 0\nv {} 0 0\nv 0 1 0\nf 1 2 3\n", number));
    }
    std::string mesh_at(const std::string& sequence, double frame) {
        json scene = still_scene();
        scene["models"]["m"] = {{"mesh", "m.###.obj"}, {"sequence", json::parse(sequence)}};
        const Scene read = parse_scene(scene.dump(), folder / "s.json", {});
        return scene_at(read, frame).models[2].mesh.filename();
    }
};

TEST_F(SceneFiles, ComeOneAFrameAndStayOrLoop) {
    const std::string stay = R"({"first": 7, "last": 9, "start": 3})";
    EXPECT_EQ(mesh_at(stay, -5), "m.007.obj");
    EXPECT_EQ(mesh_at(stay, 3.9), "m.007.obj");
    EXPECT_EQ(mesh_at(stay, 4), "m.008.obj");
    EXPECT_EQ(mesh_at(stay, 99), "m.009.obj");
    const std::string loop = R"({"first": 7, "last": 9, "start": 3, "loop": true})";
    EXPECT_EQ(mesh_at(loop, 2), "m.009.obj");
    EXPECT_EQ(mesh_at(loop, 6), "m.007.obj");
    EXPECT_EQ(mesh_at(loop, 13), "m.008.obj");
}

TEST_F(SceneFiles, ThatAreMissingAreNamedInOneSentence) {
    try {
        mesh_at(R"({"first": 6, "last": 11})", 1);
        FAIL();
    } catch (const Error& error) {
        EXPECT_EQ(error.kind(), ErrorKind::input);
        EXPECT_THAT(error.what(),
                    testing::HasSubstr("models.m.mesh: 3 of the 6 files are missing: "
                                       "\"m.006.obj\", \"m.010.obj\", \"m.011.obj\"; give their"));
    }
}

TEST_F(SceneFiles, OfASequenceHaveNoTrack) {
    json scene = animated({track("models.m.mesh", {key(1, "m.007.obj"), key(4, "m.009.obj")})});
    scene["models"]["m"] = {{"mesh", "m.###.obj"}, {"sequence", {{"first", 7}, {"last", 9}}}};
    const Error error = error_of([&] { parse_scene(scene.dump(), folder / "s.json", {}); });
    EXPECT_EQ(error.kind(), ErrorKind::scene);
    EXPECT_THAT(error.what(),
                testing::HasSubstr("animation.tracks[0].target: models.m has its files from its "
                                   "\"sequence\"; leave out that or this track"));
}

TEST_F(SceneFiles, AndMorphsFollowTheirTracks) {
    json scene = animated({track("models.m.mesh", {key(1, "m.007.obj"), key(4, "m.009.obj")}),
                           track("models.m.morph.amount", {key(1, 0), key(5, 1)})});
    scene["models"]["m"] = {{"mesh", "m.007.obj"}, {"morph", {{"mesh", "m.008.obj"}}}};
    const Scene read = parse_scene(scene.dump(), folder / "s.json", {});
    const Model now = scene_at(read, 4).models[2];
    EXPECT_EQ(now.mesh.filename(), "m.009.obj");
    EXPECT_EQ(now.morph->mesh.filename(), "m.008.obj");
    EXPECT_DOUBLE_EQ(now.morph->amount, 0.75);
    AssetStore store;
    EXPECT_FLOAT_EQ(store.mesh_of(now)->positions[1].x, 0.25f * 9 + 0.75f * 8);
}

}  // namespace voxelume
