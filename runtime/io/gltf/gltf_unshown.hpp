// SPDX-License-Identifier: Apache-2.0
// Parts of glTF materials that their surfaces don't show.
#pragma once

#include <string>
#include <vector>

#include "runtime/io/gltf/gltf_file.hpp"

namespace voxelume {

/// Adds a sentence for each kind of texture or factor that the material has and its surface doesn't
/// show, unless the notes have the sentence. Normal, occlusion and thickness textures, which nearly
/// every file has, are left to unshown_of_gltf().
void note_unshown(const GltfValue& material, std::vector<std::string>& notes);

/// Sentences on unshown parts that only descriptions of the file mention.
std::vector<std::string> unshown_of_gltf(const GltfFile& file);

}  // namespace voxelume
