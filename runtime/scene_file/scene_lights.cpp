// The lights of a scene: point, spot, directional, disk and rectangle.
#include <fmt/format.h>

#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include "runtime/scene_file/scene_parts.hpp"

namespace voxelume {
namespace {

glm::dvec3 read_direction(const SceneFields& fields, glm::dvec3 position) {
    fields.refuse_both("direction", "look_at");
    const auto target = fields.find("look_at");
    return target ? direction_to(*target, position) : fields.get("direction").direction();
}

/// Angles of a spot.
void read_cone(const SceneFields& fields, Light& light) {
    const auto angle = fields.find("angle");
    light.outer_half_angle = angle ? half_angle(*angle, 180, true) : glm::radians(30.0);
    const auto inner = fields.find("inner_angle");
    light.inner_half_angle =
        inner ? glm::radians(inner->number({0, 180, false, true}) / 2) : light.outer_half_angle;
    if (light.inner_half_angle > light.outer_half_angle) {
        inner->fail("must not be larger than the spot's angle");
    }
}

/// The unit vector across a light's direction that is to the left when `up` is up.
glm::dvec3 axis_across(const Light& light, const std::optional<SceneValue>& up) {
    constexpr double kMinSine = 1e-6;
    glm::dvec3 x = glm::cross(up ? up->direction() : glm::dvec3(0, 1, 0), light.direction);
    if (glm::length(x) < kMinSine && !up) x = glm::cross(glm::dvec3(0, 0, 1), light.direction);
    if (glm::length(x) < kMinSine)
        up->fail(
            "the light's direction is parallel to \"up\", which leaves its turn open; give another "
            "\"up\", such as [0, 0, 1]");
    return glm::normalize(x);
}

void read_area(const SceneFields& fields, Light& light) {
    light.light_samples = fields.integer("spots", 1, kMaxLightSamples, light.light_samples);
    if (light.kind == LightKind::disk) {
        light.radius = fields.get("radius").number(kLength);
        light.axis_x = axis_across(light, {});
    } else {
        light.size = fields.get("size").pair(kLength);
        light.axis_x = axis_across(light, fields.find("up"));
    }
}

}  // namespace

Light read_light(const SceneValue& value, size_t number) {
    const size_t kind = kind_of(value, "type", "light");
    const SceneFields fields(value, fmt::format("light:{}", scene_kinds("light")[kind]));
    Light light;
    light.where = value.where();
    light.kind = static_cast<LightKind>(kind);  // the tables have the order of the enumeration
    const auto name = fields.find("name");
    light.name = name ? name->text() : fmt::format("lights[{}]", number);
    light.intensity = fields.color("color", kMaxLength, glm::vec3(1)) *
                      static_cast<float>(fields.number("intensity", kNotNegative, 1));
    if (light.kind == LightKind::directional) {
        light.direction = fields.get("direction").direction();
        return light;
    }
    light.position = fields.get("position").vector(kCoordinate);
    if (light.kind == LightKind::point) return light;
    light.direction = read_direction(fields, light.position);
    if (light.kind == LightKind::spot)
        read_cone(fields, light);
    else
        read_area(fields, light);
    return light;
}

std::vector<Light> read_lights(const SceneValue& value) {
    std::vector<Light> lights;
    for (const SceneValue& item : value.items()) lights.push_back(read_light(item, lights.size()));
    return lights;
}

}  // namespace voxelume
