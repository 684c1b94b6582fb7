// SPDX-License-Identifier: Apache-2.0
// mesh -> whether a distance field shows it correctly, or why not; this decides `"surface":
// "auto"`.
#pragma once

#include <string>

#include "runtime/geometry/mesh_summary.hpp"
#include "runtime/geometry/mesh_thickness.hpp"
#include "runtime/geometry/shape/mesh_creases.hpp"
#include "runtime/geometry/thin_part.hpp"
#include "runtime/scene/parts/surface.hpp"

namespace voxelume {

/// A mesh is sharp-edged if its creases together are longer than this many times the side of a
/// square with the mesh's area. A cube has 4.9, a cone 2, and scanned meshes up to 0.5 by their
/// noise.
inline constexpr double kSharpShare = 0.7;

/// Small parts of a mesh that are thinner than this many voxels are lost or shredded.
inline constexpr double kThinPartVoxels = 1;

/// A mesh is exact as a whole if more than this share of its area lies around thin parts. With a
/// third, pictures take less time than those of triangles alone, and with half, more.
inline constexpr double kMaxThinShare = 0.35;

/// The properties of a mesh that surface_for needs besides its summary.
struct MeshShape {
    MeshCreases creases;  ///< their length is below 0 if they aren't measured
    MeshThickness thickness;
};

MeshShape shape_of(const Mesh& mesh);

/// The shape of the mesh scaled by this factor.
MeshShape scaled(const MeshShape& shape, double scale);

/// True if distances would bead the mesh's edges, because many of them are sharp or rounded within
/// a voxel. Chords next to them say nothing of thin parts.
bool has_sharp_edges(const MeshSummary& mesh, const MeshShape& shape, double voxel_edge);

/// A surface with the reason for it, as the second half of a sentence.
struct SurfaceChoice {
    Surface surface = Surface::smooth;
    std::string reason;
    bool may_be_thin = false;  ///< parts may be too thin for `smooth`, so surface_with is to be
                               ///< called; in its result: smooth with such parts, which are exact
};

/// `smooth` for a mesh that has an inside and no sharp edges, is at least kThinVoxels thick, and
/// has parts at least kThinPartVoxels thick; else `exact`. `voxel_edge` is the edge of the voxels
/// that would hold its distances, metres in the space of the mesh.
SurfaceChoice surface_for(const MeshSummary& mesh, const MeshShape& shape, double voxel_edge);

/// The reason why parts of a mesh can't be exact next to a field; empty if they can. In the world
/// the outermost voxels of such a field have neither colours nor groups.
std::string refusal_of_parts(const MeshSummary& mesh);

/// The final choice for a mesh whose parts may be too thin. `part` is the mesh around the thin
/// walls: it alone is exact if it has at most kMaxThinShare of the area and `refusal` is empty,
/// else the whole mesh is. Without thin walls the choice stays.
SurfaceChoice surface_with(const SurfaceChoice& choice, const MeshSummary& mesh,
                           const MeshSummary& part, const std::string& refusal);

}  // namespace voxelume
