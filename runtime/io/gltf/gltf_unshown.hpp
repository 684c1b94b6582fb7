// SPDX-License-Identifier: Apache-2.0
// What materials of glTF files have that their surfaces don't show.
#pragma once

#include <string>
#include <vector>

#include "runtime/io/gltf/gltf_file.hpp"

namespace voxelume {

/// Adds a sentence for each kind of texture or factor that the material has and its surface lacks,
/// unless the notes have it. Normal, occlusion and thickness textures, which nearly every file has,
/// are left to unshown_of_gltf().
void note_unshown(const GltfValue& material, std::vector<std::string>& notes);

/// The sentences that nothing but a description of the file has.
std::vector<std::string> unshown_of_gltf(const GltfFile& file);

}  // namespace voxelume
