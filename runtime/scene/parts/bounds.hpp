// SPDX-License-Identifier: Apache-2.0
// Boxes along the axes.
#pragma once

#include <algorithm>
#include <cmath>
#include <glm/vec3.hpp>

namespace voxelume {

/// An axis-aligned box; `min < max` on every axis unless said otherwise.
struct Bounds {
    glm::dvec3 min{0};
    glm::dvec3 max{0};

    friend bool operator==(const Bounds&, const Bounds&) = default;
};

/// The empty box: min > max, so that the first point by which it is widened becomes both corners.
inline const Bounds kEmptyBounds{glm::dvec3(INFINITY), glm::dvec3(-INFINITY)};

/// The length of the box's longest side.
inline double longest_side(const Bounds& bounds) {
    const glm::dvec3 size = bounds.max - bounds.min;
    return std::max({size.x, size.y, size.z});
}

/// A corner of the box; bits 0, 1 and 2 of `number`, 0..7, choose max over min on x, y and z.
inline glm::dvec3 corner(const Bounds& bounds, int number) {
    return {(number & 1 ? bounds.max : bounds.min).x, (number & 2 ? bounds.max : bounds.min).y,
            (number & 4 ? bounds.max : bounds.min).z};
}

}  // namespace voxelume
