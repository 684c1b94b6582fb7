// SPDX-License-Identifier: Apache-2.0
#include "runtime/scene/parts/display_shape.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include "kernels/shared/scene.h"
#include "runtime/scene/parts/angular_displays.hpp"

namespace voxelume {

namespace {

bool always_looks_ahead(const Display&) {
    return true;
}

// Pyramid.

void make_pyramid_square(glm::dvec2 size, Display& display) {
    display.half_angles.y = std::atan(std::tan(display.half_angles.x) * size.y / size.x);
}

void widen_pyramid(Display& display, glm::dvec2 scale) {
    display.half_angles = glm::atan(glm::tan(display.half_angles) * scale);
}

void measure_pyramid(const DisplayParameters& p, const DisplaySetting& setting,
                     const Refuse& refuse, Display& display) {
    refuse_both(p.angles.has_value(), "angles", p.angle.has_value(), "angle", refuse);
    if (p.angles) {
        display.half_angles = glm::radians(*p.angles / 2.0);
    } else {
        display.square_pixels = true;
        display.half_angles.x = p.angle ? glm::radians(*p.angle / 2) : glm::radians(20.0);
        make_pyramid_square(setting.proportions, display);
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
                                      .flat_sides = pyramid_sides,
                                      .widen = widen_pyramid,
                                      .make_square = make_pyramid_square};

// Box.

void make_box_square(glm::dvec2 size, Display& display) {
    glm::dvec2& half = display.half_size;
    if (display.keeps_height)
        half.x = half.y * size.x / size.y;
    else
        half.y = half.x * size.y / size.x;
}

void widen_box(Display& display, glm::dvec2 scale) {
    display.half_size *= scale;
}

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
                                  .flat_sides = box_sides,
                                  .widen = widen_box,
                                  .make_square = make_box_square};

}  // namespace

glm::dvec2 no_slopes(const Display&) {
    return glm::dvec2(0);
}

void set_depths(const DisplayParameters& p, double world_end, const Refuse& refuse,
                Display& display) {
    display.near = p.near;
    display.far = p.far.value_or(world_end);
    if (display.far <= display.near)
        refuse(p.far ? "far" : "near",
               fmt::format("nothing lies between near, {} m, and far, {} m{}", display.near,
                           display.far, p.far ? "" : ", the end of the world"));
}

std::span<const DisplayShapeRow> display_shapes() {
    static const std::array<DisplayShapeRow, 4> shapes = {kPyramid, sector_row(), ball_row(), kBox};
    return shapes;
}

const DisplayShapeRow& shape_row(const Display& display) {
    return display_shapes()[size_t(display.shape)];
}

glm::dvec2 half_extent(const Display& display) {
    return shape_row(display).half_extent(display);
}

}  // namespace voxelume
