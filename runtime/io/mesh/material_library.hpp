// SPDX-License-Identifier: Apache-2.0
// The material library that an OBJ file names. Nothing of it is read but whether it has textures.
#pragma once

#include <filesystem>
#include <string>

namespace voxelume {

/// Whether the library `name`, which the OBJ file `mesh` names, is there and has a texture. False
/// for a name that leads out of the mesh's folder.
bool names_textures(const std::filesystem::path& mesh, const std::string& name);

}  // namespace voxelume
