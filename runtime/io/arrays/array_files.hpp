// SPDX-License-Identifier: Apache-2.0
// Headers of files of arrays -> descriptions of the arrays.
#pragma once

#include <filesystem>

#include "runtime/io/arrays/cell_array.hpp"

namespace voxelume {

/// A numpy array, .npy of version 1 to 3: of shape (x, y, z), or (x, y, z, 3 or 4) with colours. A
/// cell is 1 m long and the first one begins at the origin.
CellArray read_npy_header(const std::filesystem::path& path);

/// A NRRD file (.nrrd, .nhdr) with three axes of space, raw or gzip. Spaces of patients are turned
/// so that the head is up and the face in front; without units their lengths are millimetres.
CellArray read_nrrd_header(const std::filesystem::path& path);

/// True for a NRRD file with a volumetric image of ours, which is shown as such.
bool is_volume_nrrd(const std::filesystem::path& path);

/// A NIfTI 1 or 2 file (.nii, .nii.gz), or a pair of files (.hdr and .img, each also with .gz
/// behind it) of which either is named, turned as NRRD's spaces of patients are. If there are
/// several volumes, the first is read.
CellArray read_nifti_header(const std::filesystem::path& path);

/// A stack of PNG slices, whose names have consecutive numbers: that of the file and those of its
/// followers. A cell is 1 m long; X goes along rows, Y from the last row up, and slices lie behind
/// one another as seen from +Z.
CellArray read_png_stack_header(const std::filesystem::path& path);

// All these functions throw Error::input for a file that is damaged, truncated, or of an
// unsupported kind.

}  // namespace voxelume
