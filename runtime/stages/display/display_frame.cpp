#include "runtime/stages/display/display_frame.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <glm/trigonometric.hpp>
#include <limits>

#include "runtime/opencl/float4.hpp"
#include "runtime/stages/trace/sight.hpp"

namespace voxelume {
namespace {

/// The box around a display's shape, in the observer's coordinates, metres.
Bounds bounds_of(const Display& display) {
    const double far = display.far;
    switch (display.shape) {
        case DisplayShape::pyramid: {
            const glm::dvec2 half = far * glm::tan(display.half_angles);
            return {{-half.x, -half.y, display.near}, {half.x, half.y, far}};
        }
        case DisplayShape::sector: {
            const double angle = display.half_angles.x, cosine = std::cos(angle);
            const double half = cosine > 0 ? far * std::sin(angle) : far;
            return {{-half, -half, cosine * (cosine > 0 ? display.near : far)}, {half, half, far}};
        }
        case DisplayShape::ball:
            return {glm::dvec3(-far), glm::dvec3(far)};
        case DisplayShape::box:
            break;
    }
    const glm::dvec2 half = display.half_size;
    return {{-half.x, -half.y, display.near}, {half.x, half.y, far}};
}

/// The absorption by which voxels of space cover what lies behind: that of the least absorbed
/// channel. If a medium emits light but doesn't absorb all channels, it is the smallest positive
/// absorption.
double covering_absorption(const Medium& medium) {
    const glm::vec3& a = medium.absorption;
    const double minimum = double(std::min({a.x, a.y, a.z}));
    if (minimum > 0 || medium.color == glm::vec3(0)) return minimum;
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
        const Bounds bounds = bounds_of(frame.display);
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
    lattice.shape = shape_number(display.shape);
    if (display.shape == DisplayShape::pyramid) {
        lattice.slope_x = float(std::tan(display.half_angles.x));
        lattice.slope_y = float(std::tan(display.half_angles.y));
    } else if (display.shape == DisplayShape::sector) {
        lattice.slope_x = float(std::cos(display.half_angles.x));
    }
    lattice.near_depth = float(display.near);
    lattice.far_depth = float(display.far);
    lattice.cylinder = display.cylinder ? 1 : 0;
    return lattice;
}

}  // namespace voxelume
