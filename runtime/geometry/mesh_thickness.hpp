// SPDX-License-Identifier: Apache-2.0
// mesh -> how thick its body is, measured on lines along the axes.
#pragma once

#include "runtime/geometry/mesh.hpp"

namespace voxelume {

/// The shares of its area by which a body counts as thin, has a thin part, or may have a thin part.
inline constexpr double kThinShare = 0.02, kThinPartShare = 0.002, kThinHintShare = 0.0002;

/// The thickness that all of a mesh's area but a small share has behind it, metres.
struct MeshThickness {
    double body = 0;   ///< for all area but kThinShare
    double part = 0;   ///< for all area but kThinPartShare
    double hint = 0;   ///< for all area but kThinHintShare, if only walls count; see Chord
    double sheet = 0;  ///< for all area but kThinPartShare, if only sheets count
};

/// The thickness that a closed mesh's area has behind it. A regular lattice of 64 x 64 lines along
/// each axis crosses the mesh. Where a line enters through a face that turns to it more than to the
/// other axes, the thickness is the way to the exit times the cosine of the angle: at least a third
/// of that of a ball, and exactly that of a plate away from its rim. Open meshes have some number,
/// and meshes of which 1,024 faces lie before one another nearly everywhere have 0. Sums are in the
/// order of the triangles, so equal meshes give equal numbers.
MeshThickness thickness_of(const Mesh& mesh);

/// The thickness of the mesh scaled by this factor.
MeshThickness scaled(const MeshThickness& t, double scale);

}  // namespace voxelume
