// SPDX-License-Identifier: Apache-2.0
// Scenes built from plain structs equal those that files describe.
#include <gmock/gmock.h>

#include "tests/api/scene_pairs.hpp"

namespace voxelume {
namespace {

using v1::Keys;
using v1::Vec3;

}  // namespace

TEST(ApiScene, HasTheFormatsDefaults) {
    expect_same(empty_scene(), text_with(""));
}

TEST(ApiScene, HasEverySolid) {
    v1::SceneDescription scene = empty_scene();
    scene.models = {
        {.name = "sphere", .source = v1::Sphere{0.3}, .voxel_size = Vec3{0.1, 0.2, 0.3}},
        {.name = "ellipsoid", .source = v1::Ellipsoid{{0.3, 0.2, 0.1}}, .resolution = 33},
        {.name = "box", .source = v1::Box{{1, 2, 3}}, .surface = v1::Surface::exact},
        {.name = "cylinder",
         .source = v1::Cylinder{0.2, 0.7},
         .surface = v1::Surface::cubes,
         .set = v1::VoxelSet::thin},
        {.name = "cone", .source = v1::Cone{0.4, 0.9, 0.1}},
        {.name = "torus", .source = v1::Torus{0.5, 0.125}},
        {.name = "capsule", .source = v1::Capsule{0.1, 0.6}},
        {.name = "slab", .source = v1::Slab{0.25}},
        {.name = "cup",
         .source = v1::Combination{
             v1::Operation::difference,
             {{v1::Combination{v1::Operation::intersection,
                               {{v1::Sphere{1}}, {v1::Box{{1, 1, 2}}}}}},
              {.solid = v1::Sphere{0.5}, .position = {0, 0.5, 0}, .turn = {10, 20, 30}}}}}};
    expect_same(scene, text_with(R"("models": {
        "sphere": {"shape": "sphere", "radius": 0.3, "voxel_size": [0.1, 0.2, 0.3]},
        "ellipsoid": {"shape": "ellipsoid", "radii": [0.3, 0.2, 0.1], "resolution": 33},
        "box": {"shape": "box", "size": [1, 2, 3], "surface": "exact"},
        "cylinder": {"shape": "cylinder", "radius": 0.2, "height": 0.7, "surface": "cubes",
                     "set": "thin"},
        "cone": {"shape": "cone", "radius": 0.4, "height": 0.9, "top_radius": 0.1},
        "torus": {"shape": "torus", "radius": 0.5, "tube": 0.125},
        "capsule": {"shape": "capsule", "radius": 0.1, "height": 0.6},
        "slab": {"shape": "slab", "thickness": 0.25},
        "cup": {"shape": "difference", "parts": [
            {"shape": "intersection", "parts": [{"shape": "sphere", "radius": 1},
                                                {"shape": "box", "size": [1, 1, 2]}]},
            {"shape": "sphere", "radius": 0.5, "position": [0, 0.5, 0], "turn": [10, 20, 30]}]}})"));
}

TEST(ApiScene, HasObjectsWithTheirMaterials) {
    v1::SceneDescription scene = empty_scene();
    scene.materials = {{.name = "glass",
                        .color = {0.1, 0.2, 0.3},
                        .diffuse = 0.25,
                        .specular = 0.5,
                        .shininess = 20,
                        .reflection = 0.3,
                        .refraction = 0.6,
                        .ior = 1.25,
                        .fresnel = true,
                        .absorption = {1, 2, 3}},
                       {.name = "lamp",
                        .opacity = 0.75,
                        .emission = {4, 5, 6},
                        .checker = v1::Checker{{0, 1, 0}, {0.5, 0, 1}, {0.1, 0.2, 0.3}}}};
    scene.models = {{.name = "ball", .source = v1::Sphere{0.3}}};
    const v1::Matrix matrix = {{{1, 2, 0, 0.5}, {0, 1, 0, 0.25}, {0, 0, -1, 0.75}}};
    scene.objects = {{.name = "a",
                      .model = "ball",
                      .material = "lamp",
                      .position = {1, 2, 3},
                      .turn = {30, 20, 10},
                      .scale = {1, -2, 1},
                      .priority = -3,
                      .light_samples = 12},
                     {.model = "ball",
                      .material = "glass",
                      .matrix = matrix,
                      .visible = false,
                      .placement = v1::Placement::world}};
    expect_same(scene, text_with(R"("materials": {
        "glass": {"color": [0.1, 0.2, 0.3], "diffuse": 0.25, "specular": 0.5, "shininess": 20,
                  "reflection": 0.3, "refraction": 0.6, "ior": 1.25, "fresnel": true,
                  "absorption": [1, 2, 3]},
        "lamp": {"opacity": 0.75, "emission": [4, 5, 6],
                 "checker": {"color": [0, 1, 0], "size": [0.5, 0, 1], "origin": [0.1, 0.2, 0.3]}}},
    "models": {"ball": {"shape": "sphere", "radius": 0.3}},
    "objects": [{"name": "a", "model": "ball", "material": "lamp", "position": [1, 2, 3],
                 "turn": [30, 20, 10], "scale": [1, -2, 1], "priority": -3, "spots": 12},
                {"model": "ball", "material": "glass", "visible": false, "placement": "world",
                 "matrix": [[1, 2, 0, 0.5], [0, 1, 0, 0.25], [0, 0, -1, 0.75]]}])"));
}

TEST(ApiScene, HasEveryLight) {
    v1::SceneDescription scene = empty_scene();
    scene.lights = {
        {.name = "p", .source = v1::PointLight{{1, 2, 3}}, .color = {1, 0.5, 0.25}, .intensity = 7},
        {.source = v1::SpotLight{{1, 2, 3}, {}, Vec3{0, 1, 0}, 50, 30}},
        {.source = v1::DirectionalLight{{1, -2, 1}}},
        {.source = v1::DiskLight{{1, 2, 3}, Vec3{0, -1, 0}, {}, 0.5, 16}},
        {.source = v1::RectangleLight{{1, 2, 3}, {}, Vec3{0, 0, 1}, {0.5, 0.25}, Vec3{1, 1, 0}}}};
    expect_same(scene, text_with(R"("lights": [
        {"name": "p", "type": "point", "position": [1, 2, 3], "color": [1, 0.5, 0.25],
         "intensity": 7},
        {"type": "spot", "position": [1, 2, 3], "look_at": [0, 1, 0], "angle": 50,
         "inner_angle": 30},
        {"type": "directional", "direction": [1, -2, 1]},
        {"type": "disk", "position": [1, 2, 3], "direction": [0, -1, 0], "radius": 0.5,
         "spots": 16},
        {"type": "rectangle", "position": [1, 2, 3], "look_at": [0, 0, 1], "size": [0.5, 0.25],
         "up": [1, 1, 0]}])"));
}

TEST(ApiScene, HasEveryDisplay) {
    const auto observed = [](const v1::Display& display, const char* text) {
        v1::SceneDescription scene = empty_scene();
        scene.observer->display = display;
        expect_same(scene, text_with("", R"({"position": [0.5, 1, -6], "display": )" +
                                             std::string(text) + "}"));
    };
    observed({.shape = v1::PyramidDisplay{.angles = std::array{50.0, 40.0}, .near = 1, .far = 9}},
             R"({"shape": "pyramid", "angles": [50, 40], "near": 1, "far": 9})");
    observed({.shape = v1::SectorDisplay{.angle = 200}, .voxels = std::array{5, 6, 7}},
             R"({"shape": "sector", "angle": 200, "voxels": [5, 6, 7]})");
    observed({.shape = v1::BallDisplay{3},
              .layout = v1::VolumeLayout::lattice,
              .visibility = v1::Visibility::outside},
             R"({"shape": "ball", "radius": 3, "layout": "lattice", "visibility": "outside"})");
    observed({.shape = v1::BoxDisplay{{1, 2, 3}, 0.5},
              .layout = v1::VolumeLayout::lattice,
              .cylinder = true},
             R"({"shape": "box", "size": [1, 2, 3], "near": 0.5, "layout": "lattice",
                 "clip": "cylinder"})");
}

