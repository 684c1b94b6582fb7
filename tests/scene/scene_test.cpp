// SPDX-License-Identifier: Apache-2.0
// The meaning of scene files.
#include "runtime/scene/scene.hpp"
#include "runtime/scene_file/read_scene.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <filesystem>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <numbers>
#include <random>

#include "runtime/base/error.hpp"
#include "tests/scene/small_scene.hpp"

namespace voxelume {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::StartsWith;

constexpr double kPi = std::numbers::pi;

Scene parse_room(const std::string& text) {
    return parse_scene(text, "room.json", {});
}

glm::dmat4 placed(const std::string& factors) {
    return parse_room(scene_with(R"("objects": [{"model": "ball", )" + factors + "}],"))
        .objects[0]
        .world_from_object;
}

glm::dvec3 move(const glm::dmat4& map, glm::dvec3 p) {
    return glm::dvec3(map * glm::dvec4(p, 1));
}

/// An observer with the given members, position (1, 2, 3) and a ball as its display.
Observer observer_with(const std::string& members) {
    return parse_room(
               R"({"voxelume": 1, "world": {"voxel_size": 1, "bounds": {"min": [0, 0, 0], "max": [1, 2, 3]}},
        "observer": {"position": [1, 2, 3], "display": {"shape": "ball", "radius": 1})" +
               members + "}}")
        .observer;
}

Display display_with(const std::string& display, const std::string& render = "{}") {
    return parse_room(
               R"({"voxelume": 1, "world": {"voxel_size": 1, "bounds": {"min": [0, 0, 0], "max": [2, 3, 6]}},
        "render": )" +
               render + R"(, "observer": {"position": [0, 0, 0], "display": )" + display + "}}")
        .observer.display;
}

}  // namespace

TEST(ScenePlacement, NinetyDegreeTurnsAreExact) {
    // Each turn uses one axis: psi carries Z to X, theta carries Y to Z, gamma carries X to Y.
    EXPECT_EQ(move(placed(R"("turn": [90, 0, 0])"), {2, 3, 5}), glm::dvec3(5, 3, -2));
    EXPECT_EQ(move(placed(R"("turn": [0, 90, 0])"), {2, 3, 5}), glm::dvec3(2, -5, 3));
    EXPECT_EQ(move(placed(R"("turn": [0, 0, 90])"), {2, 3, 5}), glm::dvec3(-3, 2, 5));
    // gamma turns first, then theta, then psi: (2,3,5) -> (-3,2,5) -> (-3,-5,2) -> (2,-5,3).
    EXPECT_EQ(move(placed(R"("turn": [90, 90, 90])"), {2, 3, 5}), glm::dvec3(2, -5, 3));
    EXPECT_EQ(move(placed(R"("turn": [-270, 450, 36090])"), {2, 3, 5}), glm::dvec3(2, -5, 3));
    EXPECT_EQ(move(placed(R"("turn": [180, 0, -90])"), {2, 3, 5}), glm::dvec3(-3, -2, -5));
}

TEST(ScenePlacement, ScalesFirstThenTurnsThenShifts) {
    EXPECT_EQ(move(placed(R"("position": [10, 20, 30], "turn": [90, 0, 0], "scale": [2, 3, -4])"),
                   {1, 1, 1}),
              glm::dvec3(6, 23, 28));
    EXPECT_EQ(move(placed(R"("scale": 2)"), {1, 2, 3}), glm::dvec3(2, 4, 6));
    EXPECT_EQ(placed(R"("priority": 7)"), glm::dmat4(1));
}

TEST(ScenePlacement, AMatrixIsThreeRows) {
    const glm::dmat4 map = placed(R"("matrix": [[1, 2, 0, 10], [0, 1, 0, 20], [0, 3, -1, 30]])");
    EXPECT_EQ(move(map, {1, 2, 3}), glm::dvec3(15, 22, 33));
    EXPECT_EQ(map[0].w, 0);
    EXPECT_EQ(map[3].w, 1);
}

