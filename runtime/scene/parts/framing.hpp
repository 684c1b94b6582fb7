// SPDX-License-Identifier: Apache-2.0
// The position of an observer who sees the whole of a box.
#pragma once

#include <glm/mat3x3.hpp>
#include <glm/vec2.hpp>

#include "runtime/scene/parts/bounds.hpp"

namespace voxelume {

/// A direction from the object to the observer.
struct ViewFrom {
    double longitude = 35;  ///< degrees to the right of the front, which faces +Z
    double latitude = 25;   ///< degrees above the horizon, -90..90

    friend bool operator==(const ViewFrom&, const ViewFrom&) = default;
};

/// The part of the image's width or height that the framed box fills at most.
inline constexpr double kFilled = 0.92;

/// The axes X_E, Y_E and Z_E of an observer in this direction.
glm::dmat3 view_axes(const ViewFrom& from);

/// The position of an observer with these axes and a pyramid who sees all of a box as large as
/// possible: `slopes` are the tangents of half the angles that the box may fill.
glm::dvec3 framing_position(const Bounds& box, const glm::dmat3& axes, const glm::dvec2& slopes);

/// The box's extent along each of the axes, from `min` to `max`.
Bounds extent_along(const Bounds& box, const glm::dmat3& axes);

}  // namespace voxelume
