// SPDX-License-Identifier: Apache-2.0
#include "runtime/analysis/volume_scene.hpp"

#include <algorithm>

#include "runtime/analysis/scene_features.hpp"
#include "runtime/scene/predicates.hpp"

namespace voxelume {
namespace {

bool asks_for_light_of_layers(const Scene& scene) {
    return scene.render.light == LightMode::global &&
           scene.observer.display.layout == VolumeLayout::rays;
}

}  // namespace

Scene volume_scene(Scene scene) {
    RenderSettings& render = scene.render;
    scene.observer.aperture = 0;
    render.filter = {};
    render.channels = {};
    if (render.light == LightMode::global) scene.world.medium.scattering = glm::vec3(0);
    return scene;
}

Scene volume_scene(const Scene& scene, const Pyramid& world) {
    Scene shown = volume_scene(scene);
    if (asks_for_light_of_layers(shown) &&
        (drops_global_light(shown) || features_of(shown, world).transmission))
        shown.render.light = LightMode::local;
    return shown;
}

bool is_sampled_by_noise(const RenderSettings& render) {
    return render.noise.is_given() && render.samples >= 2 * kFirstSamples;
}

bool drops_global_light(const Scene& scene) {
    return asks_for_light_of_layers(scene) &&
           std::ranges::any_of(scene.objects,
                               [&](const Object& object) { return transmits(scene, object); });
}

Warning local_volume_warning(const Scene& scene) {
    return {WarningKind::local_volume, SourcePlace(scene.file.string()),
            "the volumetric image is in local light, for its rays pass through objects that let "
            "light through: set the display's \"layout\" to \"lattice\", which shows global light"};
}

Features volume_features(const Scene& scene, const Pyramid& world) {
    Features features = features_of(scene, world);
    features.own_light = features.global && features.transmission;
    return features;
}

}  // namespace voxelume
