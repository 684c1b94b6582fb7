// SPDX-License-Identifier: Apache-2.0
// Grids and pyramids as kernels take them.
#pragma once

#include "kernels/shared/scene.h"
#include "runtime/grid/grid.hpp"
#include "runtime/opencl/program.hpp"

namespace voxelume {

/// The pyramid's shape as kernels take it: its size, edges, and the fixed point of rays through it.
PyramidShape shape_of(const Pyramid& pyramid);

/// VXL_BRICK_GRID_PARAMETERS of kernels: the sizes, and every buffer but those of the primitives
/// themselves.
void bind(KernelArguments& to, const BrickGrid& grid);

/// VXL_WORLD_PARAMETERS of kernels: the shape, every buffer, and the instances' buffers.
void bind(KernelArguments& to, const Pyramid& pyramid);

}  // namespace voxelume
