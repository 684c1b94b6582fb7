// SPDX-License-Identifier: Apache-2.0
#include "runtime/scene/parts/display_shape.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <numbers>

#include "kernels/shared/scene.h"

namespace voxelume {

namespace {

constexpr double kWidestSector = 1.3;  // in radians; wider sectors are taken for whole balls

/// `near` and `far` of a pyramid or sector, which without a `far` shows the whole world.
void set_depths(const DisplayParameters& p, double world_end, const Refuse& refuse,
                Display& display) {
    display.near = p.near;
    display.far = p.far.value_or(world_end);
    if (display.far <= display.near)
        refuse(p.far ? "far" : "near",
               fmt::format("nothing lies between near, {} m, and far, {} m{}", display.near,
                           display.far, p.far ? "" : ", the end of the world"));
}

glm::dvec2 no_slopes(const Display&) {
    return glm::dvec2(0);
}

bool always_looks_ahead(const Display&) {
    return true;
}

double near_surface(const Display& display) {
    return display.near;
}

// Pyramid.

void measure_pyramid(const DisplayParameters& p, const DisplaySetting& setting,
                     const Refuse& refuse, Display& display) {
    refuse_both(p.angles.has_value(), "angles", p.angle.has_value(), "angle", refuse);
    if (p.angles) {
        display.half_angles = glm::radians(*p.angles / 2.0);
    } else {
        display.square_pixels = true;
        display.half_angles.x = p.angle ? glm::radians(*p.angle / 2) : glm::radians(20.0);
        display.half_angles.y = square_pixel_half_angle(display.half_angles.x, setting.image_size);
    }
    set_depths(p, setting.world_end, refuse, display);
}

glm::dvec2 pyramid_half_extent(const Display& display) {
    return glm::tan(display.half_angles);
}

Bounds pyramid_bounds(const Display& display) {
    const glm::dvec2 half = display.far * glm::tan(display.half_angles);
    return {{-half.x, -half.y, display.near}, {half.x, half.y, display.far}};
}

glm::dvec3 point_on_pyramid_ray(const Display& display, glm::dvec2 uv, double depth) {
    return glm::dvec3(-uv * pyramid_half_extent(display), 1.0) * depth;
}

std::optional<glm::dvec2> pyramid_ray_through(const Display& display, const glm::dvec3& p) {
    if (p.z <= 0) return {};
    return glm::dvec2(-p.x, -p.y) / p.z / pyramid_half_extent(display);
}

double pyramid_start_radius(const Display& display) {
    const glm::dvec2 half = pyramid_half_extent(display);
    return display.near * std::sqrt(1 + glm::dot(half, half));
}

std::optional<FlatSides> pyramid_sides(const Display& display) {
    return FlatSides{pyramid_half_extent(display), display.near};
}

constexpr KindKey kPyramidKeys[] = {{"angles"}, {"angle"}, {"near"}, {"far"}};

constexpr DisplayShapeRow kPyramid = {.shape = DisplayShape::pyramid,
                                      .name = "pyramid",
                                      .kernel_number = VXL_SHAPE_PYRAMID,
                                      .projection = SightProjection::perspective,
                                      .depth_is_along_z = true,
                                      .image_is_round = false,
                                      .keys = kPyramidKeys,
                                      .measure = measure_pyramid,
                                      .half_extent = pyramid_half_extent,
                                      .bounds = pyramid_bounds,
                                      .point_on_ray = point_on_pyramid_ray,
                                      .ray_through = pyramid_ray_through,
                                      .looks_ahead = always_looks_ahead,
                                      .start_radius = pyramid_start_radius,
                                      .clip_slopes = pyramid_half_extent,
                                      .flat_sides = pyramid_sides};

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

// Box.

void measure_box(const DisplayParameters& p, const DisplaySetting&, const Refuse&,
                 Display& display) {
    display.half_size = glm::dvec2(p.size) / 2.0;
    display.near = p.near;
    display.far = display.near + p.size.z;
}

glm::dvec2 box_half_extent(const Display& display) {
    return display.half_size;
}

Bounds box_bounds(const Display& display) {
    const glm::dvec2 half = display.half_size;
    return {{-half.x, -half.y, display.near}, {half.x, half.y, display.far}};
}

glm::dvec3 point_on_box_ray(const Display& display, glm::dvec2 uv, double depth) {
    return {-uv * display.half_size, depth};
}

std::optional<glm::dvec2> box_ray_through(const Display& display, const glm::dvec3& p) {
    return glm::dvec2(-p.x, -p.y) / box_half_extent(display);
}

double box_start_radius(const Display& display) {
    const glm::dvec2 half = display.half_size;
    return std::sqrt(display.near * display.near + glm::dot(half, half));
}

std::optional<FlatSides> box_sides(const Display& display) {
    return FlatSides{display.half_size, display.near};
}

constexpr KindKey kBoxKeys[] = {{"size", true}, {"near"}};

constexpr DisplayShapeRow kBox = {.shape = DisplayShape::box,
                                  .name = "box",
                                  .kernel_number = VXL_SHAPE_BOX,
                                  .projection = SightProjection::parallel,
                                  .depth_is_along_z = true,
                                  .image_is_round = false,
                                  .keys = kBoxKeys,
                                  .measure = measure_box,
                                  .half_extent = box_half_extent,
                                  .bounds = box_bounds,
                                  .point_on_ray = point_on_box_ray,
                                  .ray_through = box_ray_through,
                                  .looks_ahead = always_looks_ahead,
                                  .start_radius = box_start_radius,
                                  .clip_slopes = no_slopes,
                                  .flat_sides = box_sides};

constexpr std::array<DisplayShapeRow, 4> kShapes = {kPyramid, kSector, kBall, kBox};

}  // namespace

std::span<const DisplayShapeRow> display_shapes() {
    return kShapes;
}

const DisplayShapeRow& shape_row(const Display& display) {
    return kShapes[size_t(display.shape)];
}

glm::dvec2 half_extent(const Display& display) {
    return shape_row(display).half_extent(display);
}

std::span<const ValueRow<DisplayParameters>> display_rows() {
    static constexpr std::array<ValueRow<DisplayParameters>, 6> rows = {{
        {"angles", &DisplayParameters::angles, {0, 180, true, true}},
        {"angle", &DisplayParameters::angle, {0, 180, true, true}},
        {"near", &DisplayParameters::near, kNotNegative},
        {"far", &DisplayParameters::far, kLength},
        {"radius", &DisplayParameters::radius, kLength},
        {"size", &DisplayParameters::size, kLength},
    }};
    return rows;
}

double square_pixel_half_angle(double horizontal_half_angle, glm::ivec2 size) {
    return std::atan(std::tan(horizontal_half_angle) * size.y / size.x);
}

}  // namespace voxelume
