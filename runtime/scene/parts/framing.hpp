// SPDX-License-Identifier: Apache-2.0
// Where an observer stands who shows the whole of a box.
#pragma once

#include <glm/mat3x3.hpp>
#include <glm/vec2.hpp>

#include "runtime/scene/parts/bounds.hpp"

namespace voxelume {

/// A direction to look from, seen from what is looked at.
struct ViewFrom {
    double longitude = 35;  ///< degrees to the right of the front, which faces +Z
    double latitude = 25;   ///< degrees above the horizon, -90..90

    friend bool operator==(const ViewFrom&, const ViewFrom&) = default;
};

/// The largest share of the image's width or height that what is framed takes.
inline constexpr double kFilled = 0.92;

/// The axes X_E, Y_E and Z_E of an observer who looks from there.
glm::dmat3 view_axes(const ViewFrom& from);

/// The position of an observer with these axes and a pyramid who sees all of a box as large as
/// possible: `slopes` are the tangents of half the angles that the box may fill.
glm::dvec3 framing_position(const Bounds& box, const glm::dmat3& axes, const glm::dvec2& slopes);

/// The box's extent along each of the axes, from `min` to `max`.
Bounds extent_along(const Bounds& box, const glm::dmat3& axes);

}  // namespace voxelume
