// medium -> its density anywhere in the world, from a formula or from a file.
#pragma once

#include <memory>

#include "runtime/grid/density_field.hpp"

namespace voxelume {

/// The field of a medium that has a density. Reads the file of a grid; throws Error::input, opened
/// by the place in the scene, for a damaged file or one without a float grid of the name.
std::unique_ptr<DensityField> density_field(const Medium& medium);

}  // namespace voxelume
