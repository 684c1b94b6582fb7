// SPDX-License-Identifier: Apache-2.0
#include "runtime/scene/framing.hpp"

#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

namespace voxelume {
namespace {

/// Where along one axis of the image an observer stands that shows all of a box. A point at `u`
/// across and `z` ahead is shown where |u - place| <= slope * (z - depth).
struct Standpoint {
    double depth;  ///< the largest that shows everything
    double place;  ///< in the middle of the places from which everything is shown
};

Standpoint standpoint(const Bounds& box, const glm::dvec3& across, const glm::dvec3& ahead,
                      double slope) {
    double left = -INFINITY, right = -INFINITY;
    for (int i = 0; i < 8; ++i) {
        const glm::dvec3 p = corner(box, i);
        const double u = glm::dot(across, p), z = slope * glm::dot(ahead, p);
        left = std::max(left, -u - z);
        right = std::max(right, u - z);
    }
    return {-(left + right) / (2 * slope), (right - left) / 2};
}

}  // namespace

glm::dmat3 view_axes(const ViewFrom& from) {
    const double longitude = glm::radians(from.longitude), latitude = glm::radians(from.latitude);
    const glm::dvec3 z(-std::sin(longitude) * std::cos(latitude), -std::sin(latitude),
                       -std::cos(longitude) * std::cos(latitude));
    // Also right for views along Y, where a cross product with Y would vanish.
    const glm::dvec3 x(-std::cos(longitude), 0, std::sin(longitude));
    return {x, glm::cross(z, x), z};
}

glm::dvec3 framing_position(const Bounds& box, const glm::dmat3& axes, const glm::dvec2& slopes) {
    const Standpoint u = standpoint(box, axes[0], axes[2], slopes.x);
    const Standpoint v = standpoint(box, axes[1], axes[2], slopes.y);
    return axes * glm::dvec3(u.place, v.place, std::min(u.depth, v.depth));
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
