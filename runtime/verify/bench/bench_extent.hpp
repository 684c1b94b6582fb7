// SPDX-License-Identifier: Apache-2.0
// Volume and area of what an object's voxels enclose, summed in double over the voxels themselves.
#pragma once

#include <glm/vec3.hpp>
#include <optional>
#include <span>

#include "runtime/grid/grid.hpp"

namespace voxelume {

struct Extent {
    double volume = 0;  ///< cubic metres
    double area = 0;    ///< square metres
};

/// The volume and area that the surface in a pyramid's only object encloses. Cubes have to be of
/// the set `solid`. What is measured:
///
///   cubes   the voxels, and all cells that can't be reached from outside through faces; their open
///           faces
///   smooth  the zero of the half-Taylor fields, by quadrature of sixth order in every voxel
///   exact   the triangles, or the solid of one shape, as the kernels read them
///
/// `scale` converts lengths of the part's space to the world's. Empty for worlds so large that this
/// would take longer than rendering them, and for solids of other shapes than sphere, torus and
/// box.
std::optional<Extent> extent_of(const Pyramid& pyramid, Surface surface, double scale);

/// The extents by surface, in voxels of the part's frame.
Extent cubes_extent(const Pyramid& pyramid);
Extent smooth_extent(const Pyramid& pyramid);
std::optional<Extent> exact_extent(const Pyramid& pyramid);

/// The extent of triangles by their corners, three each, with normals that point outwards.
Extent triangles_extent(std::span<const glm::dvec3> corners);

}  // namespace voxelume
