// SPDX-License-Identifier: Apache-2.0
// bytes of a brick's cells -> a bit for each byte that isn't 0.
#pragma once

#include <array>
#include <cstdint>
#include <cstring>

#include "runtime/grid/brick_cells.hpp"

namespace voxelume {

inline constexpr uint64_t kOneEach = 0x0101010101010101;  // a 1 in each byte

/// Returns 1 in each byte that isn't 0.
inline uint64_t set_bytes(const uint8_t* eight) {
    uint64_t bytes = 0;
    std::memcpy(&bytes, eight, sizeof bytes);
    constexpr uint64_t kLow = 0x7F * kOneEach;
    return (((bytes & kLow) + kLow) | bytes) >> 7 & kOneEach;
}

/// Sets the bits of a brick's cells that have a voxel. Returns their number.
inline size_t mark_voxels(const uint8_t* cells, uint64_t* leaves) {
    constexpr uint64_t kGather = 0x0102040810204080;  // moves byte i to bit 56 + i
    constexpr uint64_t kEven = 0x00FF00FF00FF00FF, kOneInTwo = 0x0001000100010001;
    size_t count = 0;
    // Rows of 16 cells along x pass through four leaves; 16 rows fill four leaves.
    for (size_t block = 0; block < kLeavesPerBrick / 4; ++block) {
        std::array<uint64_t, 4> four{};
        uint64_t sums = 0;  // each byte sums up to at most 32
        for (size_t row = 0; row < 16; ++row) {
            const size_t y = (block & 3) << 2 | (row & 3), z = (block & 12) | row >> 2;
            const uint8_t* const sixteen = cells + (y | z << 4) * 16;
            const uint64_t low = set_bytes(sixteen), high = set_bytes(sixteen + 8),
                           bits = low * kGather >> 56 | high * kGather >> 56 << 8;
            for (size_t x = 0; x < 4; ++x) four[x] |= (bits >> 4 * x & 15) << 4 * row;
            sums += low + high;
        }
        std::memcpy(leaves + 4 * block, four.data(), sizeof four);
        count += ((sums & kEven) + (sums >> 8 & kEven)) * kOneInTwo >> 48;
    }
    return count;
}

}  // namespace voxelume
