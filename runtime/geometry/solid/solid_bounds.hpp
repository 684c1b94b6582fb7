// SPDX-License-Identifier: Apache-2.0
// solid -> the smallest box around it that its kinds allow to compute, and a grid over that box
#pragma once

#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <optional>

#include "runtime/grid/grid_frame.hpp"
#include "runtime/scene/parts/solid.hpp"

namespace voxelume {

/// An axis-parallel box, metres; empty where min exceeds max on any axis.
struct SolidBounds {
    glm::dvec3 min{0};
    glm::dvec3 max{0};

    bool is_empty() const;
};

/// The box around `frame_from_solid * solid`, exact for one shape, an outer bound for combinations.
///
/// The part outside of `clip` is left out. Throws Error::scene when the box is infinite: a slab
/// needs a clip box on the axes along which it extends.
SolidBounds bounds(const Solid& solid, const glm::dmat4& frame_from_solid,
                   const std::optional<SolidBounds>& clip = std::nullopt);

/// True if a part of the solid's box, exact or an outer bound as in bounds(), lies outside of
/// `box`.
bool reaches_past(const Solid& solid, const glm::dmat4& frame_from_solid, const SolidBounds& box);

/// The grid over the solid with at least `margin` empty voxels on every side. Its planes lie at
/// whole multiples of `voxel_edge`.
///
/// A smooth surface needs the margin of 4 for its differences. At a clip box the grid ends without
/// margin. Throws Error::scene for a solid that is infinite or wholly outside of `clip`, and
/// Error::limit for a grid with more than 2^22 voxels along an axis.
GridFrame frame_around(const Solid& solid, const glm::dmat4& frame_from_solid,
                       const glm::dvec3& voxel_edge, int margin = 4,
                       const std::optional<SolidBounds>& clip = std::nullopt);

}  // namespace voxelume
