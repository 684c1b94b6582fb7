// SPDX-License-Identifier: Apache-2.0
// Estimates how much of a lattice a surface takes, from its area alone.
//
// A flat patch whose area vector is (ax, ay, az), in voxels, passes through |ax| + |ay| + |az|
// voxels: the sum of its three shadows on the lattice's planes, in squares. Cells of edge e count
// the same way, over e²; those within a distance b of the patch are 2 b area / e³ more. Curvature
// and edges add lower terms, which are left out. For a patch that runs exactly between voxels, the
// cubes on both sides belong to it; this is left out, too.
//
// A triangle alone meets more voxels. With voxels at random positions the mean number is the volume
// of the Minkowski sum of the triangle and a voxel, which is 1 + the sides of its box + its
// shadows, in voxels. Points and lines are such triangles, without shadows.
#pragma once

#include <algorithm>
#include <glm/common.hpp>
#include <glm/mat4x4.hpp>

#include "runtime/geometry/mesh.hpp"
#include "runtime/geometry/solid/solid_bounds.hpp"
#include "runtime/grid/grid_frame.hpp"
#include "runtime/scene/parts/solid.hpp"

namespace voxelume {

/// The areas of a surface, m², and the sizes of its triangles, if it has any.
struct SurfaceArea {
    glm::dvec3 shadows{0};  ///< sums of the patches' |area vectors|, per axis
    double total = 0;
    double triangles = 0;   ///< their number
    glm::dvec3 widths{0};   ///< sums of the sides of the triangles' boxes, metres
    double half_edges = 0;  ///< half of the sum of the triangles' edges, metres
};

/// An area without a part of it.
inline SurfaceArea without(const SurfaceArea& area, const SurfaceArea& part) {
    return {glm::max(area.shadows - part.shadows, 0.0), std::max(area.total - part.total, 0.0),
            std::max(area.triangles - part.triangles, 0.0),
            glm::max(area.widths - part.widths, 0.0),
            std::max(area.half_edges - part.half_edges, 0.0)};
}

struct MeshAreas {
    SurfaceArea all;
    /// A lower bound of the area that the mesh covers where some triangles coincide, corner by
    /// corner. A hash table finds them; it mistakes few other triangles for duplicates.
    SurfaceArea min;
};
MeshAreas mesh_areas(const Mesh& mesh);

/// The area of a solid after its map: that of its parts' boxes where `clip` doesn't cut them.
SurfaceArea solid_area(const Solid& solid, const glm::dmat4& frame_from_solid,
                       const SolidBounds& clip);

/// A lower bound of a solid's area. For a union, whose parts may lie in each other, it is that of
/// the largest part alone. It is 0 for other combinations and turned shapes.
SurfaceArea min_solid_area(const Solid& solid, const glm::dmat4& frame_from_solid,
                           const SolidBounds& clip);

/// The part of the mesh's area, 0 to 1, that lies in `box` after the map. A triangle counts by the
/// part of its box that lies there.
double part_inside(const Mesh& mesh, const glm::dmat4& box_from_mesh, const SolidBounds& box);

/// The number of voxels and bricks that a surface passes through.
struct SurfaceExtent {
    double voxels = 0;
    double bricks = 0;  ///< within `band` of the surface
    double listed = 0;  ///< pairs of a voxel and a triangle that meets it; voxels without triangles
};

/// The extent of a surface that `frame_from_surface` maps into the space of `frame`. The shadows of
/// a turned surface don't follow from its own shadows. They are taken as the smaller of what its
/// own shadows allow and what patches in all directions have.
SurfaceExtent surface_extent(const SurfaceArea& area, const glm::dmat4& frame_from_surface,
                             const GridFrame& frame, double band);

}  // namespace voxelume
