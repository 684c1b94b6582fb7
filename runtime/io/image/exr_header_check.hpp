// SPDX-License-Identifier: Apache-2.0
// Checks of an OpenEXR header against the file's size, before OpenEXR reads it.
#pragma once

#include "runtime/base/files/input_file.hpp"

namespace voxelume {

/// Walks through the headers of all parts. OpenEXR takes memory for an attribute of any length that
/// is declared, up to 2 GB, and clears it, before it reads.
///
/// Throws Error::input for a file that doesn't begin as an OpenEXR file does, or with an attribute
/// longer than the file.
void check_exr_header(const InputFile& file);

}  // namespace voxelume
