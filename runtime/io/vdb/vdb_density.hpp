// A float grid of an OpenVDB file -> the density of a medium.
#pragma once

#include <memory>

#include "runtime/grid/density_field.hpp"

namespace voxelume {

/// Reads a grid: trilinear between its values, carried into the world by its own transform and
/// `world_from_grid`; negative values count as 0.
///
/// Throws Error::input for a file that is missing or that OpenVDB can't read, that has no float
/// grid of the name, or a value that is no finite number.
std::unique_ptr<DensityField> read_vdb_density(const GridDensity& density);

}  // namespace voxelume
