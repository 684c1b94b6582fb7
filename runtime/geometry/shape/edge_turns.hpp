// SPDX-License-Identifier: Apache-2.0
// edges of a mesh -> the width across them within which the surface makes a sharp turn.
#pragma once

#include <limits>

#include "runtime/geometry/shape/mesh_edges.hpp"

namespace voxelume {

/// The turn of the normal, in degrees, at and above which an edge counts as sharp.
inline constexpr double kSharpAngle = 40;

/// The sharpness of a surface's turn around an edge.
struct EdgeTurn {
    /// Metres across the edge in which the surface turns by kSharpAngle; 0 if it does so at the
    /// edge itself.
    double width = std::numeric_limits<double>::infinity();
    double share = 0;  ///< part of the turn; all edges across a rounded one have 1 together
};

/// Follows the surface from the middle of an edge to both sides, in the plane that the edge is
/// perpendicular to, over at most `reach` metres or 32 edges. Turns have signs, and within four
/// widths to each side the surface must bend to one side alone but for a tenth: beyond a rounded
/// edge it is flat, where scans have bumps and dents. The share is measured against the turn in
/// 2.25 widths, as a right angle has 2.25 times 40 degrees.
EdgeTurn turn_around(const MeshEdges& edges, const MeshEdge& edge, double reach);

}  // namespace voxelume
