// SPDX-License-Identifier: Apache-2.0
// One function per format. volume_file.cpp calls it with a volume that has passed its checks.
#pragma once

#include <filesystem>
#include <vector>

#include "runtime/image/volume.hpp"
#include "runtime/io/volume/volume_options.hpp"

namespace voxelume {

using VolumePath = std::filesystem::path;

void write_volume_vdb(const VolumePath& path, const Volume& volume);
void write_volume_exr(const VolumePath& path, const Volume& volume);
void write_volume_nrrd(const VolumePath& path, const Volume& volume, const VolumeOptions& options);
void write_volume_raw(const VolumePath& path, const Volume& volume);
/// The file of arrays and the file of their header, by the name of either.
std::vector<VolumePath> raw_files_of(const VolumePath& path);
void write_volume_slices(const VolumePath& pattern, const Volume& volume);
/// The path of the header of slices, without their number: `a/s.####.png` -> `a/s.json`.
VolumePath slices_header_of(const VolumePath& pattern);

/// The files in the folder whose names match a stack of slices, whoever wrote them, and its header.
std::vector<VolumePath> found_slices_of(const VolumePath& pattern);
/// All slices, whose number is in their header, and the header; empty where there is no header.
std::vector<VolumePath> slice_files_of(const VolumePath& pattern);
void write_volume_ply(const VolumePath& path, const Volume& volume);
void write_volume_kv6(const VolumePath& path, const Volume& volume, const DeviceOptions& options);
/// Writes the format `planes` or `color_planes`.
void write_volume_planes(const VolumePath& path, const Volume& volume, VolumeFormat format,
                         const DeviceOptions& options);
/// Writes the format `rgb332` or `rgb565`.
void write_volume_cylinder(const VolumePath& path, const Volume& volume, VolumeFormat format,
                           const DeviceOptions& options);

Volume read_volume_vdb(const VolumePath& path);
Volume read_volume_exr(const VolumePath& path);
Volume read_volume_nrrd(const VolumePath& path);
Volume read_volume_raw(const VolumePath& path);

/// The size of a turning display's buffer: the numbers in `options`, or those that follow from the
/// volume's own voxels.
struct CylinderSize {
    int angles = 0, radii = 0, heights = 0;
};
CylinderSize cylinder_size(const VolumeFrame& frame, const DeviceOptions& options);

}  // namespace voxelume