TEST(ScenePlacement, AnyTurnIsTheProductOfThreeRotations) {
    const unsigned seed = 20170711;
    std::mt19937_64 random(seed);
    std::uniform_real_distribution<double> degrees(-720, 720);
    for (int i = 0; i < 1000; ++i) {
        const double psi = degrees(random), theta = degrees(random), gamma = degrees(random);
        SCOPED_TRACE(testing::Message() << "seed " << seed << ", case " << i);
        const glm::dmat4 map = placed(fmt::format("\"turn\": [{}, {}, {}]", psi, theta, gamma));
        // Each rotation is applied to the point by its own formula.
        glm::dvec3 p(0.3, -0.5, 0.7);
        const glm::dvec3 start = p;
        const double g = gamma * kPi / 180, t = theta * kPi / 180, s = psi * kPi / 180;
        p = {p.x * std::cos(g) - p.y * std::sin(g), p.x * std::sin(g) + p.y * std::cos(g), p.z};
        p = {p.x, p.y * std::cos(t) - p.z * std::sin(t), p.y * std::sin(t) + p.z * std::cos(t)};
        p = {p.x * std::cos(s) + p.z * std::sin(s), p.y, p.z * std::cos(s) - p.x * std::sin(s)};
        EXPECT_LT(glm::distance(move(map, start), p), 1e-14);
    }
}

TEST(SceneObserver, LooksAlongItsZWithItsYUpAndItsXToTheLeftOfTheImage) {
    // When the observer looks along -X with Y up, its right hand points along -Z and X_E along +Z.
    const Observer observer = observer_with(R"(, "look_at": [-4, 2, 3])");
    EXPECT_EQ(observer.world_from_observer[0], glm::dvec3(0, 0, 1));
    EXPECT_EQ(observer.world_from_observer[1], glm::dvec3(0, 1, 0));
    EXPECT_EQ(observer.world_from_observer[2], glm::dvec3(-1, 0, 0));
}

TEST(SceneObserver, ATiltedUpIsMadePerpendicularToTheView) {
    const Observer observer = observer_with(R"(, "look_at": [1, 2, 8], "up": [0, 3, 4])");
    EXPECT_EQ(observer.world_from_observer, glm::dmat3(1));
    EXPECT_EQ(observer.position, glm::dvec3(1, 2, 3));
}

TEST(SceneObserver, ATurnIsTheOneOfObjects) {
    const glm::dmat3 axes = observer_with(R"(, "turn": [90, 90, 90])").world_from_observer;
    EXPECT_EQ(axes * glm::dvec3(2, 3, 5), glm::dvec3(2, -5, 3));
    EXPECT_EQ(observer_with("").world_from_observer, glm::dmat3(1));
}

TEST(SceneDisplay, OneAngleMakesSquarePixelsOfAnyImage) {
    Scene scene = parse_room(scene_with(R"("render": {"size": [200, 100]},)"));
    Display& display = scene.observer.display;
    EXPECT_DOUBLE_EQ(display.half_angles.x, 20 * kPi / 180);
    EXPECT_DOUBLE_EQ(std::tan(display.half_angles.y) * 2, std::tan(display.half_angles.x));
    resize(scene, {100, 300});
    EXPECT_DOUBLE_EQ(display.half_angles.x, 20 * kPi / 180);
    EXPECT_DOUBLE_EQ(std::tan(display.half_angles.y), std::tan(display.half_angles.x) * 3);
    EXPECT_EQ(scene.render.size, glm::ivec2(100, 300));
    EXPECT_THROW(resize(scene, {0, 5}), Error);
}

TEST(SceneDisplay, TwoAnglesStayWhateverTheImage) {
    const Display display =
        display_with(R"({"shape": "pyramid", "angles": [60, 30], "near": 1, "far": 4})");
    EXPECT_DOUBLE_EQ(display.half_angles.x, kPi / 6);
    EXPECT_DOUBLE_EQ(display.half_angles.y, kPi / 12);
    EXPECT_FALSE(display.square_pixels);
    EXPECT_EQ(display.near, 1);
    EXPECT_EQ(display.far, 4);
    EXPECT_EQ(display.voxels, glm::ivec3(640, 480, 256));
}

TEST(SceneDisplay, HasItsOwnMeasuresForEachShape) {
    const Display sector = display_with(R"({"shape": "sector", "angle": 360, "near": 2})");
    EXPECT_DOUBLE_EQ(sector.half_angles.x, kPi);
    EXPECT_EQ(sector.far, 7);  // the world's corner (2, 3, 6)
    const Display ball = display_with(R"({"shape": "ball", "radius": 3, "voxels": [7, 5, 3]})");
    EXPECT_EQ(ball.near, 0);
    EXPECT_EQ(ball.far, 3);
    EXPECT_EQ(ball.voxels, glm::ivec3(7, 5, 3));
    const Display box =
        display_with(R"({"shape": "box", "size": [7, 5, 3], "near": 2})", R"({"size": [9, 8]})");
    EXPECT_EQ(box.half_size, glm::dvec2(3.5, 2.5));
    EXPECT_EQ(box.near, 2);
    EXPECT_EQ(box.far, 5);
    EXPECT_EQ(box.voxels, glm::ivec3(9, 8, 256));
}

