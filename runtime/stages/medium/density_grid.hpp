// SPDX-License-Identifier: Apache-2.0
// The medium's density at every voxel of S, on a device: bricks of 16³, where bricks of constant
// density take no cells.
#pragma once

#include "kernels/shared/medium.h"
#include "runtime/grid/grid.hpp"
#include "runtime/opencl/buffer.hpp"
#include "runtime/opencl/program.hpp"
#include "runtime/scene/scene.hpp"

namespace voxelume {

/// The density grid that kernels read with lib/traverse/density.h.
struct DensityGrid {
    DensityShape shape{};
    Buffer<uint32_t> bricks;  ///< shared/medium.h has the words
    Buffer<float> values;     ///< 4096 per slot; constant densities share the first slots
    Buffer<float> colors;     ///< three for each value, where the medium has a transfer function
};

/// VXL_DENSITY_PARAMETERS of kernels.
void bind(KernelArguments& to, const DensityGrid& grid);

/// The numbers of entries in a density grid's buffers.
struct DensitySize {
    size_t slots = 0;   ///< slots of values
    size_t bricks = 0;  ///< bricks of the lattice
    bool has_colors = false;
};

/// The size of a density grid, found without allocating it.
struct DensityPlan {
    glm::ivec3 bricks{0};  ///< bricks of the lattice
    bool is_zero = false;  ///< known to be 0 everywhere: no grid is made
    DensitySize size = {};
    double stored_bricks = 0;  ///< maximum number, without constants
    double buffer_bytes = 0;   ///< bytes of the larger buffer
    double bytes = 0;          ///< on the device
    double host_bytes = 0;     ///< in main memory while it is made
};

/// The plan of the medium's density grid; empty for a medium without density, and for one that
/// neither absorbs nor `scatters` light. Reads the file of a grid.
///
/// Throws Error::input, whose message starts with the place in the scene, for a damaged file or one
/// without a float grid of that name; Error::limit for more bricks than can be numbered.
DensityPlan plan_density(const World& world, bool scatters = false);

/// The grid's buffers.
DensityGrid allocate_density(const Device& device, const DensitySize& size);

/// True if the medium's density is known to be 0 at all voxels without evaluating them, as for a
/// file of zeros. Throws Error::input as plan_density.
bool has_no_medium(const World& world);

/// Makes the density's lattice. A voxel has the density at its centre or, with a transfer function,
/// the mean over the voxel, lit by `lights` where the scene lights it. Throws as plan_density does.
DensityGrid form_density_grid(const Device& device, const World& world,
                              const std::vector<Light>& lights = {});

}  // namespace voxelume