TEST(ApiScene, HasProjections) {
    const auto text = [](const std::string& keys) {
        return text_with("", R"({"position": [0.5, 1, -6], )" + keys + "}");
    };
    v1::SceneDescription scene = empty_scene();
    scene.observer->projection = v1::Projection::orthographic;
    scene.observer->height = 2.5;
    expect_same(scene, text(R"("projection": "orthographic", "height": 2.5)"));
    scene.observer->height.reset();
    scene.observer->width = 3;
    expect_same(scene, text(R"("projection": "orthographic", "width": 3)"));
    scene.observer->width.reset();
    scene.observer->projection = v1::Projection::panoramic;
    expect_same(scene, text(R"("projection": "panoramic")"));
}

TEST(ApiScene, HasMediaAndRenderSettings) {
    v1::SceneDescription scene = empty_scene();
    scene.world.background = {1, 2, 3};
    scene.world.ambient = {0.1, 0.2, 0.3};
    scene.world.medium = v1::Medium{{1, 2, 3}, {4, 5, 6}, v1::BallDensity{{1, 0, 1}, 2, 0.5}};
    scene.render = {{320, 200}, 4, 0.25, 3, false, true, 0.125};
    scene.render.filter = v1::ReconstructionFilter::blackman_harris;
    scene.render.filter_width = 1.5;
    scene.render.transparent = true;
    const std::string settings =
        R"("render": {"size": [320, 200], "samples": 4, "adaptive": 0.25, "depth": 3,
        "shadows": false, "shadow": "filtered", "least_weight": 0.125, "filter": "blackman-harris",
        "filter_width": 1.5, "transparent": true})";
    const auto world = [](const char* density) {
        return R"(, "background": [1, 2, 3], "ambient": [0.1, 0.2, 0.3],
                  "medium": {"absorption": [1, 2, 3], "color": [4, 5, 6])" +
               std::string(density) + "}";
    };
    const char* observer = R"({"position": [0.5, 1, -6], "display": {"shape": "pyramid"}})";
    expect_same(scene, text_with(settings, observer, world(R"(, "density": {"kind": "ball",
        "center": [1, 0, 1], "radius": 2, "falloff": 0.5})")));
    scene.world.medium->scattering = {3, 2, 1};
    scene.world.medium->anisotropy = -0.25;
    scene.world.medium->density = v1::HeightDensity{0.25, 2};
    expect_same(scene, text_with(settings, observer, world(R"(, "density": {"kind": "height",
        "base": 0.25, "scale_height": 2}, "scattering": [3, 2, 1], "anisotropy": -0.25)")));
    scene.world.medium = v1::Medium{{1, 2, 3}, {4, 5, 6}};
    expect_same(scene, text_with(settings, observer, world("")));
}

TEST(ApiScene, HasTracksOfEveryType) {
    v1::SceneDescription scene = empty_scene();
    scene.materials = {{.name = "red"}, {.name = "blue", .color = {0, 0, 1}}};
    scene.models = {{.name = "ball", .source = v1::Sphere{0.3}}};
    scene.objects = {{.name = "o", .model = "ball"}};
    scene.lights = {{.source = v1::PointLight{{1, 2, 3}}}};
    scene.observer->display.shape = v1::PyramidDisplay{.angles = std::array{50.0, 40.0}};
    using v1::Interpolation;
    scene.animation = {
        .frames = 9,
        .frames_per_second = 12,
        .tracks = {
            {"objects.o.turn", Keys<Vec3>{{1, {}}, {4, {90, 0, 0}}}, Interpolation::slerp},
            {"lights[0].intensity", Keys<double>{{1, 0}, {3.5, 2}, {9, 1}}, Interpolation::cubic},
            {"objects.o.material", Keys<std::string>{{1, "red"}, {2, "blue"}}, {}},
            {"objects.o.visible", Keys<bool>{{1, true}, {5, false}}, {}},
            {"observer.display.angles",
             Keys<std::array<double, 2>>{{1, {50, 40}}, {3, {30, 20}}},
             {}}}};
    expect_same(scene, text_with(R"("materials": {"red": {}, "blue": {"color": [0, 0, 1]}},
    "models": {"ball": {"shape": "sphere", "radius": 0.3}},
    "objects": [{"name": "o", "model": "ball"}],
    "lights": [{"type": "point", "position": [1, 2, 3]}],
    "animation": {"frames": 9, "fps": 12, "tracks": [
        {"target": "objects.o.turn", "interpolation": "slerp",
         "keys": [{"frame": 1, "value": [0, 0, 0]}, {"frame": 4, "value": [90, 0, 0]}]},
        {"target": "lights[0].intensity", "interpolation": "cubic",
         "keys": [{"frame": 1, "value": 0}, {"frame": 3.5, "value": 2}, {"frame": 9, "value": 1}]},
        {"target": "objects.o.material",
         "keys": [{"frame": 1, "value": "red"}, {"frame": 2, "value": "blue"}]},
        {"target": "objects.o.visible",
         "keys": [{"frame": 1, "value": true}, {"frame": 5, "value": false}]},
        {"target": "observer.display.angles",
         "keys": [{"frame": 1, "value": [50, 40]}, {"frame": 3, "value": [30, 20]}]}]})",
                                 R"({"position": [0.5, 1, -6],
                                     "display": {"shape": "pyramid", "angles": [50, 40]}})"));
}

