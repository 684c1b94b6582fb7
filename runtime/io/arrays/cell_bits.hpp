// SPDX-License-Identifier: Apache-2.0
// A bit for each cell of an array, in the file's order. A row along the file's first axis has words
// of its own: cell x is bit x % 64 of word x / 64, and bits beyond the last cell are 0.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

namespace voxelume {

class CellBits {
  public:
    CellBits() = default;
    explicit CellBits(const glm::ivec3& counts);

    size_t words() const { return words_; }  ///< number of words in a row
    uint64_t* row(int y, int z) { return bits_.data() + first_word(y, z); }
    const uint64_t* row(int y, int z) const { return bits_.data() + first_word(y, z); }
    bool operator()(const glm::ivec3& cell) const {
        return row(cell.y, cell.z)[cell.x / 64] >> (cell.x % 64) & 1;
    }

    /// 16 bits of a row from cell x on, 0 behind its end.
    uint32_t from(int x, int y, int z) const {
        const size_t word = size_t(x) / 64, shift = size_t(x) % 64;
        const uint64_t* const bits = row(y, z) + word;
        const bool has_next = shift > 48 && word + 1 < words_;
        return uint32_t(bits[0] >> shift | (has_next ? bits[1] << (64 - shift) : 0)) & 0xFFFF;
    }

    /// Sets a row from one byte for each cell, 0 or 1. `bytes` is padded with 0 to a multiple of
    /// 64.
    void set_row(int y, int z, const uint8_t* bytes);

    /// Dilates: sets all cells within `reach` cells, at most 63, of a set cell along each axis.
    void dilate(int reach);

  private:
    size_t first_word(int y, int z) const {
        return (size_t(y) + size_t(counts_.y) * size_t(z)) * words_;
    }
    void dilate_row(int reach, const uint64_t* from, uint64_t* to) const;

    glm::ivec3 counts_{0};
    size_t words_ = 0;
    std::vector<uint64_t> bits_;
};

/// Calls `use` with the number of each bit of a row that is 1, in order.
template <class Use>
void for_each_bit(uint64_t word, size_t number, const Use& use) {
    for (; word != 0; word &= word - 1) use(int(64 * number) + __builtin_ctzll(word));
}

}  // namespace voxelume
