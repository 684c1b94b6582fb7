// SPDX-License-Identifier: Apache-2.0
#include "runtime/image/volume_geometry.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace voxelume {

namespace {

bool is_finite(const glm::dvec3& v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

bool is_rigid(const glm::dmat4& m) {
    const glm::dvec3 x(m[0]), y(m[1]), z(m[2]);
    constexpr double kSlack = 1e-6;
    const auto near = [](double a, double b) { return std::abs(a - b) <= kSlack; };
    return is_finite(x) && is_finite(y) && is_finite(z) && is_finite(glm::dvec3(m[3])) &&
           near(glm::dot(x, x), 1) && near(glm::dot(y, y), 1) && near(glm::dot(z, z), 1) &&
           near(glm::dot(x, y), 0) && near(glm::dot(y, z), 0) && near(glm::dot(z, x), 0) &&
           m[0][3] == 0 && m[1][3] == 0 && m[2][3] == 0 && m[3][3] == 1;
}

std::string find_display_fault(const VolumeFrame& frame) {
    const Display& display = frame.display;
    if (!(display.near >= 0 && std::isfinite(display.far))) return "its depths aren't finite";
    const glm::dvec2 half = half_extent(display);
    if (!(half.x > 0 && half.y > 0 && std::isfinite(half.x) && std::isfinite(half.y)))
        return "its display has no width";
    return {};
}

}  // namespace

uint64_t voxel_count(const VolumeFrame& frame) {
    return uint64_t(frame.size.x) * uint64_t(frame.size.y) * uint64_t(frame.size.z);
}

glm::ivec3 cell_of(const VolumeFrame& frame, uint64_t index) {
    const auto x = uint64_t(frame.size.x), y = uint64_t(frame.size.y);
    return {int(index % x), int(index / x % y), int(index / x / y)};
}

bool depth_is_along_z(const VolumeFrame& frame) {
    return shape_row(frame.display).depth_is_along_z;
}

std::optional<glm::dmat4> world_from_voxels(const VolumeFrame& frame) {
    glm::dmat4 observer_from_voxels(1);
    if (frame.layout == VolumeLayout::lattice) {
        for (int axis = 0; axis < 3; ++axis) observer_from_voxels[axis][axis] = frame.edge[axis];
        observer_from_voxels[3] = glm::dvec4(frame.origin, 1);
    } else if (shape_row(frame.display).projection == SightProjection::parallel) {
        const glm::dvec2 half = half_extent(frame.display);
        observer_from_voxels[0][0] = -2 * half.x / frame.size.x;
        observer_from_voxels[1][1] = -2 * half.y / frame.size.y;
        observer_from_voxels[2][2] = frame.step;
        observer_from_voxels[3] = glm::dvec4(half, frame.display.near, 1);
    } else {
        return std::nullopt;
    }
    return frame.world_from_observer * observer_from_voxels;
}

glm::dvec3 point_on_ray(const VolumeFrame& frame, glm::dvec2 uv, double depth) {
    const glm::dvec2 signed_uv = 2.0 * uv / glm::dvec2(frame.size) - 1.0;
    return shape_row(frame.display).point_on_ray(frame.display, signed_uv, depth);
}

DepthScales depth_scales(const VolumeFrame& frame, glm::dvec2 uv) {
    const DisplayShapeRow& shape = shape_row(frame.display);
    const glm::dvec3 point = point_on_ray(frame, uv, 1.0);
    DepthScales scales;
    if (shape.projection == SightProjection::perspective) scales.distance = glm::length(point);
    if (!shape.depth_is_along_z && shape.looks_ahead(frame.display)) scales.z = point.z;
    return scales;
}

glm::dvec3 voxel_center(const VolumeFrame& frame, glm::ivec3 cell) {
    const glm::dvec3 middle = glm::dvec3(cell) + 0.5;
    const glm::dvec3 p_observer =
        frame.layout == VolumeLayout::lattice
            ? frame.origin + frame.edge * middle
            : point_on_ray(frame, middle, frame.display.near + frame.step * middle.z);
    return glm::dvec3(frame.world_from_observer * glm::dvec4(p_observer, 1));
}

std::string find_fault(const VolumeFrame& frame) {
    for (int axis = 0; axis < 3; ++axis)
        if (frame.size[axis] < 1 || frame.size[axis] > kMaxVolumeSide)
            return fmt::format("it has {} voxels along an axis, and 1 to {} are possible",
                               frame.size[axis], kMaxVolumeSide);
    if (!is_rigid(frame.world_from_observer)) return "its observer isn't placed by a rigid matrix";
    if (frame.layout == VolumeLayout::rays) {
        if (!(frame.step > 0 && std::isfinite(frame.step))) return "its steps have no length";
        return find_display_fault(frame);
    }
    const glm::dvec3& edge = frame.edge;
    if (!is_finite(edge) || !(edge.x > 0 && edge.y > 0 && edge.z > 0))
        return "its voxels have no size";
    if (!is_finite(frame.origin)) return "its origin isn't finite";
    return {};
}

std::string find_fault(const Volume& volume) {
    if (std::string fault = find_fault(volume.frame); !fault.empty()) return fault;
    const size_t count = volume.indices.size();
    if (volume.colors.size() != count || volume.opacities.size() != count ||
        volume.depths.size() != count || volume.objects.size() != count ||
        volume.kinds.size() != count)
        return "not every voxel has a colour, opacity, depth, object and kind";
    if (std::ranges::adjacent_find(volume.indices, std::greater_equal<>()) != volume.indices.end())
        return "its voxels aren't in ascending order";
    if (count > 0 && volume.indices.back() >= voxel_count(volume.frame))
        return "a voxel lies outside of it";
    const auto is_share = [](float opacity) { return opacity >= 0 && opacity <= 1; };
    if (!std::ranges::all_of(volume.opacities, is_share)) return "an opacity isn't within 0 to 1";
    const auto is_light = [](const glm::vec3& color) { return is_finite(glm::dvec3(color)); };
    if (!std::ranges::all_of(volume.colors, is_light)) return "a colour isn't finite";
    return {};
}

}  // namespace voxelume
