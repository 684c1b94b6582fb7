// What the writer and the reader of deep images agree on.
//
// Each pixel (u, v) is a sight ray, each sample a display voxel, sorted and without overlaps. Z is
// metres from the observer, along Z_E or along the ray as the frame's shape has it. Space fills
// its step, Z < ZBack; what is met stands at its depth, Z = ZBack. R G B are multiplied by A.
#pragma once

#include <array>
#include <cstdint>
#include <string>

#include "runtime/base/input_file.hpp"

namespace voxelume::volume_exr {

/// Four bytes a sample each.
inline constexpr std::array<const char*, 7> kFloatChannels = {"R", "G",     "B",    "A",
                                                              "Z", "ZBack", "depth"};
/// Object plus 1 or 0, VoxelKind, k.
inline constexpr std::array<const char*, 3> kIdChannels = {"objectId", "voxelKind", "voxel.K"};

inline constexpr const char* kChecksumKey = "voxelume_checksum";
inline constexpr size_t kChecksumDigits = 16;

/// Where the checksum's text stands in the file, 0 when there is none in its header.
uint64_t find_checksum(const InputFile& file);

/// XXH3 of the file with zeros ('0') in the place of the checksum, as text.
std::string compute_checksum(const InputFile& file, uint64_t place);

}  // namespace voxelume::volume_exr
