// SPDX-License-Identifier: Apache-2.0
// An array of values -> the density of a medium, or the values that a transfer function takes.
#pragma once

#include <glm/mat4x4.hpp>
#include <memory>

#include "runtime/grid/density_field.hpp"
#include "runtime/io/arrays/cell_array.hpp"

namespace voxelume {

/// Reads an array of values whose position in the world is that of its file, moved by
/// `world_from_array`. Between the middles of cells, values are trilinear; in the outer halves of
/// the outer cells, they equal those of the middles; beyond the array and where values aren't
/// finite, there are none. Throws Error::input for a file that is truncated or damaged, for
/// colours, and for more than 2^28 cells, and Error::limit for more values than main_memory() has
/// room for.
std::unique_ptr<DensityField> read_array_density(const CellArray& array,
                                                 const glm::dmat4& world_from_array);

}  // namespace voxelume
