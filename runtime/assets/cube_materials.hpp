// SPDX-License-Identifier: Apache-2.0
// Materials of a scene -> those that files of voxels know.
#pragma once

#include <span>
#include <vector>

#include "runtime/io/voxel_art/cube_list.hpp"
#include "runtime/scene/parts/material.hpp"

namespace voxelume {

/// What shows most of each material: light that it gives off, glass, or metal. Voxels have edges of
/// `edge` metres, which are 1 m in the file. The inverse of what a .vox is imported as.
std::vector<CubeMaterial> cube_materials(std::span<const Material> materials, double edge);

/// True if one of them is more than a plain colour.
bool has_more_than_colors(std::span<const CubeMaterial> materials);

}  // namespace voxelume
