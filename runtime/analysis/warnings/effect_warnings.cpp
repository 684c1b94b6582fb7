// SPDX-License-Identifier: Apache-2.0
#include "runtime/analysis/warnings/effect_warnings.hpp"

#include <string>
#include <utility>

#include "runtime/scene/predicates.hpp"
#include "runtime/scene/scene_animation.hpp"
#include "runtime/scene/shutter.hpp"

namespace voxelume {
namespace {

void add_scattering_warning(const Scene& scene, std::vector<Warning>& warnings) {
    const RenderSettings& render = scene.render;
    if (scene.world.medium.scattering == glm::vec3(0)) return;
    const bool is_seen = render.shows_image && render.channels.color;
    if (is_seen && !has_scattering(scene))
        add_once({WarningKind::ignored_scattering, scene.world.where,
                  "the medium's \"scattering\" is followed in global light alone, and is left out "
                  "here: set render.light to \"global\""},
                 warnings);
    else if (render.shows_volume)
        add_once({WarningKind::ignored_scattering, scene.world.where,
                  "volumetric images show no light that the medium scatters: its \"scattering\" is "
                  "left out there"},
                 warnings);
}

void add_shutter_warning(const Scene& scene, std::vector<Warning>& warnings) {
    const bool is_open = moves(scene) && scene.observer.shutter > 0 && scene.render.shows_image;
    if (!is_open || has_moments(scene)) return;
    add_once(
        {WarningKind::one_moment, scene.observer.where,
         "its shutter stays open, and images with one sample show the moment alone at which it "
         "opens: give \"render\" more \"samples\""},
        warnings);
}

void add_lens_warning(const Scene& scene, std::vector<Warning>& warnings) {
    const Observer& observer = scene.observer;
    if (observer.aperture > 0 && scene.render.samples == 1)
        add_once({WarningKind::no_effect, observer.where,
                  "images with one sample are sharp everywhere, whatever its \"aperture\": give "
                  "\"render\" more \"samples\""},
                 warnings);
    else if (observer.aperture == 0 && observer.blades > 0)
        add_once({WarningKind::no_effect, observer.where,
                  "its \"blades\" shape a lens, and there is none: give it an \"aperture\""},
                 warnings);
}

/// Adds the warning of a key of `render`.
void add_key_warning(const Scene& scene, const char* key, std::string text,
                     std::vector<Warning>& warnings) {
    add_once(
        {WarningKind::no_effect,
         SourcePlace(scene.file.string(), 0, 0, std::string("render.") + key), std::move(text)},
        warnings);
}

void add_sample_warnings(const Scene& scene, std::vector<Warning>& warnings) {
    const RenderSettings& render = scene.render;
    if (!render.filter.is_pixel() && render.samples == 1)
        add_key_warning(scene, "filter",
                        "all filters are the same for one sample a pixel, in its middle: use more "
                        "\"samples\"",
                        warnings);
    if (render.adaptive > 0 && render.light == LightMode::global)
        add_key_warning(scene, "adaptive",
                        "in global light all pixels have all samples: use --noise, which gives "
                        "each as many as it needs",
                        warnings);
    else if (render.adaptive > 0 && render.samples == 1)
        add_key_warning(scene, "adaptive", "there are no more samples than one: use more",
                        warnings);
}

void add_noise_warning(const Scene& scene, std::vector<Warning>& warnings) {
    if (!scene.render.noise.is_given() || scene.render.channels.color) return;
    add_once({WarningKind::no_effect, SourcePlace(scene.file.string()),
              "noise is measured in colours, and none are written: each pixel has 16 samples, "
              "whatever --noise and --time say"},
             warnings);
}

}  // namespace

void add_effect_warnings(const Scene& scene, std::vector<Warning>& warnings) {
    add_scattering_warning(scene, warnings);
    add_shutter_warning(scene, warnings);
    if (!scene.render.shows_image) return;
    add_lens_warning(scene, warnings);
    add_sample_warnings(scene, warnings);
    add_noise_warning(scene, warnings);
}

}  // namespace voxelume
