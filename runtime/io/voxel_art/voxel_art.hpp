// SPDX-License-Identifier: Apache-2.0
// Files of voxel editors and games -> cubes with colours. A voxel is 1 long, Y is up.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "runtime/geometry/voxel_model.hpp"

namespace voxelume {

/// The content of a file.
struct VoxelArt {
    VoxelModel model;
    glm::ivec3 size{0};              ///< cells, as the file counts them
    std::vector<std::string> notes;  ///< notes on assumptions, and on unshown content
};

/// A Qubicle file: all of its matrices, of which later ones cover earlier ones.
VoxelArt read_qb(const std::filesystem::path& path);

/// A KV6 model of Voxlap and Slab6, which has the voxels of surfaces alone.
VoxelArt read_kv6(const std::filesystem::path& path);

/// A binvox file: voxels without colours, at the place and of the size that the file says.
VoxelArt read_binvox(const std::filesystem::path& path);

/// A Goxel file: its visible layers, of which later ones cover earlier ones.
VoxelArt read_gox(const std::filesystem::path& path);

/// A Minecraft schematic: MCEdit's .schematic, Sponge's .schem of version 1 to 3, or Litematica's
/// .litematic. A block is 1 m, a whole cube in the average colour of its kind.
VoxelArt read_schematic(const std::filesystem::path& path);

// All these functions throw Error::input for a file that is damaged, truncated, beyond the limits
// or without voxels.

}  // namespace voxelume
