// SPDX-License-Identifier: Apache-2.0
// The table of the files that voxels are written to: models, OpenVDB, and cubes for other programs.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>

#include "runtime/io/voxel_art/cube_list.hpp"

namespace voxelume {

/// One format. A new format is a row of the table and the function that its row names.
struct VoxelOutputFormat {
    std::string_view ending;  ///< ending of file names
    /// Writes cubes; null for formats that also hold surfaces, which VoxelExport writes.
    WriterNotes (*write)(const std::filesystem::path&, const CubeList&);
    bool keeps_edges;      ///< voxels may have edges of different lengths
    bool keeps_materials;  ///< materials such as metal and glass are kept, not colours alone
    /// The default number of voxels along a mesh's longest side; the set of voxels has up to two
    /// more.
    int usual_resolution = 256;
};

std::span<const VoxelOutputFormat> voxel_output_table();

/// The format that a file's name stands for; null for other endings.
const VoxelOutputFormat* voxel_output_format(const std::filesystem::path& path);

/// The format that a file's name stands for. Throws Error::usage, naming all endings, where there
/// is none.
const VoxelOutputFormat& check_voxel_output(const std::filesystem::path& path);

}  // namespace voxelume
