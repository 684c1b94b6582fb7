// SPDX-License-Identifier: Apache-2.0
// Parents, splines, morphs by weights and skins, and transfer functions of plain structs equal
// those of texts.
#include <gmock/gmock.h>

#include "tests/api/scene_pairs.hpp"
#include "tests/support/file_fixture.hpp"
#include "tests/support/writers/gltf_writer.hpp"

namespace voxelume {
namespace {

using v1::Keys;
using v1::Vec3;

class ApiMotion : public FileTest {
  protected:
    v1::SceneOptions options() const { return {.assets = {folder}}; }
};

}  // namespace

TEST_F(ApiMotion, HasParentsAndSplines) {
    v1::SceneDescription scene = empty_scene();
    scene.models = {{.name = "ball", .source = v1::Sphere{0.3}}};
    const v1::Matrix matrix = {{{1, 0.5, 0, 4}, {0, 1, 0, 0}, {0, 0, 3, 0}}};
    scene.objects = {{.name = "arm",
                      .model = "ball",
                      .position = {0, 1, 0},
                      .parents = {{.position = {1, 2, 3}, .turn = {0, 0, 90}, .scale = {1, 2, 1}},
                                  {.matrix = matrix}}}};
    scene.animation = {
        .frames = 9,
        .tracks = {{"objects.arm.position",
                    Keys<Vec3>{{1, {1, 2, 3}, {}, Vec3{1, 0, 1}}, {5, {3, 2, 1}, Vec3{0, 1, 2}}},
                    v1::Interpolation::spline},
                   {"objects.arm.parents[0].turn",
                    Keys<std::array<double, 4>>{{1, {0, 0, 0, 1}}, {5, {0, 0.6, 0, 0.8}}}}}};
    expect_same(scene, text_with(R"("models": {"ball": {"shape": "sphere", "radius": 0.3}},
    "objects": [{"name": "arm", "model": "ball", "position": [0, 1, 0], "parents": [
        {"position": [1, 2, 3], "turn": [0, 0, 90], "scale": [1, 2, 1]},
        {"matrix": [[1, 0.5, 0, 4], [0, 1, 0, 0], [0, 0, 3, 0]]}]}],
    "animation": {"frames": 9, "tracks": [
        {"target": "objects.arm.position", "interpolation": "spline",
         "keys": [{"frame": 1, "value": [1, 2, 3], "out": [1, 0, 1]},
                  {"frame": 5, "value": [3, 2, 1], "in": [0, 1, 2]}]},
        {"target": "objects.arm.parents[0].turn",
         "keys": [{"frame": 1, "value": [0, 0, 0, 1]}, {"frame": 5, "value": [0, 0.6, 0, 0.8]}]}]})"));
}

TEST_F(ApiMotion, HasMorphsByWeightsAndSkins) {
    put_bytes(folder / "m.glb", triangle_gltf().glb());
    v1::SceneDescription scene = empty_scene();
    scene.models = {
        {.name = "pulled",
         .source =
             v1::MeshFile{.file = "m.glb", .morph = v1::Morph{.weights = {0.5, -1}}, .part = 1},
         .surface = v1::Surface::exact},
        {.name = "walking",
         .source =
             v1::MeshFile{
                 .file = "m.glb",
                 .morph = v1::Morph{.weights = {0.25}, .skin = 2, .clip = "walk", .time = 0.5},
                 .part = 1},
         .surface = v1::Surface::exact}};
    scene.animation = {.frames = 9,
                       .tracks = {{"models.pulled.morph.weights",
                                   Keys<std::vector<double>>{{1, {0, 1}}, {4, {1, -1}}}},
                                  {"models.walking.morph.time", Keys<double>{{1, 0}, {9, 2}}}}};
    expect_same(scene, text_with(R"("models": {
        "pulled": {"mesh": "m.glb", "part": 1, "surface": "exact", "morph": {"weights": [0.5, -1]}},
        "walking": {"mesh": "m.glb", "part": 1, "surface": "exact",
                    "morph": {"weights": [0.25], "skin": 2, "clip": "walk", "time": 0.5}}},
    "animation": {"frames": 9, "tracks": [
        {"target": "models.pulled.morph.weights",
         "keys": [{"frame": 1, "value": [0, 1]}, {"frame": 4, "value": [1, -1]}]},
        {"target": "models.walking.morph.time",
         "keys": [{"frame": 1, "value": 0}, {"frame": 9, "value": 2}]}]})"),
                options());
}

TEST_F(ApiMotion, HasTransferFunctions) {
    put_bytes(folder / "s.nrrd",
              "NRRD0004\ntype: uint8\ndimension: 3\nsizes: 2 2 2\n"
              "encoding: raw\n\n12345678");
    v1::SceneDescription scene = empty_scene();
    v1::GridDensity density{.file = "s.nrrd"};
    density.transfer = {{.value = -1.5},
                        {.value = 2, .absorption = 3, .color = v1::Color{1, 2, 3}}};
    density.lit = Vec3{1, -2, 3};
    scene.world.medium = v1::Medium{.density = density};
    const std::string observer = R"({"position": [0.5, 1, -6], "display": {"shape": "pyramid"}})";
    const std::string grid = R"("density": {"kind": "grid", "file": "s.nrrd", "lit": [1, -2, 3],
        "transfer": [{"value": -1.5, "absorption": 0},
                     {"value": 2, "absorption": 3, "color": [1, 2, 3]}]})";
    expect_same(scene, text_with("", observer, R"(, "medium": {)" + grid + "}"), options());
    density.lit.reset();
    density.is_lit_by_scene = true;
    scene.world.medium = v1::Medium{.density = density};
    std::string by_lights = grid;
    by_lights.replace(by_lights.find("[1, -2, 3]"), 10, "true");
    expect_same(scene, text_with("", observer, R"(, "medium": {)" + by_lights + "}"), options());
    density.is_lit_by_scene = false;
    density.lit = Vec3{1, -2, 3};
    v1::GridDensity window{.file = "s.nrrd", .position = {1, 0, 2}};
    window.transfer = {{.value = 1}, {.value = 3, .absorption = 1}};
    density.others = {window};
    scene.world.medium = v1::Medium{.density = density};
    const std::string with_another = grid.substr(0, grid.size() - 1) +
                                     R"(, "others": [{"file": "s.nrrd", "position": [1, 0, 2],
        "transfer": [{"value": 1, "absorption": 0}, {"value": 3, "absorption": 1}]}]})";
    expect_same(scene, text_with("", observer, R"(, "medium": {)" + with_another + "}"), options());
    density.others.clear();
    scene.world.medium = v1::Medium{.absorption = {1, 2, 3}, .density = density};
    expect_same(scene,
                text_with("", observer, R"(, "medium": {"absorption": [1, 2, 3], )" + grid + "}"),
                options());
}

}  // namespace voxelume
