// SPDX-License-Identifier: Apache-2.0
// mesh -> where its faces turn sharply.
#pragma once

#include "runtime/geometry/mesh.hpp"

namespace voxelume {

/// The turn of the normal, in degrees, from which on an edge counts as sharp.
inline constexpr double kSharpAngle = 40;

/// Sharp edges that follow each other are a crease where they are together at least this long,
/// as a part of the mesh's longest side. The noise of scanned meshes has shorter ones.
inline constexpr double kCreaseShare = 0.1;

/// The length of all creases, in metres: of edges at which two faces turn by kSharpAngle or more,
/// or at which more than two faces meet. A crease goes on where it turns least, by 60 degrees at
/// most, and ends elsewhere. Vertices at one place count as one; sides without length, and faces
/// without area, have no edges.
double sharp_length_of(const Mesh& mesh);

}  // namespace voxelume
