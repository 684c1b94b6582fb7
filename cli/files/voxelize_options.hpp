// SPDX-License-Identifier: Apache-2.0
// What the command line of `voxelize` asks for.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "runtime/voxelume.hpp"

namespace voxelume::cli {

struct VoxelizeCommand {
    std::string file;
    std::vector<std::string> outputs;
    std::string frames;  ///< a list like 1-10; empty: not given
    double voxel_size = 0;
    int resolution = 0;
    int frame = 0;                      ///< 0: not given
    std::string surface, set, normals;  ///< empty: not given
    std::string device;
    std::vector<std::filesystem::path> assets;
    std::vector<std::string> without;
    bool quiet = false;
};

/// The options for a mesh. Throws Error::usage for choices that there aren't or that don't go
/// together.
VoxelizeOptions mesh_options_of(const VoxelizeCommand& command);

/// Throws Error::usage for options of meshes. Scenes and files of voxels are cubes anyway.
void refuse_mesh_options(const VoxelizeCommand& command);

}  // namespace voxelume::cli