TEST(SceneWorld, CoversItsBoundsWithWholeVoxels) {
    const auto voxels = [](const std::string& size, const std::string& max) {
        return parse_room(
                   R"({"voxelume": 1, "world": {"voxel_size": )" + size +
                   R"(, "bounds": {"min": [0, 0, 0], "max": )" + max +
                   R"(}}, "observer": {"position": [0, 0, 0], "display": {"shape": "pyramid"}}})")
            .world.voxels;
    };
    EXPECT_EQ(voxels("1", "[7, 5, 2.5]"), glm::ivec3(7, 5, 3));
    EXPECT_EQ(voxels("[0.1, 0.2, 0.3]", "[0.7, 0.6, 0.9]"),
              glm::ivec3(7, 3, 3));  // none is exact in binary
    EXPECT_EQ(voxels("1", "[0.25, 1e-12, 1.0001]"), glm::ivec3(1, 1, 2));
}

TEST(SceneMaterials, NumberZeroIsTheDefaultOne) {
    const Scene scene = parse_room(
        scene_with(R"("objects": [{"model": "ball"}, {"model": "floor", "material": "glass"}],)"));
    ASSERT_EQ(scene.materials.size(), 3u);
    EXPECT_EQ(scene.materials[0].name, "default");
    EXPECT_EQ(scene.objects[0].material, 0);
    EXPECT_EQ(scene.materials[scene.objects[1].material].name, "glass");
    EXPECT_FLOAT_EQ(scene.materials[2].ior, 1.33f);
    EXPECT_EQ(scene.materials[2].color, glm::vec3(0.8f));
    EXPECT_EQ(scene.materials[1].color, glm::vec3(1, 0, 0));
}

TEST(SceneModels, HaveTheWorldsVoxelsUnlessTheySayMore) {
    const std::string models =
        R"({"a": {"shape": "sphere", "radius": 1}, "b": {"shape": "box", "size": [7, 5, 3],
        "resolution": 70, "surface": "exact"}, "c": {"shape": "cone", "radius": 1, "height": 2,
        "voxel_size": [0.1, 0.2, 0.3], "surface": "cubes", "set": "thin"}})";
    const Scene scene =
        parse_room(R"({"voxelume": 1, "world": {"voxel_size": 0.5, "bounds": {"min": [0, 0, 0],
        "max": [1, 2, 3]}}, "models": )" +
                   models + R"(, "observer": {"position": [0, 0, 0],
        "display": {"shape": "pyramid"}}})");
    EXPECT_EQ(scene.models[0].voxel_size, glm::dvec3(0.5));
    EXPECT_EQ(scene.models[0].surface, Surface::exact);
    EXPECT_EQ(scene.models[1].resolution, 70);
    EXPECT_EQ(scene.models[1].voxel_size, glm::dvec3(0));
    EXPECT_EQ(scene.models[1].solid->size, glm::dvec3(7, 5, 3));
    EXPECT_EQ(scene.models[2].voxel_size, glm::dvec3(0.1, 0.2, 0.3));
    EXPECT_EQ(scene.models[2].surface, Surface::cubes);
    EXPECT_EQ(scene.models[2].set, VoxelSet::thin);
}

TEST(SceneModels, AMeshIsShadedByItsNormalsUnlessItSaysMore) {
    const std::filesystem::path folder = std::filesystem::path(VXL_SOURCE_DIR) / "scenes";
    const auto shading_of = [&](const std::string& keys) {
        return parse_scene(R"({"voxelume": 1,
"world": {"voxel_size": 0.5, "bounds": {"min": [0, 0, 0], "max": [1, 2, 3]}},
"models": {"m": {"mesh": "README.md")" +
                               keys + R"(}},
"observer": {"position": [0, 0, -3], "display": {"shape": "pyramid"}}})",
                           folder / "s.json", {})
            .models.at(0)
            .shading;
    };
    EXPECT_EQ(shading_of(""), (Shading{ShadingKind::automatic, 30}));
    EXPECT_EQ(shading_of(R"(, "shading": "flat")"), (Shading{ShadingKind::flat, 30}));
    EXPECT_EQ(shading_of(R"(, "shading": "smooth", "crease_angle": 44.5)"),
              (Shading{ShadingKind::smooth, 44.5}));
    EXPECT_THROW(shading_of(R"(, "crease_angle": 44.5)"), Error);
    EXPECT_THROW(shading_of(R"(, "shading": "smooth", "crease_angle": 181)"), Error);
}

