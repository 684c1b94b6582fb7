// How much of a lattice a surface takes, told from its area alone.
//
// A flat patch whose area vector is (ax, ay, az), in voxels, passes through |ax| + |ay| + |az|
// voxels: as many as its three shadows on the lattice's planes have squares. Cells of edge e count
// the same way, over e²; those within a distance b of the patch are 2 b area / e³ more. Curvature
// and edges add lower terms, which are left out, and so is that cubes on both sides of a patch that
// runs exactly between them belong to it.
#pragma once

#include <glm/mat4x4.hpp>

#include "runtime/geometry/mesh.hpp"
#include "runtime/geometry/solid_bounds.hpp"
#include "runtime/grid/grid_frame.hpp"
#include "runtime/scene/solid.hpp"

namespace voxelume {

/// Areas of a surface, m².
struct SurfaceArea {
    glm::dvec3 shadows{0};  ///< sums of the patches' |area vectors|, per axis
    double total = 0;
};

SurfaceArea mesh_area(const Mesh& mesh);

/// No more than the mesh's triangles cover where some lie on one another, corner by corner: by a
/// table that takes few of the others for such, too.
SurfaceArea min_mesh_area(const Mesh& mesh);

/// Of a solid after its map: the area of its parts' boxes where they aren't cut by `clip`.
SurfaceArea solid_area(const Solid& solid, const glm::dmat4& frame_from_solid,
                       const SolidBounds& clip);

/// No more than it has: of a union's parts, which may lie in each other, the largest alone; nothing
/// of other combinations and turned shapes.
SurfaceArea min_solid_area(const Solid& solid, const glm::dmat4& frame_from_solid,
                           const SolidBounds& clip);

/// The part of the mesh's area whose triangles' boxes lie in `box` after the map.
double part_inside(const Mesh& mesh, const glm::dmat4& box_from_mesh, const SolidBounds& box);

/// Voxels and bricks that a surface passes through.
struct SurfaceExtent {
    double voxels = 0;
    double bricks = 0;  ///< within `band` of the surface
};

/// For a surface that `frame_from_surface` maps into the space of `frame`. A turned surface's
/// shadows aren't known from its own: they are the smaller of what its shadows allow and what
/// patches in all directions have.
SurfaceExtent surface_extent(const SurfaceArea& area, const glm::dmat4& frame_from_surface,
                             const GridFrame& frame, double band);

}  // namespace voxelume
