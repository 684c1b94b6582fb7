// SPDX-License-Identifier: Apache-2.0
#include "runtime/scene/parts/angular_displays.hpp"

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <numbers>

#include "kernels/shared/scene.h"

namespace voxelume {
namespace {

constexpr double kWidestSector = 1.3;  // in radians; wider sectors are taken for whole balls

double near_surface(const Display& display) {
    return display.near;
}

// Sector: the angle from Z_E grows evenly with the distance from the image's middle.

void measure_sector(const DisplayParameters& p, const DisplaySetting& setting, const Refuse& refuse,
                    Display& display) {
    display.half_angles = glm::dvec2(glm::radians(p.angle.value_or(0) / 2));
    set_depths(p, setting.world_end, refuse, display);
}

glm::dvec2 sector_half_extent(const Display& display) {
    return display.half_angles;
}

Bounds sector_bounds(const Display& display) {
    const double far = display.far;
    const double angle = display.half_angles.x, cosine = std::cos(angle);
    const double half = cosine > 0 ? far * std::sin(angle) : far;
    return {{-half, -half, cosine * (cosine > 0 ? display.near : far)}, {half, half, far}};
}

glm::dvec3 point_on_sector_ray(const Display& display, glm::dvec2 uv, double depth) {
    const double radius = glm::length(uv);
    const double angle = radius * display.half_angles.x;
    const double share = radius > 0 ? std::sin(angle) / radius : 0.0;
    return glm::dvec3(-uv * share, std::cos(angle)) * depth;
}

std::optional<glm::dvec2> sector_ray_through(const Display& display, const glm::dvec3& p) {
    const double across = std::hypot(p.x, p.y);
    if (across == 0) return glm::dvec2(0);
    return glm::dvec2(-p.x, -p.y) / across * std::atan2(across, p.z) / sector_half_extent(display);
}

glm::dvec2 sector_slopes(const Display& display) {
    return {std::cos(display.half_angles.x), 0};
}

bool sector_looks_ahead(const Display& display) {
    return display.half_angles.x <= std::numbers::pi / 2;
}

std::optional<FlatSides> sector_sides(const Display& display) {
    const double angle = display.half_angles.x;
    if (angle > kWidestSector) return std::nullopt;
    return FlatSides{glm::dvec2(std::tan(angle)), display.near * std::cos(angle)};
}

constexpr KindKey kSectorKeys[] = {{"angle", true, Range{0, 360, true}}, {"near"}, {"far"}};

constexpr DisplayShapeRow kSector = {.shape = DisplayShape::sector,
                                     .name = "sector",
                                     .kernel_number = VXL_SHAPE_SECTOR,
                                     .projection = SightProjection::angular,
                                     .depth_is_along_z = false,
                                     .image_is_round = true,
                                     .keys = kSectorKeys,
                                     .measure = measure_sector,
                                     .half_extent = sector_half_extent,
                                     .bounds = sector_bounds,
                                     .point_on_ray = point_on_sector_ray,
                                     .ray_through = sector_ray_through,
                                     .looks_ahead = sector_looks_ahead,
                                     .start_radius = near_surface,
                                     .clip_slopes = sector_slopes,
                                     .flat_sides = sector_sides};

// Ball: longitude and latitude.

void measure_ball(const DisplayParameters& p, const DisplaySetting&, const Refuse&,
                  Display& display) {
    display.far = p.radius;
}

glm::dvec2 ball_half_extent(const Display&) {
    return {std::numbers::pi, std::numbers::pi / 2};
}

Bounds ball_bounds(const Display& display) {
    return {glm::dvec3(-display.far), glm::dvec3(display.far)};
}

glm::dvec3 point_on_ball_ray(const Display& display, glm::dvec2 uv, double depth) {
    const glm::dvec2 xy = -uv * ball_half_extent(display);
    return glm::dvec3(std::sin(xy.x) * std::cos(xy.y), std::sin(xy.y),
                      std::cos(xy.x) * std::cos(xy.y)) *
           depth;
}

std::optional<glm::dvec2> ball_ray_through(const Display& display, const glm::dvec3& p) {
    const glm::dvec2 angles(std::atan2(p.x, p.z), std::atan2(p.y, std::hypot(p.x, p.z)));
    return -angles / ball_half_extent(display);
}

bool ball_looks_ahead(const Display&) {
    return false;
}

std::optional<FlatSides> ball_sides(const Display&) {
    return std::nullopt;
}

constexpr KindKey kBallKeys[] = {{"radius", true}};

constexpr DisplayShapeRow kBall = {.shape = DisplayShape::ball,
                                   .name = "ball",
                                   .kernel_number = VXL_SHAPE_BALL,
                                   .projection = SightProjection::angular,
                                   .depth_is_along_z = false,
                                   .image_is_round = false,
                                   .keys = kBallKeys,
                                   .measure = measure_ball,
                                   .half_extent = ball_half_extent,
                                   .bounds = ball_bounds,
                                   .point_on_ray = point_on_ball_ray,
                                   .ray_through = ball_ray_through,
                                   .looks_ahead = ball_looks_ahead,
                                   .start_radius = near_surface,
                                   .clip_slopes = no_slopes,
                                   .flat_sides = ball_sides};

}  // namespace

const DisplayShapeRow& sector_row() {
    return kSector;
}

const DisplayShapeRow& ball_row() {
    return kBall;
}

}  // namespace voxelume
