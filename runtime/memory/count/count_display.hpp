// SPDX-License-Identifier: Apache-2.0
// scene + world on a counting device -> the memory for its volumetric image.
#pragma once

#include "runtime/memory/count/count_image.hpp"
#include "runtime/memory/count/object_counts.hpp"

namespace voxelume {

/// Makes the device count the buffers that render_volume makes for a world's image, without the
/// world.
///
/// The number of voxels that a display shows follows from the areas of surfaces: a lattice shows as
/// many as a world with voxels of this size has, a ray shows one, and with a medium its steps in
/// the world. Returns that number.
double count_volume(const Device& device, const Scene& scene, const Pyramid& world,
                    const DensityPlan& medium, Estimate estimate);

}  // namespace voxelume
