// SPDX-License-Identifier: Apache-2.0
// mesh -> where its faces turn sharply.
#pragma once

#include "runtime/geometry/mesh.hpp"

namespace voxelume {

/// The turn of the normal, in degrees, from which on an edge counts as sharp.
inline constexpr double kSharpAngle = 40;

/// The length of all edges, in metres, at which two faces turn by kSharpAngle or more, or at which
/// more than two faces meet. Vertices at one place count as one; sides without length, and faces
/// without area, have no edges.
double sharp_length_of(const Mesh& mesh);

}  // namespace voxelume
