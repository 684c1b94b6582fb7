// SPDX-License-Identifier: Apache-2.0
// What the writer and the reader of .vxm share. model_file.hpp describes the layout.
#pragma once

#include <array>
#include <bit>
#include <cstdint>

namespace voxelume::model_format {

static_assert(std::endian::native == std::endian::little,
              "arrays are written as they are in memory");

/// Bytes 0-39 of the file.
struct Start {
    std::array<uint8_t, 8> magic = {0x89, 'V', 'X', 'M', '\r', '\n', 0x1a, '\n'};
    uint32_t version = 1;
    uint32_t header_entries = 0;
    uint32_t arrays = 0;
    uint32_t data_sum = 0;
    uint64_t directory_bytes = 0;
    uint64_t checksum = 0;
};
static_assert(sizeof(Start) == 40);

/// The bytes of Start, ahead of the directory, that the checksum covers.
constexpr size_t kCheckedBytes = 32;

/// Start::data_sum of the hash of the bytes behind the directory.
constexpr uint32_t data_sum_of(uint64_t hash) {
    const auto low = static_cast<uint32_t>(hash);
    return low == 0 ? 1 : low;
}

/// The minimum sizes of the directory's entries: two empty texts for a header entry, an empty name
/// and five numbers for an array.
constexpr size_t kSmallestHeaderEntry = 8;
constexpr size_t kSmallestArrayEntry = 40;

}  // namespace voxelume::model_format
