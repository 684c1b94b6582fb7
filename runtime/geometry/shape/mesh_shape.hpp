// SPDX-License-Identifier: Apache-2.0
// mesh -> whether a distance field shows it rightly, and why not: what `"surface": "auto"` asks.
#pragma once

#include <string>

#include "runtime/geometry/mesh_summary.hpp"
#include "runtime/geometry/mesh_thickness.hpp"
#include "runtime/geometry/shape/mesh_creases.hpp"
#include "runtime/geometry/thin_part.hpp"
#include "runtime/scene/parts/surface.hpp"

namespace voxelume {

/// Creases make a mesh sharp-edged that together are longer than this many times the side of a
/// square with the mesh's area. A cube has 4.9, a cone 2, and scanned meshes up to 0.5 by their
/// noise.
inline constexpr double kSharpShare = 0.7;

/// Small parts of one are lost or shredded below this many.
inline constexpr double kThinPartVoxels = 1;

/// A mesh of which more of the area lies around thin parts is exact as a whole. Where a third does,
/// pictures take less time than those of triangles alone, and where half does, more.
inline constexpr double kMaxThinShare = 0.35;

/// What is asked of a mesh besides its summary.
struct MeshShape {
    MeshCreases creases;  ///< their length is below 0 if they aren't measured
    MeshThickness thickness;
};

MeshShape shape_of(const Mesh& mesh);

/// The shape of a mesh that is this many times as large.
MeshShape scaled(const MeshShape& shape, double scale);

/// True if distances would bead the mesh's edges, as many of them are sharp or rounded within a
/// voxel. Chords next to them say nothing of thin parts.
bool has_sharp_edges(const MeshSummary& mesh, const MeshShape& shape, double voxel_edge);

/// A surface with the reason for it, as the second half of a sentence.
struct SurfaceChoice {
    Surface surface = Surface::smooth;
    std::string reason;
    bool may_be_thin = false;  ///< parts may be too thin for `smooth`, for surface_with; what that
                               ///< returns is smooth and has such parts, which are exact
};

/// `smooth` for a mesh with an inside and without sharp edges that is at least kThinVoxels thick,
/// and its parts kThinPartVoxels, else `exact`. `voxel_edge` is that of the voxels that would hold
/// its distances, metres in the space of the mesh.
SurfaceChoice surface_for(const MeshSummary& mesh, const MeshShape& shape, double voxel_edge);

/// Why parts of a mesh may not be exact next to a field, where that is left out: its outermost
/// voxels have neither colours nor groups in the world. Empty if they may.
std::string refusal_of_parts(const MeshSummary& mesh);

/// What becomes of a choice for a mesh whose parts may be too thin. `part` is the mesh around the
/// thin walls: it alone is exact if it has at most kMaxThinShare of the area and no `refusal` says
/// why not, else all is. Without such walls the choice stays.
SurfaceChoice surface_with(const SurfaceChoice& choice, const MeshSummary& mesh,
                           const MeshSummary& part, const std::string& refusal);

}  // namespace voxelume
