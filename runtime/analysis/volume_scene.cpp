// SPDX-License-Identifier: Apache-2.0
#include "runtime/analysis/volume_scene.hpp"

#include "runtime/analysis/scene_features.hpp"

namespace voxelume {

Scene volume_scene(Scene scene) {
    scene.observer.aperture = 0;
    scene.render.filter = {};
    scene.render.channels = {};
    if (scene.render.light == LightMode::global) scene.world.medium.scattering = glm::vec3(0);
    return scene;
}

Scene volume_scene(const Scene& scene, const Pyramid& world) {
    Scene shown = volume_scene(scene);
    if (shown.render.light == LightMode::global &&
        shown.observer.display.layout == VolumeLayout::rays &&
        features_of(shown, world).transmission)
        shown.render.light = LightMode::local;
    return shown;
}

Features volume_features(const Scene& scene, const Pyramid& world) {
    Features features = features_of(scene, world);
    features.own_light = features.global && features.transmission;
    return features;
}

}  // namespace voxelume
