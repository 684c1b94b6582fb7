// SPDX-License-Identifier: Apache-2.0
// solids -> whether they have faces in one plane, where they touch or overlap.
#pragma once

#include "runtime/scene/parts/solid.hpp"

namespace voxelume {

/// True if a flat face of one solid continues one of the other, looking to the same side, and the
/// boxes around the two overlap. Both are in one space.
bool have_flush_faces(const Solid& a, const Solid& b);

}  // namespace voxelume
