// SPDX-License-Identifier: Apache-2.0
// The table of the formats of volumetric images. Everything that is particular to one format is in
// its row.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "runtime/io/volume/volume_formats.hpp"

namespace voxelume {

/// One format. A new format is a row of the table, a value of VolumeFormat with its name, and the
/// functions that its row names, which lie in a file of their own in io/volume/.
struct VolumeFormatEntry {
    VolumeFormat format;
    std::array<const char*, 2> endings;  ///< endings of file names; the second may be null

    /// Returns the reason why the format can't hold volumes of this frame, or null if it can.
    const char* (*layout_fault)(const VolumeFrame& frame);

    /// The bytes of the part of a file that doesn't depend on how many voxels show something, and
    /// their maximum.
    double (*dense_bytes)(const VolumeFrame& frame, const VolumeOptions& options);
    double max_dense_bytes;
    glm::ivec3 max_size;  ///< voxels along each axis

    /// Throws Error::output where a file can't be made at the path, or would overwrite a file that
    /// isn't of this format.
    void (*check_path)(const VolumePath& path, VolumeFormat format);

    /// The names of all files that `write` makes; empty where a header that lists them isn't there.
    std::vector<VolumePath> (*files)(const VolumePath& path);

    void (*write)(const VolumePath& path, const Volume& volume, const VolumeOptions& options);
    Volume (*read)(const VolumePath& path);  ///< null where the format is only written
};

/// The rows, in the order of VolumeFormat.
std::span<const VolumeFormatEntry> volume_format_table();

/// The row of a format.
const VolumeFormatEntry& entry_of(VolumeFormat format);

}  // namespace voxelume
