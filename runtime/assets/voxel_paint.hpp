// SPDX-License-Identifier: Apache-2.0
// Voxels of materials -> voxels in those materials' colours, for files that have colours alone.
#pragma once

#include <span>

#include "runtime/geometry/voxel_model.hpp"
#include "runtime/scene/parts/material.hpp"

namespace voxelume {

/// Multiplies the colours of cubes by those of their materials, which are numbered as in the
/// model's attributes; `attribute` is the value for all voxels of a model without attributes.
/// Opacities are multiplied, too, and voxels that are then less than 1/510 opaque disappear. The
/// attributes still tell the materials.
void paint_voxels(std::span<const Material> materials, uint32_t attribute, VoxelModel& model);

}  // namespace voxelume
