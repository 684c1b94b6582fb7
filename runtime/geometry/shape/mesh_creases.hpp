// SPDX-License-Identifier: Apache-2.0
// mesh -> where its faces turn sharply.
#pragma once

#include <limits>

#include "runtime/geometry/mesh.hpp"

namespace voxelume {

/// Sharp edges that follow each other are a crease where they are together at least this long,
/// as a part of the mesh's longest side. The noise of scanned meshes has shorter ones.
inline constexpr double kCreaseShare = 0.1;

/// Rounded edges are looked for whose turn is sharp within this part of the longest side: in
/// coarser voxels a mesh has no more shape than its box.
inline constexpr double kRoundShare = 1.0 / 8;

/// The creases of a mesh, in metres.
struct MeshCreases {
    /// The length of edges at which two faces turn by kSharpAngle or more, or at which more than
    /// two meet.
    double length = 0;
    /// The smallest width within which enough of the mesh's edges turn by kSharpAngle, as rounded
    /// ones do; infinity if there is none, and if `length` is enough.
    double round_width = std::numeric_limits<double>::infinity();
    /// The length of the creases of that width; the edges along a rounded one count as one.
    double round_length = 0;
};

/// The length of all creases, and the smallest width at which they are longer than `enough` metres.
/// A crease goes on where it turns least, by at most 60 degrees, and ends elsewhere. MeshEdges
/// tells which edges there are, turn_around() where they are rounded.
MeshCreases creases_of(const Mesh& mesh, double enough);

}  // namespace voxelume
