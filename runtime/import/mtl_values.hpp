// SPDX-License-Identifier: Apache-2.0
// MTL material -> the keys of a scene's material.
#pragma once

#include <string>

#include "runtime/io/mesh/material_library.hpp"

namespace voxelume {

/// The members of the scene's material, without braces. A texture gives the mesh's voxels their
/// colours, which the material's colour multiplies.
std::string mtl_values(const MtlMaterial& material);

/// True if light goes through surfaces with the material.
bool mtl_transmits(const MtlMaterial& material);

}  // namespace voxelume
