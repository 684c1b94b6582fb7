// SPDX-License-Identifier: Apache-2.0
// The numbers of a track at a frame, limited to the value's range.
#pragma once

#include <vector>

#include "runtime/scene/scene_motion.hpp"

namespace voxelume {

/// The numbers of a track at a frame, as values_at() computes them from its keys. If a spline
/// leaves the value's range between keys, it is clamped to the end of the range or, if the end
/// isn't a valid value, to the closest key.
std::vector<double> values_of(const Track& track, double frame);

}  // namespace voxelume
