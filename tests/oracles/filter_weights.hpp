// SPDX-License-Identifier: Apache-2.0
// Reconstruction filters of width 1, computed from their definitions and integrated by Simpson's
// rule.
#pragma once

#include "runtime/scene/parts/reconstruction_filter.hpp"

namespace voxelume::oracle {

/// The filter's value at `x`. Its integral is 1, and it is 0 outside [-1/2, 1/2].
double filter_density(FilterShape shape, double x);

/// The filter's integral from `low` to `high`.
double filter_weight(FilterShape shape, double low, double high);

}  // namespace voxelume::oracle
