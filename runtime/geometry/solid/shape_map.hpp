// SPDX-License-Identifier: Apache-2.0
// How an affine map changes an analytic shape: it keeps the shape's kind, or it doesn't.
#pragma once

#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

#include "runtime/scene/parts/solid.hpp"

namespace voxelume {

/// A shape after a linear map, and the space of its distance function.
struct ShapeMap {
    SolidKind kind = SolidKind::sphere;  ///< a sphere may become an ellipsoid, and back
    glm::dvec3 size{0};                  ///< as SolidShape::size
    glm::dmat3 shape_from_frame{1};      ///< map into the space where the distance is evaluated
};

/// Finds the space in which the distance to `frame_from_shape * shape` is best evaluated.
///
/// Where the map keeps the kind (see make_solid_program), shape_from_frame is a rotation or a
/// reflection and the distance is exact. Elsewhere shape_from_frame is the inverse map times the
/// map's smallest singular value.
ShapeMap map_shape(const Solid& shape, const glm::dmat3& frame_from_shape);

/// The smallest factor by which a linear map changes a length.
double smallest_singular_value(const glm::dmat3& map);

}  // namespace voxelume
