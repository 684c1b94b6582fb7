// SPDX-License-Identifier: Apache-2.0
// VolumeFrame <-> one line of JSON. Every format that can be read back has it in its header.
#pragma once

#include <string>
#include <string_view>

#include "runtime/image/volume.hpp"

namespace voxelume {

/// The name of the header entry: an attribute of OpenEXR, metadata of OpenVDB, a key of NRRD and
/// JSON.
inline constexpr const char* kFrameKey = "voxelume_frame";

/// Writes lengths in metres, angles in radians and the matrix row by row. Every number is read back
/// bit by bit.
std::string write_frame_text(const VolumeFrame& frame);

/// Reads the frame. Throws Error::input, "WHERE: ...", for text that isn't a whole frame that
/// find_fault() accepts.
VolumeFrame read_frame_text(std::string_view text, const std::string& where);

}  // namespace voxelume
