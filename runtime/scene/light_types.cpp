#include "runtime/scene/light_types.hpp"

#include <array>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <numbers>

#include "kernels/shared/scene.h"
#include "runtime/scene/light_points.hpp"

namespace voxelume {
namespace {

using P = LightParameters;

void place_point(const P& p, const Refuse&, Light& light) {
    light.position = p.position;
}

void place_directional(const P& p, const Refuse& refuse, Light& light) {
    light.direction = unit_vector(p.direction.value_or(glm::dvec3(0)), "direction", refuse);
}

/// A position, and a direction from it that is given or leads to a point.
void aim(const P& p, const Refuse& refuse, Light& light) {
    light.position = p.position;
    refuse_both(p.direction.has_value(), "direction", p.look_at.has_value(), "look_at", refuse);
    if (!p.direction && !p.look_at) refuse("", "needs a \"direction\"");
    light.direction = p.look_at ? unit_vector_to(*p.look_at, p.position, "look_at", refuse)
                                : unit_vector(*p.direction, "direction", refuse);
}

void place_spot(const P& p, const Refuse& refuse, Light& light) {
    aim(p, refuse, light);
    light.outer_half_angle = p.angle ? glm::radians(*p.angle / 2) : glm::radians(30.0);
    light.inner_half_angle =
        p.inner_angle ? glm::radians(*p.inner_angle / 2) : light.outer_half_angle;
    if (light.inner_half_angle > light.outer_half_angle)
        refuse("inner_angle", "must not be larger than the spot's angle");
}

/// The unit vector across a light's direction that is to the left when `up` is up.
glm::dvec3 axis_across(const Light& light, const std::optional<glm::dvec3>& up,
                       const Refuse& refuse) {
    constexpr double kLeastSine = 1e-6;
    const glm::dvec3 y = up ? unit_vector(*up, "up", refuse) : glm::dvec3(0, 1, 0);
    glm::dvec3 x = glm::cross(y, light.direction);
    if (glm::length(x) < kLeastSine && !up) x = glm::cross(glm::dvec3(0, 0, 1), light.direction);
    if (glm::length(x) < kLeastSine)
        refuse("up",
               "the light's direction is parallel to \"up\", which leaves its turn open; give "
               "another \"up\", such as [0, 0, 1]");
    return glm::normalize(x);
}

void place_disk(const P& p, const Refuse& refuse, Light& light) {
    aim(p, refuse, light);
    light.spots = p.spots;
    light.radius = p.radius;
    light.axis_x = axis_across(light, {}, refuse);
}

void place_rectangle(const P& p, const Refuse& refuse, Light& light) {
    aim(p, refuse, light);
    light.spots = p.spots;
    light.size = p.size;
    light.axis_x = axis_across(light, p.up, refuse);
}

constexpr LightArea kDisk = {
    [](const Light& light) { return std::numbers::pi * light.radius * light.radius; },
    [](const Light& light) { return light.radius; },
    [](const Light& light) { return points_of_disk(light.radius, light.spots); }};

constexpr LightArea kRectangle = {
    [](const Light& light) { return light.size.x * light.size.y; },
    [](const Light& light) { return glm::length(light.size) / 2; },
    [](const Light& light) { return points_of_rectangle(light.size, light.spots); }};

constexpr KindKey kPointKeys[] = {{"position", true}};
constexpr KindKey kSpotKeys[] = {
    {"position", true}, {"direction"}, {"look_at"}, {"angle"}, {"inner_angle"}};
constexpr KindKey kDirectionalKeys[] = {{"direction", true}};
constexpr KindKey kDiskKeys[] = {
    {"position", true}, {"direction"}, {"look_at"}, {"radius", true}, {"spots"}};
constexpr KindKey kRectangleKeys[] = {{"position", true}, {"direction"}, {"look_at"}, {"up"},
                                      {"size", true},     {"spots"}};

constexpr std::array<LightType, 5> kTypes = {{
    {LightKind::point, "point", kPointKeys, true, VXL_LIGHT_POINT, place_point},
    {LightKind::spot, "spot", kSpotKeys, true, VXL_LIGHT_SPOT, place_spot},
    {LightKind::directional, "directional", kDirectionalKeys, false, VXL_LIGHT_DIRECTIONAL,
     place_directional},
    {LightKind::disk, "disk", kDiskKeys, true, VXL_LIGHT_PATCH, place_disk, &kDisk},
    {LightKind::rectangle, "rectangle", kRectangleKeys, true, VXL_LIGHT_PATCH, place_rectangle,
     &kRectangle},
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
        {"position", &P::position, kCoordinate},
        {"direction", &P::direction, kCoordinate},
        {"look_at", &P::look_at, kCoordinate},
        {"up", &P::up, kCoordinate},
        {"color", &P::color, kNotNegative},
        {"intensity", &P::intensity, kNotNegative},
        {"angle", &P::angle, {0, 180, true, true}},
        {"inner_angle", &P::inner_angle, {0, 180, false, true}},
        {"radius", &P::radius, kLength},
        {"size", &P::size, kLength},
        {"spots", &P::spots, {1, kMaxSpots}, false, false},
    }};
    return rows;
}

void set_light(const LightType& type, const LightParameters& parameters, const Refuse& refuse,
               Light& light) {
    light.kind = type.kind;
    light.energy = parameters.color * static_cast<float>(parameters.intensity);
    type.place(parameters, refuse, light);
}

}  // namespace voxelume
