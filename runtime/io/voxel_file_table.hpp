// SPDX-License-Identifier: Apache-2.0
// The table of the files of voxels that are read as they are: arrays of values, and the formats of
// voxel editors and games.
#pragma once

#include <array>
#include <filesystem>
#include <span>
#include <string_view>

#include "runtime/geometry/voxel_model.hpp"
#include "runtime/io/arrays/cell_array.hpp"
#include "runtime/io/voxel_art/voxel_art.hpp"
#include "runtime/scene/parts/voxel_values.hpp"

namespace voxelume {

/// One format. A new format is a row of the table and the function that its row names, which lies
/// in a file of its own.
struct VoxelFileFormat {
    std::string_view name;                    ///< for people: "numpy array"
    std::array<std::string_view, 6> endings;  ///< endings of file names, padded with empty ones
    std::string_view mark;                    ///< the file's first bytes; empty if it has none
    CellArray (*array)(const std::filesystem::path& path);  ///< null where it has voxels alone
    VoxelArt (*art)(const std::filesystem::path& path);     ///< null where it has an array
    bool is_numbered =
        false;  ///< only names with a digit before the ending are those of the format
};

std::span<const VoxelFileFormat> voxel_file_table();

/// The format of a file, by what it begins with or else by its name; null for others.
const VoxelFileFormat* voxel_file_format(const std::filesystem::path& path);

/// The format whose files have such names, whether there is such a file or not; null for others.
const VoxelFileFormat* voxel_format_named(const std::filesystem::path& name);

/// The voxels of a file of the format. Throws Error::input for one that is damaged, truncated or
/// beyond the limits, and for values and surfaces that it doesn't have.
VoxelModel read_voxel_file(const VoxelFileFormat& format, const std::filesystem::path& path,
                           Surface surface, const VoxelValues& values);

}  // namespace voxelume
