// SPDX-License-Identifier: Apache-2.0
// mesh -> whether a distance field shows it rightly, and why not: what `"surface": "auto"` asks.
#pragma once

#include <string>

#include "runtime/geometry/mesh_creases.hpp"
#include "runtime/geometry/mesh_summary.hpp"
#include "runtime/geometry/mesh_thickness.hpp"
#include "runtime/geometry/thin_part.hpp"
#include "runtime/scene/parts/surface.hpp"

namespace voxelume {

/// Creases make a mesh sharp-edged that together are longer than this many times the side of a
/// square with the mesh's area. A cube has 4.9, a cone 2, and scanned meshes up to 0.4 by their
/// noise.
inline constexpr double kSharpShare = 0.7;

/// Small parts of one are lost or shredded below this many.
inline constexpr double kThinPartVoxels = 1;

/// A mesh of which more of the area lies around thin parts is exact as a whole.
inline constexpr double kMaxThinShare = 0.5;

/// What is asked of a mesh besides its summary.
struct MeshShape {
    double sharp_length = 0;  ///< metres, of sharp_length_of(); below 0 if it isn't measured
    MeshThickness thickness;
};

MeshShape shape_of(const Mesh& mesh);

/// True if so many of its edges are sharp that chords next to them say nothing of thin parts.
bool has_sharp_edges(const MeshSummary& mesh, const MeshShape& shape);

/// A surface with the reason for it, as the second half of a sentence.
struct SurfaceChoice {
    Surface surface = Surface::smooth;
    std::string reason;
    bool may_be_thin = false;  ///< it hangs on how much of the mesh is thin
};

/// `smooth` for a mesh with an inside and without sharp edges that is at least kThinVoxels thick,
/// and its parts kThinPartVoxels, else `exact`. `voxel_edge` is that of the voxels that would hold
/// its distances, metres in the space of the mesh.
SurfaceChoice surface_for(const MeshSummary& mesh, const MeshShape& shape, double voxel_edge);

/// What becomes of a choice that hangs on thin parts, of which `part` tells: `smooth` where they
/// are at most kMaxThinShare of the area, and then they are exact.
SurfaceChoice surface_with(const SurfaceChoice& choice, const MeshSummary& mesh,
                           const MeshSummary& part);

}  // namespace voxelume
