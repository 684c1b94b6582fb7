// SPDX-License-Identifier: Apache-2.0
// Volumetric images on disk: one front for every format. scenes/VOLUMES.md describes the formats.
#pragma once

#include <filesystem>
#include <string_view>
#include <vector>

#include "runtime/image/volume.hpp"
#include "runtime/io/volume/volume_options.hpp"

namespace voxelume {

/// The format that a path's ending stands for. Throws Error::usage with the endings there are.
VolumeFormat volume_format_of(const std::filesystem::path& path);

/// The format of a name like "color-planes". Throws Error::usage with the nearest name.
VolumeFormat volume_format_named(std::string_view name);

/// Throws what write_volume would throw for every volume in this frame, before such a volume
/// exists: Error::usage for a layout that the format can't hold, Error::limit for sizes beyond the
/// format or beyond 64 GiB of dense voxels, Error::output where no file can be made.
void check_volume_output(const std::filesystem::path& path, const VolumeFrame& frame,
                         const VolumeOptions& options = {});

/// Writes the volume. Each file appears under its name whole or not at all, and a header appears
/// after its data. Equal volumes give equal bytes. Throws what check_volume_output throws, and
/// Error::output for a volume that find_fault() refuses.
void write_volume(const std::filesystem::path& path, const Volume& volume,
                  const VolumeOptions& options = {});

/// The files of a volume that was written to the path: some formats have a header of their own, and
/// slices are a file each. Empty unless all of them are there.
std::vector<std::filesystem::path> volume_files(const std::filesystem::path& path);

/// The files that writing a volume to the path may replace, of those that are there.
std::vector<std::filesystem::path> replaced_files(const std::filesystem::path& path);

/// Reads a .vdb, .exr, .nrrd or .raw/.json that voxelume wrote; scenes/VOLUMES.md says what each
/// format keeps. Throws Error::input for a file that is missing, damaged or not a volume of
/// voxelume, and Error::usage for the formats that can't be read.
Volume read_volume(const std::filesystem::path& path);

}  // namespace voxelume
