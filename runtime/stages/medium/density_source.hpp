// SPDX-License-Identifier: Apache-2.0
// medium -> its density anywhere in the world, from a formula or from a file.
#pragma once

#include <memory>

#include "runtime/grid/density_field.hpp"

namespace voxelume {

/// The density field of a medium that has a density. Reads the file of a grid. Throws Error::input,
/// whose message starts with the place in the scene, for a damaged file or one without a float grid
/// of that name.
std::unique_ptr<DensityField> density_field(const Medium& medium);

/// The values of a grid's file. Throws as density_field does.
std::unique_ptr<DensityField> grid_field(const GridDensity& grid);

}  // namespace voxelume
