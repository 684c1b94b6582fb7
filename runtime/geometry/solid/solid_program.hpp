// SPDX-License-Identifier: Apache-2.0
// solid -> the list of shapes that kernels evaluate (shared/solid.h)
#pragma once

#include <glm/mat3x3.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>

#include <cstdint>
#include <span>
#include <vector>

#include "kernels/shared/solid.h"
#include "runtime/grid/grid.hpp"
#include "runtime/scene/parts/solid.hpp"

namespace voxelume {

/// A shape of a program as the user stated it. Exact decisions are made on it.
struct SourceShape {
    Solid solid;           ///< kind and parameters; no parts
    glm::dmat3 linear{1};  ///< a voxel index x lies at linear * x + offset, metres in the
    glm::dvec3 offset{0};  ///< shape's own space, as stated (not the device's shape space)
    bool is_complement = false;
    uint32_t operations = 0;  ///< as SolidShape::operations
};

/// A solid in a grid's voxels. The two lists describe the same shapes in the same order.
struct SolidProgram {
    std::vector<SolidShape> shapes;
    std::vector<SourceShape> sources;

    /// The shape records as the 32-bit words of BrickGrid::solids.
    std::span<const uint32_t> words() const;
};

/// Lays a tree of solids out as a program in the voxels of `frame`.
///
/// Differences become intersections with complements. A shape keeps its exact distance when the map
/// onto the grid's space keeps its kind: any map for sphere, ellipsoid and slab; turns and scales
/// along its axes for box; turns and scales that keep it round for cylinder and cone; turns and
/// uniform scales for torus and capsule. Otherwise distances are scaled down by the map's smallest
/// singular value, so that they never exceed the true ones. Throws Error::limit when a shape's
/// centre is more than 2^24 voxels from the grid's origin. With `is_complement` the program
/// describes all that lies outside of the solid.
SolidProgram make_solid_program(const Solid& solid, const glm::dmat4& frame_from_solid,
                                const GridFrame& frame, bool is_complement = false);

}  // namespace voxelume
