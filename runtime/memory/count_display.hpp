// SPDX-License-Identifier: Apache-2.0
// scene + world on a counting device -> what rendering its volumetric image takes there.
#pragma once

#include "runtime/memory/count_image.hpp"
#include "runtime/memory/object_counts.hpp"

namespace voxelume {

/// Has the device count all that render_volume's image of a world takes, without the world.
/// `depth` is that of the arrays for reflections and refractions.
///
/// Of the voxels that a display shows, surfaces' areas tell: those of a lattice as many as of a
/// world of such voxels, of each ray one, and with a medium all before the far end.
void count_volume(const Device& device, const Scene& scene, const Pyramid& world,
                  const DensityPlan& medium, Estimate estimate);

}  // namespace voxelume
