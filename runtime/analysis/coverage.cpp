// SPDX-License-Identifier: Apache-2.0
#include "runtime/analysis/coverage.hpp"

#include "runtime/analysis/medium_set.hpp"
#include "runtime/analysis/scene_features.hpp"

namespace voxelume {

Scene unlit_scene(Scene scene) {
    scene.lights.clear();
    scene.world.medium = {};
    scene.world.sky.reset();
    scene.render.light = LightMode::local;
    scene.render.depth = 0;
    for (Material& material : scene.materials) material.emission = glm::vec3(0);
    return scene;
}

Features coverage_features(const Scene& unlit, const Pyramid& world) {
    Features features = features_of(unlit, world);
    features.paths = features.transmission = true;
    add_medium_set(unlit, world, features);
    return begun_anywhere(features, unlit);
}

}  // namespace voxelume