TEST(SceneModels, AnInfiniteSolidReachesAsFarAsTheWorldFromAllItsObjects) {
    const Scene scene =
        parse_room(scene_with(R"("objects": [{"model": "floor", "position": [0, -1, 0]},
        {"model": "floor", "turn": [0, 0, 90], "scale": 0.5}],)"));
    // The world is -1..1, -2..2, -3..3. The second object sees x = y/0.5, y = -x/0.5, z = z/0.5.
    EXPECT_TRUE(is_infinite(*scene.models[1].solid));
    EXPECT_EQ(scene.models[1].extent.min, glm::dvec3(-4, -2, -6));
    EXPECT_EQ(scene.models[1].extent.max, glm::dvec3(4, 3, 6));
    EXPECT_EQ(scene.models[0].extent.max, scene.models[0].extent.min);  // no object shows the ball
}

TEST(SceneModels, PartsOfASolidArePlacedInTheirParent) {
    const Scene scene = parse_room(
        R"({"voxelume": 1, "world": {"voxel_size": 1, "bounds": {"min": [0, 0, 0], "max": [1, 2, 3]}},
        "models": {"m": {"shape": "difference", "parts": [{"shape": "cone", "radius": 2, "height": 3, "top_radius": 1},
            {"shape": "intersection", "position": [1, 2, 3], "parts": [{"shape": "slab", "thickness": 0.5, "turn": [0, 0, 90]},
                {"shape": "torus", "radius": 4, "tube": 0.5}]}]}},
        "observer": {"position": [0, 0, 0], "display": {"shape": "pyramid"}}})");
    const Solid& root = *scene.models[0].solid;
    EXPECT_EQ(root.kind, SolidKind::difference_of);
    EXPECT_EQ(root.parts[0].kind, SolidKind::cone);
    EXPECT_EQ(root.parts[0].top_radius, 1);
    const Solid& cut = root.parts[1];
    EXPECT_EQ(cut.kind, SolidKind::intersection_of);
    EXPECT_EQ(move(cut.parent_from_solid, {0, 0, 0}), glm::dvec3(1, 2, 3));
    EXPECT_EQ(cut.parts[0].kind, SolidKind::slab);
    EXPECT_EQ(move(cut.parts[0].parent_from_solid, {0, 1, 0}), glm::dvec3(-1, 0, 0));
    EXPECT_EQ(cut.parts[1].tube, 0.5);
    EXPECT_FALSE(is_infinite(root));
    EXPECT_FALSE(is_infinite(cut));
    EXPECT_TRUE(is_infinite(cut.parts[0]));
}

TEST(SceneLights, CarryTheirIntensityDirectionAndCone) {
    const Scene scene = parse_room(scene_with(R"("lights": [
        {"type": "spot", "position": [1, 2, 3], "look_at": [1, -3, 3], "angle": 40, "inner_angle": 30,
         "color": [1, 0.5, 0.25], "intensity": 8},
        {"type": "directional", "direction": [0, 0, -1e-300], "name": "sun"},
        {"type": "point", "position": [4, 5, 6]}],)"));
    const Light& spot = scene.lights[0];
    EXPECT_EQ(spot.kind, LightKind::spot);
    EXPECT_EQ(spot.direction, glm::dvec3(0, -1, 0));
    EXPECT_EQ(spot.intensity, glm::vec3(8, 4, 2));
    EXPECT_DOUBLE_EQ(spot.outer_half_angle, kPi / 9);
    EXPECT_DOUBLE_EQ(spot.inner_half_angle, kPi / 12);
    EXPECT_EQ(scene.lights[1].kind, LightKind::directional);
    EXPECT_EQ(scene.lights[1].direction, glm::dvec3(0, 0, -1));
    EXPECT_EQ(scene.lights[1].name, "sun");
    EXPECT_EQ(scene.lights[2].position, glm::dvec3(4, 5, 6));
    EXPECT_EQ(scene.lights[2].intensity, glm::vec3(1));
}

TEST(SceneText, ADescriptionNamesEverything) {
    const std::string text =
        describe(read_scene(fs::path(VXL_SOURCE_DIR) / "scenes" / "cubes.json", {}));
    EXPECT_THAT(text, StartsWith("world: 40x40x40 voxels of 0.05 0.03 0.04 m\n"));
    for (const char* part : {"model \"arch\": difference of 3 parts, cubes", "object \"ring\"",
                             "light \"sun\"", "observer: at 0.7 1.3 2.6", "image: 160x120 pixels"})
        EXPECT_THAT(text, HasSubstr(part));
}

}  // namespace voxelume
