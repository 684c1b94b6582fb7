// SPDX-License-Identifier: Apache-2.0
// array and sides of its cells -> how steep its values are at the surface between them.
#pragma once

#include "runtime/io/arrays/array_sides.hpp"

namespace voxelume {

/// The largest difference between neighbours on both sides of the surface, times the weight of the
/// file's axis along which they lie; 0 without a surface. Reads all values once.
float steepest_step(const CellArray& array, const InputFile& file, const SurfaceValues& values,
                    const ArraySides& sides, const glm::vec3& weight);

}  // namespace voxelume
