// What the writer and the reader of .vxm agree on; the layout is described in model_file.hpp.
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
    uint32_t zero = 0;
    uint64_t directory_bytes = 0;
    uint64_t checksum = 0;
};
static_assert(sizeof(Start) == 40);

/// Bytes of Start that the checksum covers, ahead of the directory.
constexpr size_t kCheckedBytes = 32;

/// The least that an entry of the directory takes: two empty texts, or an empty name and five
/// numbers.
constexpr size_t kSmallestHeaderEntry = 8;
constexpr size_t kSmallestArrayEntry = 40;

}  // namespace voxelume::model_format
