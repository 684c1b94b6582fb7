// SPDX-License-Identifier: Apache-2.0
#include "runtime/scene/parts/framing.hpp"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

namespace voxelume {
namespace {

/// The maximum forward position of an observer who sees all of a box along one axis of the image. A
/// point at `u` across and `z` ahead is visible where |u - position| <= slope * (z - depth), for
/// some position.
double largest_depth(const Bounds& box, const glm::dvec3& across, const glm::dvec3& ahead,
                     double slope) {
    double left = -INFINITY, right = -INFINITY;
    for (int i = 0; i < 8; ++i) {
        const glm::dvec3 p = corner(box, i);
        const double u = glm::dot(across, p), z = slope * glm::dot(ahead, p);
        left = std::max(left, -u - z);
        right = std::max(right, u - z);
    }
    return -(left + right) / (2 * slope);
}

/// The position across at which a box, all of which lies beyond `depth`, extends equally far to
/// both sides of the image.
double middle_position(const Bounds& box, const glm::dvec3& across, const glm::dvec3& ahead,
                       double depth) {
    const auto u = [&](int i) { return glm::dot(across, corner(box, i)); };
    double low = u(0), high = u(0);
    for (int i = 1; i < 8; ++i) {
        low = std::min(low, u(i));
        high = std::max(high, u(i));
    }
    for (int step = 0; step < 60; ++step) {
        const double middle = (low + high) / 2;
        double left = -INFINITY, right = -INFINITY;
        for (int i = 0; i < 8; ++i) {
            const double z = glm::dot(ahead, corner(box, i)) - depth;
            left = std::max(left, (middle - u(i)) / z);
            right = std::max(right, (u(i) - middle) / z);
        }
        (right > left ? low : high) = middle;
    }
    return (low + high) / 2;
}

}  // namespace

glm::dmat3 view_axes(const ViewFrom& from) {
    const double longitude = glm::radians(from.longitude), latitude = glm::radians(from.latitude);
    const glm::dvec3 z(-std::sin(longitude) * std::cos(latitude), -std::sin(latitude),
                       -std::cos(longitude) * std::cos(latitude));
    // Views along Y work, too; a cross product with Y would vanish for these.
    const glm::dvec3 x(-std::cos(longitude), 0, std::sin(longitude));
    return {x, glm::cross(z, x), z};
}

glm::dvec3 framing_position(const Bounds& box, const glm::dmat3& axes, const glm::dvec2& slopes) {
    const double depth = std::min(largest_depth(box, axes[0], axes[2], slopes.x),
                                  largest_depth(box, axes[1], axes[2], slopes.y));
    return axes * glm::dvec3(middle_position(box, axes[0], axes[2], depth),
                             middle_position(box, axes[1], axes[2], depth), depth);
}

Bounds extent_along(const Bounds& box, const glm::dmat3& axes) {
    Bounds extent{glm::dvec3(INFINITY), glm::dvec3(-INFINITY)};
    for (int i = 0; i < 8; ++i) {
        const glm::dvec3 p = corner(box, i) * axes;  // the axes are the matrix's columns
        extent = {glm::min(extent.min, p), glm::max(extent.max, p)};
    }
    return extent;
}

}  // namespace voxelume
