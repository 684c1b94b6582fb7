// SPDX-License-Identifier: Apache-2.0
// The numbers of a track at a frame, kept to what its value may be.
#pragma once

#include <vector>

#include "runtime/scene/scene_motion.hpp"

namespace voxelume {

/// The numbers of a track at a frame, as values_at() finds them from its keys. A spline that leaves
/// the value's range between keys stays at the end of the range or, where the end itself is no
/// value, at the key that is closest to it.
std::vector<double> values_of(const Track& track, double frame);

}  // namespace voxelume
