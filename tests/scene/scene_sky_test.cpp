// SPDX-License-Identifier: Apache-2.0
// The sky of a scene and the settings of its light: the meaning of their keys, and the errors of
// wrong ones.
#include <gmock/gmock.h>

#include <glm/geometric.hpp>

#include "runtime/scene/scene.hpp"
#include "runtime/scene_file/read_scene.hpp"
#include "tests/support/file_fixture.hpp"

namespace voxelume {
namespace {

using testing::HasSubstr;

Scene scene_with_sky(const std::string& sky, const std::string& render = "") {
    return parse_scene(R"({"voxelume": 1, "world": {"voxel_size": 0.1,
"bounds": {"min": [0, 0, 0], "max": [1, 2, 3]})" +
                           (sky.empty() ? "" : ", \"sky\": " + sky) + R"(},
"observer": {"position": [0, 0, 0], "display": {"shape": "ball", "radius": 2}},
"render": {)" + render + "}}",
                       "sky.json", {});
}

Sky sky_of(const std::string& text) {
    return scene_with_sky(text).world.sky.value();
}

std::string objection(const std::string& sky, const std::string& render = "") {
    return error_of([&] { scene_with_sky(sky, render); }).what();
}

TEST(SceneSky, HasTheValuesOfItsKeys) {
    EXPECT_FALSE(scene_with_sky("").world.sky.has_value());
    const Sky constant = sky_of(R"({"kind": "constant", "color": [1, 2, 3], "strength": 4})");
    EXPECT_EQ(constant.kind, SkyKind::constant);
    EXPECT_EQ(constant.color, glm::vec3(1, 2, 3));
    EXPECT_EQ(constant.strength, 4);
    EXPECT_EQ(constant.samples, 16);
    const Sky gradient = sky_of(R"({"kind": "gradient", "zenith": [1, 2, 3], "horizon": [4, 5, 6],
        "ground": [7, 8, 9], "samples": 3})");
    EXPECT_EQ(gradient.kind, SkyKind::gradient);
    EXPECT_EQ(gradient.zenith, glm::vec3(1, 2, 3));
    EXPECT_EQ(gradient.horizon, glm::vec3(4, 5, 6));
    EXPECT_EQ(gradient.ground, glm::vec3(7, 8, 9));
    EXPECT_EQ(gradient.samples, 3);
    const Sky sun = sky_of(R"({"kind": "sun", "direction": [0, -3, 4], "angle": 2,
        "intensity": 5, "turbidity": 6})");
    EXPECT_EQ(sun.kind, SkyKind::sun);
    EXPECT_NEAR(glm::distance(sun.direction, glm::dvec3(0, -0.6, 0.8)), 0, 1e-15);
    EXPECT_EQ(sun.angle, 2);
    EXPECT_EQ(sun.intensity, 5);
    EXPECT_EQ(sun.turbidity, 6);
    EXPECT_EQ(sun.color, glm::vec3(1.0f, 0.95f, 0.88f));
}

class SceneSkyMap : public FileTest {
  protected:
    Sky map_of(const std::string& keys) {
        return parse_scene(R"({"voxelume": 1, "world": {"voxel_size": 0.1,
"bounds": {"min": [0, 0, 0], "max": [1, 2, 3]}, "sky": {"kind": "map", )" +
                               keys + R"(}},
"observer": {"position": [0, 0, 0], "display": {"shape": "ball", "radius": 2}}})",
                           folder / "sky.json", {})
            .world.sky.value();
    }
};

TEST_F(SceneSkyMap, HasAFileAndWhereItIsTurned) {
    put_bytes(folder / "around.hdr", "");
    const Sky map = map_of(R"("file": "around.hdr", "rotation": -30, "visible": false)");
    EXPECT_EQ(map.kind, SkyKind::map);
    EXPECT_EQ(map.file, std::filesystem::canonical(folder / "around.hdr"));
    EXPECT_EQ(map.rotation, -30);
    EXPECT_FALSE(map.visible);
    EXPECT_TRUE(map.map.room);
    EXPECT_EQ(map, map_of(R"("file": "around.hdr", "rotation": -30, "visible": false)"));
}

TEST_F(SceneSkyMap, ObjectsToAFileThatIsMissing) {
    EXPECT_THAT(error_of([&] { map_of(R"("rotation": 1)"); }).what(), HasSubstr("file"));
    EXPECT_THAT(error_of([&] { map_of(R"("file": "around.hdr")"); }).what(),
                HasSubstr("world.sky.file: there is no file \"around.hdr\""));
}

TEST(SceneSky, ObjectsToWhatNoSkyHas) {
    EXPECT_THAT(objection(R"({"kind": "cloudy"})"), HasSubstr("\"cloudy\""));
    EXPECT_THAT(objection(R"({"kind": "constant"})"), HasSubstr("color"));
    EXPECT_THAT(objection(R"({"kind": "sun"})"), HasSubstr("direction"));
    EXPECT_THAT(objection(R"({"kind": "sun", "direction": [0, 0, 0]})"), HasSubstr("direction"));
    EXPECT_THAT(objection(R"({"kind": "sun", "direction": [0, 1, 1]})"), HasSubstr("downwards"));
    EXPECT_THAT(objection(R"({"kind": "sun", "direction": [0, -1, 0], "turbidity": 1})"),
                HasSubstr("turbidity"));
    EXPECT_THAT(objection(R"({"kind": "gradient", "color": [1, 1, 1]})"), HasSubstr("color"));
}

TEST(SceneSky, GlobalLightIsASetting) {
    EXPECT_EQ(scene_with_sky("").render.light, LightMode::local);
    const RenderSettings render = scene_with_sky("", R"("light": "global", "bounces": 3)").render;
    EXPECT_EQ(render.light, LightMode::global);
    EXPECT_EQ(render.bounces, 3);
    EXPECT_EQ(render.emitters, EmitterSearch::both);
    EXPECT_EQ(scene_with_sky("", R"("emitters": "rays")").render.emitters, EmitterSearch::rays);
    EXPECT_THAT(objection("", R"("emitters": "all")"), HasSubstr("\"all\""));
    EXPECT_THAT(objection("", R"("light": "dim")"), HasSubstr("\"dim\""));
    EXPECT_THAT(objection("", R"("bounces": 65)"), HasSubstr("bounces"));
}

}  // namespace
}  // namespace voxelume
