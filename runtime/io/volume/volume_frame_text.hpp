// VolumeFrame <-> one line of JSON, which every format that is read back carries in its header.
#pragma once

#include <string>
#include <string_view>

#include "runtime/image/volume.hpp"

namespace voxelume {

/// The header entry's name: an attribute of OpenEXR, metadata of OpenVDB, a key of NRRD and JSON.
inline constexpr const char* kFrameKey = "voxelume_frame";

/// Lengths are metres, angles radians, the matrix row by row; every number comes back bit by bit.
std::string write_frame_text(const VolumeFrame& frame);

/// Throws Error::input, "WHERE: ...", for text that isn't a whole frame that find_fault() accepts.
VolumeFrame read_frame_text(std::string_view text, const std::string& where);

}  // namespace voxelume
