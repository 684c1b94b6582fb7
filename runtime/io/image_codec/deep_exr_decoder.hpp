// SPDX-License-Identifier: Apache-2.0
// Deep scanline OpenEXR of voxelume -> rows of samples, by OpenEXR in this process.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <glm/vec2.hpp>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "runtime/base/files/input_file.hpp"

namespace voxelume {

/// The channels of four-byte floats that are read, in the order of a sample's values.
inline constexpr std::array<const char*, 5> kDeepFloatChannels = {"R", "G", "B", "A", "depth"};
/// The channels of ids: the object's number plus 1 or 0 for none, the VoxelKind, and k.
inline constexpr std::array<const char*, 3> kDeepIdChannels = {"objectId", "voxelKind", "voxel.K"};

struct DeepExrHeader {
    glm::ivec2 first{0}, size{0};  ///< of the data window
    std::set<std::string> channels;
    std::map<std::string, std::string> texts;
};

/// The samples of a row's pixels, pixel by pixel, as arrays of their channels.
struct DeepExrRow {
    std::vector<uint32_t> counts;  ///< samples of each pixel
    std::array<std::vector<float>, kDeepFloatChannels.size()> floats;
    std::array<std::vector<uint32_t>, kDeepIdChannels.size()> ids;

    /// The sum of `counts`.
    uint64_t samples() const;
};

/// Is given the rows, from the top down.
using TakeDeepExrRow = std::function<void(int y, const DeepExrRow& row)>;

/// Reads the header of a whole file. Throws Error::input, as decode_deep_exr does.
DeepExrHeader decode_deep_exr_header(const InputFile& file);

/// Reads all rows of a file that has all of the channels, and refuses pixels of more than
/// `max_samples`.
void decode_deep_exr(const InputFile& file, uint32_t max_samples, const TakeDeepExrRow& take);

}  // namespace voxelume
