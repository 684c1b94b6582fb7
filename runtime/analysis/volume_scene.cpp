// SPDX-License-Identifier: Apache-2.0
#include "runtime/analysis/volume_scene.hpp"

#include "runtime/analysis/scene_features.hpp"

namespace voxelume {

Scene volume_scene(Scene scene) {
    RenderSettings& render = scene.render;
    scene.observer.aperture = 0;
    render.filter = {};
    render.channels = {};
    if (render.light == LightMode::global) scene.world.medium.scattering = glm::vec3(0);
    return scene;
}

bool is_sampled_by_noise(const RenderSettings& render) {
    return render.noise.is_given() && render.samples >= 2 * kFirstSamples;
}

Features volume_features(const Scene& scene, const Pyramid& world) {
    Features features = features_of(scene, world);
    features.scattered_sight = false;  // rays go through the middles of pixels
    features.own_light = features.global && features.transmission;
    return features;
}

}  // namespace voxelume
