// Volume and area of what an object's voxels hold, summed in double over the voxels themselves.
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

/// What the surface in a pyramid's only object encloses; cubes must be of the set `solid`.
///
///   cubes   the voxels, and all that can't be reached from outside through faces; their open faces
///   smooth  the zero of the half-Taylor fields, by quadrature of sixth order in every voxel
///   exact   the triangles, or the solid of one shape, as the kernels read them
///
/// `scale` is that from the part's space to the world's. Nothing for worlds so large that it would
/// take longer than rendering them, and for solids of other shapes than sphere, torus and box.
std::optional<Extent> extent_of(const Pyramid& pyramid, Surface surface, double scale);

/// The parts, in voxels of the part's frame.
Extent cubes_extent(const Pyramid& pyramid);
Extent smooth_extent(const Pyramid& pyramid);
std::optional<Extent> exact_extent(const Pyramid& pyramid);

/// Of triangles' corners, three each, turned so that their normals point outwards.
Extent triangles_extent(std::span<const glm::dvec3> corners);

}  // namespace voxelume
