// SPDX-License-Identifier: Apache-2.0
#include "runtime/stages/display/display_frame.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <limits>

#include "runtime/opencl/float4.hpp"

namespace voxelume {
namespace {

/// The absorption that decides the opacity of voxels of space: the smallest of the three channels.
/// If a medium emits light but doesn't absorb all channels, it is the smallest positive one.
double covering_absorption(const Medium& medium) {
    const glm::vec3& a = medium.absorption;
    const double minimum = double(std::min({a.x, a.y, a.z}));
    const bool shines = medium.color != glm::vec3(0) || has_medium_colors(medium);
    if (minimum > 0 || !shines) return minimum;
    double positive = std::numeric_limits<double>::infinity();
    for (int channel = 0; channel < 3; ++channel)
        if (a[channel] > 0) positive = std::min(positive, double(a[channel]));
    return std::isinf(positive) ? 0 : positive;
}

}  // namespace

VolumeFrame display_frame(const Scene& scene) {
    const Observer& observer = scene.observer;
    VolumeFrame frame;
    frame.display = observer.display;
    frame.layout = observer.display.layout;
    frame.size = observer.display.voxels;
    frame.world_from_observer = glm::dmat4(observer.world_from_observer);
    frame.world_from_observer[3] = glm::dvec4(observer.position, 1);
    if (frame.layout == VolumeLayout::rays) {
        frame.step = (frame.display.far - frame.display.near) / frame.size.z;
    } else {
        const Bounds bounds = shape_row(frame.display).bounds(frame.display);
        frame.origin = bounds.min;
        frame.edge = (bounds.max - bounds.min) / glm::dvec3(frame.size);
    }
    return frame;
}

DisplaySteps display_steps(const VolumeFrame& frame, const Medium& medium) {
    return {float(frame.step), float(1 / frame.step), frame.size.z,
            float(covering_absorption(medium))};
}

DisplayLattice display_lattice(const VolumeFrame& frame, const GridFrame& world) {
    const glm::dmat4& map = frame.world_from_observer;
    const auto direction = [&](int axis) {
        return glm::dvec3(map[axis]) * frame.edge[axis] / world.voxel_edge;
    };
    const Display& display = frame.display;
    const glm::dvec3 origin =
        (glm::dvec3(map * glm::dvec4(frame.origin, 1)) - world.origin) / world.voxel_edge;
    const glm::dmat3 rows =
        glm::transpose(glm::inverse(glm::dmat3(direction(0), direction(1), direction(2))));
    const auto row = [&](int axis) {
        float4 result = to_float4(rows[axis]);
        result.w = float(-glm::dot(rows[axis], origin));
        return result;
    };
    DisplayLattice lattice{};
    lattice.origin = to_float4(origin);
    lattice.row_x = row(0);
    lattice.row_y = row(1);
    lattice.row_z = row(2);
    lattice.axis_x = to_float4(direction(0));
    lattice.axis_y = to_float4(direction(1));
    lattice.axis_z = to_float4(direction(2));
    lattice.corner = to_float4(frame.origin);
    lattice.edge = to_float4(frame.edge);
    lattice.size_x = frame.size.x;
    lattice.size_y = frame.size.y;
    lattice.size_z = frame.size.z;
    const DisplayShapeRow& shape = shape_row(display);
    lattice.shape = shape.kernel_number;
    const glm::dvec2 slopes = shape.clip_slopes(display);
    lattice.slope_x = float(slopes.x);
    lattice.slope_y = float(slopes.y);
    lattice.near_depth = float(display.near);
    lattice.far_depth = float(display.far);
    lattice.cylinder = display.cylinder ? 1 : 0;
    return lattice;
}

CoverAxes cover_axes(const Display& display) {
    switch (display.seen_along) {
        case SeenAlong::observer:
            return shape_row(display).projection == SightProjection::parallel ? CoverAxes::z
                                                                              : CoverAxes::oblique;
        case SeenAlong::facing:
            return CoverAxes::all;
        case SeenAlong::x:
            return CoverAxes::x;
        case SeenAlong::y:
            return CoverAxes::y;
        case SeenAlong::z:
            break;
    }
    return CoverAxes::z;
}

}  // namespace voxelume
