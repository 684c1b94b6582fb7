// SPDX-License-Identifier: Apache-2.0
// Checks of an OpenEXR header against the file's size, before OpenEXR reads it.
#pragma once

#include "runtime/base/files/input_file.hpp"

namespace voxelume {

/// What a file's headers declare; 2^60 bytes for more.
struct ExrExtent {
    uint64_t pixel_bytes = 0;  ///< of all parts, by four bytes for each number
    uint64_t row_bytes = 0;    ///< of the longest row of a part
    uint64_t block_bytes = 0;  ///< of the largest piece that is decoded at once: a tile, or rows
};

/// Walks through the headers of all parts. OpenEXR takes memory for an attribute of any length that
/// is declared, up to 2 GB, and clears it, before it reads.
///
/// Throws Error::input for a file that doesn't begin as an OpenEXR file does, or with an attribute
/// longer than the file.
ExrExtent check_exr_header(const InputFile& file);

}  // namespace voxelume
