// SPDX-License-Identifier: Apache-2.0
#include "runtime/analysis/scene_lights.hpp"

#include <algorithm>
#include <iterator>

#include "runtime/scene/predicates.hpp"
#include "runtime/stages/light/light.hpp"
#include "runtime/stages/light/light_samples.hpp"
#include "runtime/stages/light/sky_light.hpp"

namespace voxelume {
namespace {

/// The maximum number of points and spots to which each point sends a shadow ray.
constexpr size_t kMostLightsOfEach = 8;

/// True unless the light makes a choice worth while: one that shines and may be chosen.
bool is_dark_or_alone(const PathLight& light) {
    return is_dark(light) || !may_be_chosen(light);
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
        if (shines(light) || may_be_chosen(added)) lights.push_back(added);
    }
    return lights;
}

bool may_be_chosen(const PathLight& light) {
    return !light.area &&
           (light.record.kind == VXL_LIGHT_POINT || light.record.kind == VXL_LIGHT_SPOT);
}

bool is_dark(const PathLight& light) {
    return light.record.intensity.w != 0;
}

std::vector<LightRecord> chosen_lights(std::span<const PathLight> lights) {
    std::vector<LightRecord> chosen;
    for (const PathLight& light : lights)
        if (may_be_chosen(light)) chosen.push_back(light.record);
    if (chosen.size() <= kMostLightsOfEach || std::ranges::all_of(lights, is_dark_or_alone))
        chosen.clear();
    return chosen;
}

size_t count_chosen_lights(const Scene& scene, const GridFrame& world) {
    if (scene.render.light != LightMode::global) return 0;
    std::vector<PathLight> lights = path_lights(scene, world);
    std::erase_if(lights, [&](const PathLight& light) { return !may_light(light.record, world); });
    return chosen_lights(lights).size();
}

}  // namespace voxelume
