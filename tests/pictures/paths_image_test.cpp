// SPDX-License-Identifier: Apache-2.0
// Images of reflecting, refracting and veiling objects against an analytic tracer.
#include "runtime/scene_file/read_scene.hpp"
#include "tests/pictures/analytic_image_scenes.hpp"
#include "tests/support/analytic_comparison.hpp"

namespace voxelume {
namespace {

/// The scene with an image whose sizes aren't powers of two, so that no two strides are equal by
/// chance.
Scene scene_of(const char* text) {
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
    expect_analytic_image(without_absorption(scene_of(kNestedScene)), 1e-5, 1e-3);
}

TEST(PathsImage, VeilsAndFilteredShadows) {
    expect_analytic_image(without_absorption(scene_of(kVeiledScene)), 1e-5, 1e-3);
}

TEST(PathsImage, RaysThatBeginInsideOfAnObject) {
    expect_analytic_image(without_absorption(scene_of(kPoolScene)), 1e-5, 1e-3);
}

TEST(PathsImage, OpaqueShadowsOfTransmittingObjects) {
    Scene scene = without_absorption(scene_of(kVeiledScene));
    scene.render.filtered_shadows = false;
    expect_analytic_image(scene, 1e-5, 1e-3);
}

TEST(PathsImage, NoRecursionAndOneStepOfIt) {
    for (const int depth : {0, 1}) {
        Scene scene = without_absorption(scene_of(kNestedScene));
        scene.render.depth = depth;
        expect_analytic_image(scene, 1e-5, 1e-3);
    }
}

TEST(PathsImage, MinWeightEndsTheSamePaths) {
    Scene scene = without_absorption(scene_of(kVeiledScene));
    scene.render.min_weight = 0.1;
    expect_analytic_image(scene, 1e-5, 1e-3);
}

}  // namespace
}  // namespace voxelume
