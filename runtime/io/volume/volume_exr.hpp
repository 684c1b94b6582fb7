// SPDX-License-Identifier: Apache-2.0
// The conventions that the writer and the reader of deep images share.
//
// Each pixel (u, v) is a sight ray, each sample a display voxel; samples are sorted and don't
// overlap. Z is metres along Z_E, or along the ray where the display looks backwards, too; distance
// is that of Z along the ray.
// A voxel of space fills its step, Z < ZBack; a voxel of a hit stands at its depth, Z = ZBack.
// R G B are multiplied by A.
#pragma once

#include <array>
#include <cstdint>
#include <string>

#include "runtime/base/files/input_file.hpp"

namespace voxelume::volume_exr {

/// The channels of floats that are written: kDeepFloatChannels, which are read back, then others
/// that only other programs read.
inline constexpr std::array<const char*, 8> kFloatChannels = {"R",     "G", "B",     "A",
                                                              "depth", "Z", "ZBack", "distance"};
inline constexpr const char* kChecksumKey = "voxelume_checksum";
inline constexpr size_t kChecksumDigits = 16;

/// The offset of the checksum's text in the file; 0 if the header has none.
uint64_t find_checksum(const InputFile& file);

/// The XXH3 of the file with '0' characters in place of the checksum, and of the check of a stamp,
/// which is filled in later, as text.
std::string compute_checksum(const InputFile& file, uint64_t offset);

}  // namespace voxelume::volume_exr
