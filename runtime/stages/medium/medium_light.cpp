// SPDX-License-Identifier: Apache-2.0
#include "runtime/stages/medium/medium_light.hpp"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <numbers>

#include "runtime/scene/predicates.hpp"

namespace voxelume {
namespace {

/// The light's strength at a squared distance; `cosine` is that of the angle at which it leaves.
double falloff_of(const Light& light, double squared, double cosine) {
    const LightType& type = type_of(light);
    const double part = type.part_at ? type.part_at(light, cosine) : 1;
    return part / (type.area ? squared + type.area->area(light) / std::numbers::pi : squared);
}

}  // namespace

MediumLights lights_along(const glm::dvec3& direction) {
    constexpr float kAmbient = 0.25F;
    Light light;
    light.kind = LightKind::directional;
    light.direction = direction;
    light.intensity = glm::vec3(1 - kAmbient);
    return {{light}, glm::dvec3(kAmbient)};
}

MediumSurface medium_surface(const std::array<double, 8>& eighths, const glm::dvec3& edge) {
    glm::dvec3 rise(0);
    double sum = 0;
    for (size_t i = 0; i < 8; ++i) {
        sum += eighths[i];
        for (int axis = 0; axis < 3; ++axis)
            rise[axis] += (i >> axis & 1) != 0 ? eighths[i] : -eighths[i];
    }
    const double contrast = glm::length(rise);
    if (!(contrast > 0)) return {};
    // A difference of a quarter of the mean counts as a full surface; smaller ones as a part of
    // one.
    return {glm::normalize(rise / edge), std::min(4 * contrast / sum, 1.0)};
}

glm::dvec3 light_on(const MediumSurface& surface, const glm::dvec3& position,
                    const MediumLights& lights) {
    glm::dvec3 sum = lights.ambient;
    for (const Light& light : lights.lights) {
        if (!shines(light)) continue;
        glm::dvec3 way = light.direction;  // direction of the light, a unit vector
        double strength = 1;
        if (type_of(light).has_position) {
            const glm::dvec3 from_light = position - light.position;
            const double squared = glm::dot(from_light, from_light);
            if (!(squared > 0)) continue;
            way = from_light / std::sqrt(squared);
            strength = falloff_of(light, squared, glm::dot(way, light.direction));
        }
        const double cosine = std::max(glm::dot(surface.inward, way), 0.0);
        sum += glm::dvec3(light.intensity) * (strength * glm::mix(1.0, cosine, surface.share));
    }
    return sum;
}

}  // namespace voxelume
