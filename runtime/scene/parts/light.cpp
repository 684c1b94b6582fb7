// SPDX-License-Identifier: Apache-2.0
#include "runtime/scene/parts/light.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <numbers>

#include "kernels/shared/scene.h"

namespace voxelume {

namespace {

/// The middles of `count` equal parts of a rectangle, halved across its longer side.
void divide(glm::dvec2 middle, glm::dvec2 size, int count, std::vector<glm::dvec2>& middles) {
    if (count == 1) return middles.push_back(middle);
    const int axis = size.y > size.x ? 1 : 0;
    const int low_count = count / 2;
    const double low = size[axis] * low_count / count, first = middle[axis] - size[axis] / 2;
    const double high = size[axis] - low;
    size[axis] = low;
    middle[axis] = first + low / 2;
    divide(middle, size, low_count, middles);
    size[axis] = high;
    middle[axis] = first + low + high / 2;
    divide(middle, size, count - low_count, middles);
}

std::vector<glm::dvec2> points_of_rectangle(glm::dvec2 size, int count) {
    std::vector<glm::dvec2> middles;
    divide({0, 0}, size, count, middles);
    return middles;
}

std::vector<glm::dvec2> points_of_disk(double radius, int count) {
    const double step = std::numbers::pi * (3 - std::sqrt(5.0));
    if (count == 1) return {glm::dvec2(0)};
    std::vector<glm::dvec2> points;
    for (int i = 0; i < count; ++i) {
        const double r = radius * std::sqrt((i + 0.5) / count);
        points.emplace_back(r * std::cos(i * step), r * std::sin(i * step));
    }
    return points;
}

void place_point(const LightParameters& p, const Refuse&, Light& light) {
    light.position = p.position;
}

void place_directional(const LightParameters& p, const Refuse& refuse, Light& light) {
    light.direction = unit_vector(p.direction.value_or(glm::dvec3(0)), "direction", refuse);
}

/// Sets a position, and a direction that is given or leads to a point.
void aim(const LightParameters& p, const Refuse& refuse, Light& light) {
    light.position = p.position;
    refuse_both(p.direction.has_value(), "direction", p.look_at.has_value(), "look_at", refuse);
    if (!p.direction && !p.look_at) refuse("", "needs a \"direction\"");
    light.direction = p.look_at ? unit_vector_to(*p.look_at, p.position, "look_at", refuse)
                                : unit_vector(*p.direction, "direction", refuse);
}

void place_spot(const LightParameters& p, const Refuse& refuse, Light& light) {
    aim(p, refuse, light);
    light.outer_half_angle = p.angle ? glm::radians(*p.angle / 2) : glm::radians(30.0);
    light.inner_half_angle =
        p.inner_angle ? glm::radians(*p.inner_angle / 2) : light.outer_half_angle;
    if (light.inner_half_angle > light.outer_half_angle)
        refuse("inner_angle", "must not be larger than the spot's angle");
}

/// The unit vector perpendicular to a light's direction that points left when `up` is up.
glm::dvec3 axis_across(const Light& light, const std::optional<glm::dvec3>& up,
                       const Refuse& refuse) {
    constexpr double kMinSine = 1e-6;
    const glm::dvec3 y = up ? unit_vector(*up, "up", refuse) : glm::dvec3(0, 1, 0);
    glm::dvec3 x = glm::cross(y, light.direction);
    if (glm::length(x) < kMinSine && !up) x = glm::cross(glm::dvec3(0, 0, 1), light.direction);
    if (glm::length(x) < kMinSine)
        refuse("up",
               "the light's direction is parallel to \"up\", which leaves its turn open; give "
               "another \"up\", such as [0, 0, 1]");
    return glm::normalize(x);
}

void place_disk(const LightParameters& p, const Refuse& refuse, Light& light) {
    aim(p, refuse, light);
    light.light_samples = p.light_samples;
    light.radius = p.radius;
    light.axis_x = axis_across(light, {}, refuse);
}

void place_rectangle(const LightParameters& p, const Refuse& refuse, Light& light) {
    aim(p, refuse, light);
    light.light_samples = p.light_samples;
    light.size = p.size;
    light.axis_x = axis_across(light, p.up, refuse);
}

double part_of_spot(const Light& light, double cosine) {
    const double inner = std::cos(light.inner_half_angle), outer = std::cos(light.outer_half_angle);
    const double s = std::clamp((cosine - outer) / std::max(inner - outer, 1e-30), 0.0, 1.0);
    return s * s * (3 - 2 * s);
}

double part_of_area(const Light&, double cosine) {
    return std::max(cosine, 0.0);
}

constexpr LightArea kDisk = {
    [](const Light& light) { return std::numbers::pi * light.radius * light.radius; },
    [](const Light& light) { return light.radius; },
    [](const Light& light) { return glm::dvec2(light.radius); }, true,
    [](const Light& light) { return points_of_disk(light.radius, light.light_samples); }};

constexpr LightArea kRectangle = {
    [](const Light& light) { return light.size.x * light.size.y; },
    [](const Light& light) { return glm::length(light.size) / 2; },
    [](const Light& light) { return light.size / 2.0; }, false,
    [](const Light& light) { return points_of_rectangle(light.size, light.light_samples); }};

constexpr KindKey kPointKeys[] = {{"position", true}};
constexpr KindKey kSpotKeys[] = {
    {"position", true}, {"direction"}, {"look_at"}, {"angle"}, {"inner_angle"}};
constexpr KindKey kDirectionalKeys[] = {{"direction", true}};
constexpr KindKey kDiskKeys[] = {
    {"position", true}, {"direction"}, {"look_at"}, {"radius", true}, {"spots"}};
constexpr KindKey kRectangleKeys[] = {{"position", true}, {"direction"}, {"look_at"}, {"up"},
                                      {"size", true},     {"spots"}};

constexpr std::array<LightType, 5> kTypes = {{
    // The columns: kind, name, keys, has_position, has_direction, shading, place, part_at, area.
    {LightKind::point, "point", kPointKeys, true, false, VXL_LIGHT_POINT, place_point},
    {LightKind::spot, "spot", kSpotKeys, true, true, VXL_LIGHT_SPOT, place_spot, part_of_spot},
    {LightKind::directional, "directional", kDirectionalKeys, false, true, VXL_LIGHT_DIRECTIONAL,
     place_directional},
    {LightKind::disk, "disk", kDiskKeys, true, true, VXL_LIGHT_AREA_SAMPLE, place_disk,
     part_of_area, &kDisk},
    {LightKind::rectangle, "rectangle", kRectangleKeys, true, true, VXL_LIGHT_AREA_SAMPLE,
     place_rectangle, part_of_area, &kRectangle},
}};

}  // namespace

std::span<const LightType> light_types() {
    return kTypes;
}

const LightType& type_of(const Light& light) {
    return kTypes[size_t(light.kind)];
}

std::span<const ValueRow<LightParameters>> light_rows() {
    static constexpr std::array<ValueRow<LightParameters>, 11> rows = {{
        {"position", &LightParameters::position, kCoordinate},
        {"direction", &LightParameters::direction, kCoordinate},
        {"look_at", &LightParameters::look_at, kCoordinate},
        {"up", &LightParameters::up, kCoordinate},
        {"color", &LightParameters::color, kNotNegative},
        {"intensity", &LightParameters::intensity, kNotNegative},
        {"angle", &LightParameters::angle, {0, 180, true, true}},
        {"inner_angle", &LightParameters::inner_angle, {0, 180, false, true}},
        {"radius", &LightParameters::radius, kLength},
        {"size", &LightParameters::size, kLength},
        {"spots", &LightParameters::light_samples, {1, kMaxLightSamples}, false, false},
    }};
    return rows;
}

void set_light(const LightType& type, const LightParameters& parameters, const Refuse& refuse,
               Light& light) {
    light.kind = type.kind;
    light.intensity = parameters.color * static_cast<float>(parameters.intensity);
    type.place(parameters, refuse, light);
}

}  // namespace voxelume
