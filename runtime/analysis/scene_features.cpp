// SPDX-License-Identifier: Apache-2.0
#include "runtime/analysis/scene_features.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <vector>

#include "runtime/analysis/medium_set.hpp"
#include "runtime/analysis/object_boxes.hpp"
#include "runtime/analysis/scene_lights.hpp"
#include "runtime/scene/first_samples.hpp"
#include "runtime/scene/predicates.hpp"
#include "runtime/stages/light/emitters.hpp"
#include "runtime/stages/light/light.hpp"
#include "runtime/stages/light/light_samples.hpp"
#include "runtime/stages/light/sky_light.hpp"
#include "runtime/stages/trace/sight.hpp"

namespace voxelume {
namespace {

/// The objects that the world may show. All instances are among them, because they enter and leave
/// the world without a new build of it.
std::vector<const Object*> shown_objects(const Scene& scene, const Pyramid& world) {
    std::vector<const Object*> shown;
    for (size_t i = 0; i < scene.objects.size(); ++i) {
        const Object& object = scene.objects[i];
        if (!object.visible || !object.potentially_visible) continue;
        const bool is_known = !world.object_boxes.empty() && !is_instanced(scene, object);
        if (is_known && is_empty(world.object_boxes[i])) continue;
        shown.push_back(&object);
    }
    return shown;
}

/// The materials of objects that the world may show.
std::vector<const Material*> shown_materials(const Scene& scene, const Pyramid& world) {
    std::set<int> numbers;
    for (const Object* object : shown_objects(scene, world)) {
        numbers.insert(object->material);
        for (const GroupMaterial& group : object->groups) numbers.insert(group.material);
    }
    std::vector<const Material*> materials;
    materials.reserve(numbers.size());
    for (const int number : numbers) materials.push_back(&scene.materials[size_t(number)]);
    return materials;
}

/// True if the material sends back light that falls on it.
bool is_lit(const Material* m) {
    if (is_physical(*m)) return true;  // nothing is so black that it has no highlight
    const bool has_color =
        m->color != glm::vec3(0) || (m->checker && m->checker->color != glm::vec3(0));
    return m->specular.value_or(0) > 0 || (m->diffuse > 0 && has_color);
}

/// True if maps may make a part of the material's surface one that local light mirrors.
bool mirrors_by_map(const Material& material, const Features& features) {
    return features.texture_maps && !features.global && maps_make_mirrors(material);
}

/// Adds the features that the materials decide.
void add_paths(const Scene& scene, const Pyramid& world, Features& features) {
    const bool follows = (features.global ? scene.render.bounces : scene.render.depth) > 0;
    bool opacity = features.voxel_opacity || features.texture_alpha;
    bool refraction = false, reflection = false, fresnel = false;
    bool absorption = false;
    for (const Material* m : shown_materials(scene, world)) {
        features.checker |= m->checker.has_value();
        const uint32_t effects = effects_of(*m);
        refraction |= (effects & kRefracts) != 0;
        opacity |= (effects & kIsSeenThrough) != 0;
        reflection |= (effects & kReflects) != 0 || mirrors_by_map(*m, features);
        features.tinted |= !features.global && is_physical(*m) && m->metallic.value_or(0) > 0;
        features.physical |= features.global && (effects & kIsPhysical) != 0;
        features.coat |= features.global && (effects & kHasCoat) != 0;
        features.weak_facets |= features.global && is_weak(*m);
        features.rough_glass |= features.global && glass_share(*m) > 0;
        fresnel |= (effects & kHasReflectance) != 0 && (effects & (kReflects | kRefracts)) != 0;
        absorption |= (effects & kAbsorbs) != 0 && (transmits(*m) || features.voxel_opacity);
    }
    features.transmission =
        opacity || (refraction && (follows || (features.shadows && scene.render.filtered_shadows)));
    const bool filters = features.shadows && features.transmission;
    features.refracts = follows && (refraction || fresnel);
    features.paths = features.global || features.transmission || (follows && reflection);
    features.absorbs = features.medium || (features.transmission && absorption);
    features.filter = filters;
    features.filtered_refraction = filters && scene.render.filtered_shadows;
    features.cube_bodies =
        features.transmission &&
        std::ranges::any_of(shown_objects(scene, world), [&](const Object* object) {
            return shows_voxels(scene.models[size_t(object->model)].surface) &&
                   (features.voxel_opacity || transmits(scene, *object));
        });
}

/// True if emissive objects shine from samples of their surfaces. In global light paths find them.
bool has_emissive_samples(const Scene& scene, const Pyramid& world) {
    return scene.render.light == LightMode::local && has_emissive_object(scene, world);
}

/// True if paths are scattered between the objects.
bool scatters_paths(const Scene& scene, const Pyramid& world) {
    return has_scattering(scene) && !world.clear;
}

/// True if paths may come from mirrors or through glass to lights with an area.
bool mirrors_lights(const Scene& scene, const Pyramid& world) {
    return may_meet_lights(scene) &&
           std::ranges::any_of(shown_materials(scene, world), [](const Material* m) {
               return (effects_of(*m) & (is_physical(*m) ? kRefracts : kReflects | kRefracts)) != 0;
           });
}

/// True if a light or an emissive object shines on something that isn't black, or that mirrors it.
bool lights_surfaces(const Scene& scene, const Pyramid& world) {
    return (scatters_paths(scene, world) || mirrors_lights(scene, world) ||
            std::ranges::any_of(shown_materials(scene, world), is_lit)) &&
           (std::ranges::any_of(scene.lights, shines) || has_sun(scene.world) ||
            has_sky_samples(scene) || has_emissive_samples(scene, world));
}

/// True if some mesh may be smooth in one part and exact in another.
bool shows_mixed_mesh(const Scene& scene, const Pyramid& world) {
    return std::ranges::any_of(shown_objects(scene, world), [&](const Object* object) {
        return thin_part_of(scene.models[size_t(object->model)]).has_value();
    });
}

/// Adds the features of paths that run into lights with an area. In a medium that scatters them,
/// physically based surfaces leave lights to rays.
void add_met_lights(const Scene& scene, const Pyramid& world, Features& features) {
    // Voxels and textures may let filtered shadows through where materials don't.
    if (!features.shadows || features.filtered_refraction || !may_meet_lights(scene)) return;
    features.area_shares = features.physical && !features.scattering &&
                           emitter_feature(scene.render) != VXL_EMITTERS_RAYS;
    features.meets_lights = features.area_shares || mirrors_lights(scene, world);
}

/// Adds the features of a sky.
void add_sky(const Sky& sky, const Scene& scene, const Pyramid& world, Features& features) {
    features.sky = sky_feature(sky);
    features.sky_hidden = !sky.visible;
    const bool is_sought =
        sky.strength > 0 && (features.scattering || !shown_objects(scene, world).empty());
    if (sky.kind == SkyKind::map && is_sought) features.sky_rays = emitter_feature(scene.render);
}

void add_chosen_lights(const Scene& scene, const Pyramid& world, Features& features) {
    const auto lists = chosen_lights_of(scene, world.frame);
    features.chosen_lights = !lists.empty();
    features.chosen_areas = !lists.empty() && lists.back().front().area.has_value();
    features.asked_areas = asks_areas(scene, world.frame, features.chosen_areas);
}

/// Adds the features that depend on light, and on where rays continue.
void add_light(const Scene& scene, const Pyramid& world, Features& features) {
    const bool lit = lights_surfaces(scene, world);
    features.shadows = scene.render.shadows && lit && world.voxel_count > 0;
    features.global = scene.render.light == LightMode::global;
    if (lit) add_chosen_lights(scene, world, features);
    features.area_samples =
        lit && (has_emissive_samples(scene, world) || (features.global && has_sun(scene.world)) ||
                has_area_light(scene));
    if (has_emissive_object(scene, world)) features.emitters = emitter_feature(scene.render);
    features.scattering = scatters_paths(scene, world);
    features.near_light = features.scattering && has_placed_light(scene);
    features.medium =
        features.scattering || (scene.world.medium.absorption != glm::vec3(0) && !world.clear);
    features.medium_grid = features.medium && has_density(scene.world.medium);
    features.medium_colors = features.medium && has_medium_colors(scene.world.medium);
    add_paths(scene, world, features);
    add_met_lights(scene, world, features);
    features.direct_alone = features.global && scene.render.direct_alone;
    const bool sends_on = features.shadows || features.paths;
    features.mixed = sends_on && features.triangles && shows_mixed_mesh(scene, world);
    const auto sky = outside_of(scene).sky;
    if (sky && (sky->visible || features.paths || has_sky_samples(scene)))
        add_sky(*sky, scene, world, features);
    add_medium_set(scene, world, features);
}

/// Returns `voxels`, the features of the world's voxels, without those of light. It keeps the
/// features that decide what observers' rays meet first: rays that begin inside a transmitting
/// object need them.
Features without_light(Features voxels, const Scene& scene, const Pyramid& world,
                       const Features& all) {
    if (all.transmission && may_begin_inside(scene, world)) {
        voxels.paths = voxels.transmission = true;
        voxels.observer_in_medium = all.observer_in_medium;
        voxels.media = all.media;
        voxels.medium_set_capped = all.medium_set_capped;
    }
    voxels.radiance = voxels.colors = voxels.voxel_opacity = false;
    voxels.leave_out_textures();
    return voxels;
}

/// True if the image shows light, or how noisy it is, or a matte whose surfaces cover a part of
/// what lies behind them.
bool needs_radiance(const RenderSettings& render, const Features& features) {
    const ImageChannels& channels = render.channels;
    const bool mattes = channels.object_matte || channels.material_matte;
    const bool has_noise = render.noise.is_given() && (channels.samples || channels.noise);
    return channels.color || channels.variance || has_noise || (mattes && features.transmission);
}

/// Adds the values of hit points that the image asks for, or that are a step to values it asks for.
void add_points(const Scene& scene, const Pyramid& world, Features& features) {
    const ImageChannels& channels = scene.render.channels;
    const bool all = features.radiance && (features.paths || has_light(features, scene, world));
    features.positions = all || channels.depth || channels.distance || channels.position;
    features.normals = all || channels.normal;
    features.hit_attributes = all || channels.object || channels.material ||
                              channels.object_matte || channels.material_matte;
}

/// An upper bound of the depth for which arrays are reserved: a ray ends at too small a weight.
size_t reserved_depth(const Features& features, const Scene& scene, const Pyramid& world) {
    constexpr double kWeightRounding = 1e-3;  // relative error of the weights
    const auto depth = double(max_depth(features, scene, world));
    double share = 0;  // maximum share of a surface's light that one ray contributes
    for (const Material* m : shown_materials(scene, world)) {
        const Material shown = whitted_material(*m);
        share = std::max(share, double(shown.reflection) + double(shown.refraction));
        if (mirrors_by_map(*m, features)) share = std::max(share, *m->metallic);
    }
    if (depth == 0 || share >= 1) return size_t(depth);
    const double followed = std::log(scene.render.min_weight) / std::log(share);
    return size_t(std::min(depth, std::floor(followed + kWeightRounding) + 1));
}

}  // namespace

bool has_sky_samples(const Scene& scene) {
    return scene.render.light == LightMode::local && scene.world.sky &&
           scene.world.sky->samples > 0;
}

bool has_emissive_object(const Scene& scene, const Pyramid& world) {
    return std::ranges::any_of(shown_objects(scene, world),
                               [&](const Object* object) { return is_emissive(scene, *object); });
}

bool has_light(const Features& features, const Scene& scene, const Pyramid& world) {
    return features.radiance && lights_surfaces(scene, world);
}

size_t max_depth(const Features& features, const Scene& scene, const Pyramid& world) {
    const bool scatters =
        features.refracts ||
        std::ranges::any_of(shown_materials(scene, world), [&](const Material* m) {
            return (effects_of(*m) & kReflects) != 0 || mirrors_by_map(*m, features);
        });
    const bool follows = features.radiance && !features.global && scatters;
    return follows ? size_t(scene.render.depth) : 0;
}

Features features_of(const Scene& scene, const Pyramid& world) {
    Features features = features_of(world);
    add_scene(scene, world, features);
    return features;
}

void add_scene(const Scene& scene, const Pyramid& world, Features& features) {
    const Features voxels = features;
    add_light(scene, world, features);
    if (!needs_radiance(scene.render, features))
        features = without_light(voxels, scene, world, features);
    features.scattered_sight = has_scattered_samples(scene.render) &&
                               scene.render.first_sample + all_samples(scene.render) > 1;
    features.lens = scene.observer.aperture > 0 &&
                    shape_row(scene.observer.display).projection == SightProjection::perspective;
    features.blades = features.lens && scene.observer.blades > 0;
    add_points(scene, world, features);
}

RayCounts ray_counts(const Device& device, const Scene& scene, const Features& features) {
    if (is_adaptive(scene.render)) {
        Scene more = scene;
        more.render.adaptive = 0;
        more.render.samples -= kComparedSamples;
        RayCounts counts = ray_counts(device, more, features);
        counts.rays =
            std::max(counts.rays, ray_counts(device, first_samples_of(scene), features).rays);
        return counts;
    }
    const Pyramid any;  // an empty pyramid may show all objects
    const RenderSettings& render = scene.render;
    const uint32_t tiles =
        batch_tiles(device, features, render.samples, tile_count(render.size.x, render.size.y));
    return {tiles * 16 * uint32_t(render.samples), has_light(features, scene, any),
            reserved_depth(features, scene, any)};
}

}  // namespace voxelume
