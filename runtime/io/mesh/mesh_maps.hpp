// SPDX-License-Identifier: Apache-2.0
// The maps that a material of an OBJ file's library names, beside its colour's texture.
#pragma once

#include <filesystem>

#include "runtime/geometry/mesh.hpp"
#include "runtime/io/mesh/material_library.hpp"

namespace voxelume {

bool has_maps(const MtlMaterial& material);

/// Appends the maps of a material to the mesh (map_Ke; map_Pr and map_Pm as one), and gives them to
/// the texture, whose places are those of map_Kd. What stands for one that can't be read, which a
/// note says, neither glows nor is metal.
void add_maps(const std::filesystem::path& mesh_file, const MtlMaterial& material, Texture& texture,
              Mesh& mesh);

}  // namespace voxelume
