// SPDX-License-Identifier: Apache-2.0
// Voxels of materials -> voxels in those materials' colours, for files that have colours alone.
#pragma once

#include <span>

#include "runtime/geometry/voxel_model.hpp"
#include "runtime/scene/parts/material.hpp"

namespace voxelume {

/// Multiplies the colours of cubes by those of their materials, which are numbered as in the
/// model's attributes; `attribute` is that of all voxels of a model without. Their opacities are
/// multiplied, too, and what is then less than 1/510 opaque is no voxel any more. The attributes go
/// on telling the materials.
void paint_voxels(std::span<const Material> materials, uint32_t attribute, VoxelModel& model);

}  // namespace voxelume
