// SPDX-License-Identifier: Apache-2.0
// Materials of a scene -> those that files of voxels know.
#pragma once

#include <span>
#include <vector>

#include "runtime/io/voxel_art/cube_list.hpp"
#include "runtime/scene/parts/material.hpp"

namespace voxelume {

/// Reduces each material to what shows most: emitted light, glass or metal. An edge of a voxel is
/// `edge` metres in the scene and 1 m in the file. This is the inverse of the import of .vox files.
std::vector<CubeMaterial> cube_materials(std::span<const Material> materials, double edge);

/// True if some material is more than a plain colour.
bool has_more_than_colors(std::span<const CubeMaterial> materials);

}  // namespace voxelume