TEST(ApiScene, HasEverySkyAndGlobalLight) {
    const auto lit = [](const v1::Sky& sky, const char* text) {
        v1::SceneDescription scene = empty_scene();
        scene.world.sky = sky;
        scene.render.light = v1::LightMode::global;
        scene.render.bounces = 3;
        expect_same(scene,
                    text_with(R"("render": {"light": "global", "bounces": 3})",
                              R"({"position": [0.5, 1, -6], "display": {"shape": "pyramid"}})",
                              R"(, "sky": )" + std::string(text)));
    };
    lit({v1::ConstantSky{{1, 2, 3}}, 2, 5},
        R"({"kind": "constant", "color": [1, 2, 3], "strength": 2, "samples": 5})");
    lit({v1::GradientSky{{1, 2, 3}, {4, 5, 6}, {7, 8, 9}}},
        R"({"kind": "gradient", "zenith": [1, 2, 3], "horizon": [4, 5, 6], "ground": [7, 8, 9]})");
    lit({v1::SunSky{{1, -2, 3}, 2, {1, 0.5, 0.25}, 3, 4, {5, 6, 7}}},
        R"({"kind": "sun", "direction": [1, -2, 3], "angle": 2, "color": [1, 0.5, 0.25],
            "intensity": 3, "turbidity": 4, "ground": [5, 6, 7]})");
}

}  // namespace voxelume
