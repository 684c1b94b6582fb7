// SPDX-License-Identifier: Apache-2.0
// A float grid of an OpenVDB file -> the density of a medium.
#pragma once

#include <memory>

#include "runtime/grid/density_field.hpp"

namespace voxelume {

/// Reads a grid as a density: trilinear between its values, transformed to the world by its own
/// transform and `world_from_grid`. Negative values count as 0.
///
/// Throws Error::input for a file that is missing or that OpenVDB can't read, for a file without a
/// float grid of this name, and for a grid with a value that isn't finite.
std::unique_ptr<DensityField> read_vdb_density(const GridDensity& density);

}  // namespace voxelume
