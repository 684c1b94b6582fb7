// SPDX-License-Identifier: Apache-2.0
// Chunks of a .vox file -> the materials of its palette.
#pragma once

#include <array>

#include "runtime/io/voxels/vox_chunks.hpp"
#include "runtime/io/voxels/vox_file.hpp"

namespace voxelume {

/// Takes a material of the current kind, a dictionary, from a chunk MATL.
void take_material(VoxContent& content, std::array<VoxMaterial, 256>& materials);

/// Takes a material of the kind before 2017, a row of numbers, from a chunk MATT.
void take_old_material(VoxContent& content, std::array<VoxMaterial, 256>& materials);

/// The values of a material in a chunk MATL, as take_material reads them; none for a diffuse
/// material.
VoxDictionary values_of(const VoxMaterial& material);

}  // namespace voxelume
