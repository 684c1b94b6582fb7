// SPDX-License-Identifier: Apache-2.0
#include "runtime/analysis/scene_lights.hpp"

#include <algorithm>
#include <glm/geometric.hpp>
#include <iterator>
#include <utility>

#include "runtime/scene/predicates.hpp"
#include "runtime/stages/light/light_samples.hpp"
#include "runtime/stages/light/sky_light.hpp"

namespace voxelume {
namespace {

/// The maximum number of points and spots, and of lights with an area, to which each point sends a
/// shadow ray.
constexpr size_t kMostLightsOfEach = 8;

/// The largest radius of a light that may be chosen, as a part of the world's diagonal.
constexpr double kLargestChosen = 1.0 / 16;

/// The lights of a scene in global light that may reach its world.
std::vector<PathLight> lights_that_reach(const Scene& scene, const GridFrame& world) {
    if (scene.render.light != LightMode::global) return {};
    std::vector<PathLight> lights = path_lights(scene, world);
    std::erase_if(lights, [&](const PathLight& light) { return !may_light(light.record, world); });
    return lights;
}

}  // namespace

std::vector<LightRecord> given_lights(const Scene& scene, const GridFrame& world) {
    std::vector<LightRecord> records;
    if (has_sun(scene.world)) records.push_back(sun_light_record(*scene.world.sky, world));
    for (const Light& light : scene.lights) {
        if (!shines(light)) continue;
        if (has_area(light))
            std::ranges::copy(area_light_samples(light, world), std::back_inserter(records));
        else
            records.push_back(light_record(light, world));
    }
    return records;
}

std::vector<PathLight> path_lights(const Scene& scene, const GridFrame& world) {
    std::vector<PathLight> lights;
    if (has_sun(scene.world)) {
        const Sky& sky = *scene.world.sky;
        lights.push_back({sun_light_record(sky, world), sun_area_record(sky, world), 0});
    }
    uint32_t number = scene.world.sky && scene.world.sky->kind == SkyKind::sun ? 1 : 0;
    for (const Light& light : scene.lights) {
        const uint32_t own_number = number++;
        if (light.intensity == glm::vec3(0)) continue;
        PathLight added{light_record(light, world), {}, own_number};
        if (has_area(light)) added.area = light_area_record(light, world);
        if (shines(light) || may_be_chosen(added, world)) lights.push_back(added);
    }
    return lights;
}

bool may_be_chosen(const PathLight& light, const GridFrame& world) {
    if (light.area) {
        const bool is_sun = light.record.kind == VXL_LIGHT_DIRECTIONAL;
        const double diagonal = glm::length(glm::dvec3(world.size) * world.voxel_edge);
        return !is_sun && radius_of(*light.area, world) <= kLargestChosen * diagonal;
    }
    return light.record.kind == VXL_LIGHT_POINT || light.record.kind == VXL_LIGHT_SPOT;
}

bool is_dark(const PathLight& light) {
    return light.record.intensity.w != 0;
}

std::vector<std::vector<PathLight>> chosen_lights(std::span<const PathLight> lights,
                                                  const GridFrame& world) {
    std::vector<std::vector<PathLight>> lists;
    for (const bool have_areas : {false, true}) {
        std::vector<PathLight> list;
        for (const PathLight& light : lights)
            if (may_be_chosen(light, world) && light.area.has_value() == have_areas)
                list.push_back(light);
        if (list.size() > kMostLightsOfEach && !std::ranges::all_of(list, is_dark))
            lists.push_back(std::move(list));
    }
    return lists;
}

std::vector<std::vector<PathLight>> chosen_lights_of(const Scene& scene, const GridFrame& world) {
    return chosen_lights(lights_that_reach(scene, world), world);
}

bool asks_areas(const Scene& scene, const GridFrame& world, bool are_chosen) {
    return std::ranges::any_of(lights_that_reach(scene, world), [&](const PathLight& light) {
        return light.area && !is_dark(light) && !(are_chosen && may_be_chosen(light, world));
    });
}

}  // namespace voxelume
