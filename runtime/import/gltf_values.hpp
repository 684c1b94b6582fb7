// SPDX-License-Identifier: Apache-2.0
// A material of a glTF file -> the keys of a scene's material.
#pragma once

#include <string>

#include "runtime/io/gltf/gltf_file.hpp"

namespace voxelume {

/// The keys of the scene's material, without braces; see gltf_unlit_materials() on `is_unlit`. The
/// scene shows the file enlarged by `scale`.
std::string gltf_values(const GltfValue& material, bool is_unlit, double scale = 1);

/// True if the material's base colour isn't black.
bool gltf_has_color(const GltfValue& material);

/// True if the material has an emission of its own.
bool gltf_shines(const GltfValue& material);

/// True if light goes through surfaces with the material.
bool gltf_transmits(const GltfValue& material);

}  // namespace voxelume
