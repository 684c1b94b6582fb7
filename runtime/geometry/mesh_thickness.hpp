// SPDX-License-Identifier: Apache-2.0
// mesh -> how thick its body is, measured on lines along the axes.
#pragma once

#include "runtime/geometry/mesh.hpp"

namespace voxelume {

/// The shares of its area by which a body counts as thin, by which it has a part that does, and by
/// which it may have one.
inline constexpr double kThinShare = 0.02, kThinPartShare = 0.002, kThinHintShare = 0.0002;

/// Metres.
struct MeshThickness {
    double body = 0;   ///< what all but kThinShare of the area has behind it
    double part = 0;   ///< what all but kThinPartShare has
    double hint = 0;   ///< what all but kThinHintShare has, if only walls count; see Chord
    double sheet = 0;  ///< what all but kThinPartShare has, if only sheets count
};

/// The thickness that a closed mesh's area has behind it. A
/// regular lattice of 64 x 64 lines along each axis crosses it. Where a line enters through a face
/// that turns to it more than to the other axes, the way to the exit is the body's thickness times
/// the cosine of the angle, at least a third of that of a ball, and exactly that of a plate away
/// from its rim. Open meshes have some number, and those of which 1,024 faces lie before one
/// another nearly everywhere have 0. Sums are in the order of the triangles, so equal
/// meshes give equal numbers.
MeshThickness thickness_of(const Mesh& mesh);

/// The thickness of a mesh that is this many times as large.
MeshThickness scaled(const MeshThickness& t, double scale);

}  // namespace voxelume
