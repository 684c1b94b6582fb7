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
    std::string_view ending;  ///< of file names
    /// Writes cubes; null for formats that hold surfaces, too, whose voxels VoxelExport writes.
    WriterNotes (*write)(const std::filesystem::path&, const CubeList&);
    bool keeps_edges;      ///< of voxels that aren't cubes
    bool keeps_materials;  ///< such as metal and glass, not colours alone
    /// Voxels along a mesh's longest side if nobody says how many; the set of them has up to two
    /// more.
    int usual_resolution = 256;
};

std::span<const VoxelOutputFormat> voxel_output_table();

/// The format that a file's name stands for; null where the ending is of none.
const VoxelOutputFormat* voxel_output_format(const std::filesystem::path& path);

/// The format that a file's name stands for. Throws Error::usage, naming all endings, where there
/// is none.
const VoxelOutputFormat& check_voxel_output(const std::filesystem::path& path);

}  // namespace voxelume
