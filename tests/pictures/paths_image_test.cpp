// SPDX-License-Identifier: Apache-2.0
// Images of reflecting, refracting and veiling objects against an analytic tracer.
#include "runtime/scene_file/read_scene.hpp"
#include "tests/pictures/analytic_image_scenes.hpp"
#include "tests/support/analytic_comparison.hpp"

namespace voxelume {
namespace {

/// The scene with an image whose sizes aren't powers of two, so that no two strides are equal by
/// chance.
Scene path_scene(const char* text) {
    Scene scene = parse_scene(text, "test.json", {});
    resize(scene, {172, 133});
    return scene;
}

Scene without_absorption(Scene scene) {
    scene.world.medium = {};
    for (Material& material : scene.materials) material.absorption = glm::vec3(0);
    return scene;
}

TEST(PathsImage, NestedDielectricsWithFresnel) {
    expect_analytic_image(without_absorption(path_scene(kNestedScene)), 1e-5, 1e-3);
}

TEST(PathsImage, VeilsAndFilteredShadows) {
    expect_analytic_image(without_absorption(path_scene(kVeiledScene)), 1e-5, 1e-3);
}

TEST(PathsImage, RaysThatBeginInsideOfAnObject) {
    expect_analytic_image(without_absorption(path_scene(kPoolScene)), 1e-5, 1e-3);
}

TEST(PathsImage, OpaqueShadowsOfTransmittingObjects) {
    Scene scene = without_absorption(path_scene(kVeiledScene));
    scene.render.filtered_shadows = false;
    expect_analytic_image(scene, 1e-5, 1e-3);
}

TEST(PathsImage, NoRecursionAndOneStepOfIt) {
    for (const int depth : {0, 1}) {
        Scene scene = without_absorption(path_scene(kNestedScene));
        scene.render.depth = depth;
        expect_analytic_image(scene, 1e-5, 1e-3);
    }
}

TEST(PathsImage, MinWeightEndsTheSamePaths) {
    Scene scene = without_absorption(path_scene(kVeiledScene));
    scene.render.min_weight = 0.1;
    expect_analytic_image(scene, 1e-5, 1e-3);
}

}  // namespace
}  // namespace voxelume
