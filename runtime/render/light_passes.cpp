// SPDX-License-Identifier: Apache-2.0
#include "runtime/render/light_passes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <utility>

#include "runtime/scene/parts/material.hpp"
#include "runtime/scene/predicates.hpp"

namespace voxelume {
namespace {

constexpr const char* kColorNames[] = {"R", "G", "B"};
// Internal passes, which no file has and from which others are computed.
constexpr const char* kWhole = "all light";
constexpr const char* kWithShadows = "with shadows";
constexpr const char* kWithoutShadows = "without shadows";

std::string plane_name(std::string_view pass, const char* color) {
    return fmt::format("{}.{}", pass, color);
}

/// The scene with its colours alone.
Scene colors_of(const Scene& scene) {
    Scene result = scene;
    result.render.channels = {true, false, false, false, false};
    return result;
}

/// Darkens a scan unless the scene's lights light it.
void darken(GridDensity& scan) {
    if (scan.is_lit_by_scene) return;
    for (TransferPoint& point : scan.transfer) point.color = glm::vec3(0);
}

/// Removes all light except that of lights.
void darken_all_but_lights(Scene& scene) {
    if (auto* scan = std::get_if<GridDensity>(&scene.world.medium.density)) {
        darken(*scan);
        for (GridDensity& other : scan->others) darken(other);
    }
    scene.world.background = scene.world.ambient = scene.world.medium.color = glm::vec3(0);
    if (scene.world.sky) scene.world.sky->strength = scene.world.sky->intensity = 0;
    if (scene.world.sky) scene.world.sky->samples = 0;
    for (Material& material : scene.materials) material.emission = glm::vec3(0);
}

/// The scene with only the lights of one group; for the empty name, with all light that belongs to
/// no group.
Scene group_alone(const Scene& scene, const std::string& group) {
    Scene result = colors_of(scene);
    for (Light& light : result.lights)
        if (light.group != group) light.is_dark = true;
    if (!group.empty()) darken_all_but_lights(result);
    return result;
}

/// Makes all surfaces matt with their own colours and nothing else.
void make_matt(Scene& scene) {
    for (Material& m : scene.materials) {
        m.color = color_of(m);
        drop_physical(m);
        m.specular.reset();
        m.diffuse = 1;
        m.reflection = m.refraction = 0;
        m.fresnel = false;
    }
    scene.world.medium = {};
    scene.render.scatters_samples = has_scattered_samples(scene.render);
    scene.render.light = LightMode::local;
    scene.render.depth = 0;
}

/// Lets an image begin with its first sample, even if others continue an earlier image.
void restart(RenderSettings& render) {
    render.earlier = {};
    render.samples += std::exchange(render.first_sample, 0);
}

/// The scene in which each surface shows its own colour: its light in even white illumination.
Scene albedo_of(const Scene& scene) {
    Scene result = colors_of(scene);
    darken_all_but_lights(result);
    make_matt(result);
    result.lights.clear();
    result.world.ambient = glm::vec3(1);
    return result;
}

/// White surfaces in the scene's lights. The colours of voxels stay, and the pass leaves them out.
Scene white_surfaces(const Scene& scene, bool with_shadows) {
    Scene result = colors_of(scene);
    darken_all_but_lights(result);
    make_matt(result);
    for (Material& material : result.materials) {
        material.color = glm::vec3(1);
        material.checker.reset();
    }
    result.render.shadows = with_shadows;
    return result;
}

/// True if paths of global light may run into something that shines.
bool paths_find_light(const Scene& scene) {
    const World& world = scene.world;
    const bool shines = world.sky || world.background != glm::vec3(0) ||
                        world.medium.color != glm::vec3(0) ||
                        std::holds_alternative<GridDensity>(world.medium.density);
    return shines ||
           std::ranges::any_of(scene.objects,
                               [&](const Object& object) { return has_emission(scene, object); }) ||
           (may_meet_lights(scene) && std::ranges::any_of(scene.materials, shows_lights));
}

/// The light that comes to the first surface straight from its source. If paths may run into light,
/// they are followed up to there like those of all light, so that the two images differ by the rest
/// of the light alone; but not if the medium scatters light. (A veil lets the last of these paths
/// pass without chance, so behind it the two images differ by noise, too.)
Scene direct_light_of(const Scene& scene) {
    Scene result = colors_of(scene);
    const bool follows = !has_scattering(scene) && paths_find_light(scene);
    result.render.direct_alone = follows;
    result.render.bounces = std::min(scene.render.bounces, int(follows));
    result.render.depth = 0;
    return result;
}

/// The part of an earlier image that shows a pass, as an image which the pass continues; null if
/// the image's channels don't have the pass.
std::shared_ptr<const Image> shown_of(const Image& image, std::string_view pass) {
    auto shown = std::make_shared<Image>();
    shown->width = image.width;
    shown->height = image.height;
    for (const char* color : kColorNames) {
        const auto plane = image.planes.find(plane_name(pass, color));
        if (plane == image.planes.end()) return nullptr;
        shown->planes[color] = plane->second;
    }
    shown->planes["A"] = std::vector<float>(shown->planes["R"].size());  // no pass shows it
    for (const char* of_tiles : {"samples", "noise"})
        if (const auto plane = image.planes.find(of_tiles); plane != image.planes.end())
            shown->planes[of_tiles] = plane->second;
    return shown;
}

/// Lets a pass continue the samples of the scene's earlier image. If that image shows the pass only
/// as a part of others, the pass starts with its first sample.
void go_on(LightPass& pass) {
    RenderSettings& render = pass.scene.render;
    if (!render.earlier) return;
    render.earlier = shown_of(*render.earlier, pass.name);
    if (!render.earlier && !render.noise.is_given()) restart(render);
}

/// The pass of mattes, with all samples.
LightPass mattes_of(const Scene& scene) {
    LightPass pass{"", scene};
    ImageChannels& channels = pass.scene.render.channels;
    channels = {false, false, false, false, false};
    channels.object_matte = scene.render.channels.object_matte;
    channels.material_matte = scene.render.channels.material_matte;
    restart(pass.scene.render);
    return pass;
}

/// True if mattes are a pass.
bool ranks_mattes_again(const RenderSettings& render) {
    const ImageChannels& channels = render.channels;
    return (channels.object_matte || channels.material_matte) && render.earlier &&
           !render.noise.is_given();
}

/// The names of the groups of lights, and the empty one for the rest.
std::set<std::string> groups_of(const Scene& scene) {
    std::set<std::string> groups{""};
    for (const Light& light : scene.lights) groups.insert(light.group);
    return groups;
}

}  // namespace

std::vector<LightPass> light_passes(const Scene& scene) {
    const ImageChannels& channels = scene.render.channels;
    std::vector<LightPass> passes;
    if (channels.albedo) passes.push_back({"albedo", albedo_of(scene)});
    if (channels.direct || channels.indirect) passes.push_back({"direct", direct_light_of(scene)});
    if (channels.indirect && !channels.color) passes.push_back({kWhole, colors_of(scene)});
    if (channels.shadow) {
        passes.push_back({kWithShadows, white_surfaces(scene, true), true});
        passes.push_back({kWithoutShadows, white_surfaces(scene, false), true});
    }
    if (channels.light_groups)
        for (const std::string& group : groups_of(scene))
            passes.push_back(
                {group.empty() ? "light_rest" : "light_" + group, group_alone(scene, group)});
    for (LightPass& pass : passes) go_on(pass);
    if (ranks_mattes_again(scene.render)) passes.push_back(mattes_of(scene));
    return passes;
}

void leave_mattes_to_passes(RenderSettings& render) {
    if (ranks_mattes_again(render))
        render.channels.object_matte = render.channels.material_matte = false;
}

void finish_passes(const Scene& scene, Image& image) {
    const ImageChannels& channels = scene.render.channels;
    for (const char* color : kColorNames) {
        const auto plane = [&](std::string_view pass) -> Plane<float>& {
            return image.planes.at(plane_name(pass, color));
        };
        if (channels.indirect) {
            Plane<float> rest = channels.color ? image.planes.at(color) : plane(kWhole);
            const Plane<float>& direct = plane("direct");
            for (size_t i = 0; i < rest.size(); ++i) rest[i] -= direct[i];
            image.planes[plane_name("indirect", color)] = std::move(rest);
        }
        if (channels.shadow) {
            Plane<float> shadow = plane(kWithShadows);
            const Plane<float>& all = plane(kWithoutShadows);
            for (size_t i = 0; i < shadow.size(); ++i)
                shadow[i] = all[i] > 0 ? std::max(1 - shadow[i] / all[i], 0.0f) : 0.0f;
            image.planes[plane_name("shadow", color)] = std::move(shadow);
        }
        for (const char* pass : {kWhole, kWithShadows, kWithoutShadows})
            image.planes.erase(plane_name(pass, color));
        if (!channels.direct) image.planes.erase(plane_name("direct", color));
    }
}

}  // namespace voxelume
