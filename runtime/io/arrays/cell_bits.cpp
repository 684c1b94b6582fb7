// SPDX-License-Identifier: Apache-2.0
#include "runtime/io/arrays/cell_bits.hpp"

#include <algorithm>
#include <cstring>

#include "runtime/base/ranges.hpp"

namespace voxelume {

CellBits::CellBits(const glm::ivec3& counts)
    : counts_(counts),
      words_((size_t(counts.x) + 63) / 64),
      bits_(words_ * size_t(counts.y) * size_t(counts.z)) {}

void CellBits::set_row(int y, int z, const uint8_t* bytes) {
    // The bytes are 0 or 1: the product moves byte i to bit 56 + i.
    constexpr uint64_t kGather = 0x0102040810204080;
    uint64_t* words = row(y, z);
    for (size_t word = 0; word < words_; ++word) {
        uint64_t bits = 0;
        for (size_t i = 0; i < 8; ++i) {
            uint64_t eight = 0;
            std::memcpy(&eight, bytes + 64 * word + 8 * i, 8);
            bits |= (eight * kGather >> 56) << 8 * i;
        }
        words[word] = bits;
    }
}

void CellBits::dilate_row(int reach, const uint64_t* from, uint64_t* to) const {
    for (size_t word = 0; word < words_; ++word) {
        const uint64_t before = word > 0 ? from[word - 1] : 0,
                       after = word + 1 < words_ ? from[word + 1] : 0, here = from[word];
        uint64_t bits = here;
        if ((before | here | after) != 0)
            for (int i = 1; i <= reach; ++i)
                bits |= here << i | before >> (64 - i) | here >> i | after << (64 - i);
        to[word] = bits;
    }
    if (counts_.x % 64 != 0) to[words_ - 1] &= (uint64_t{1} << counts_.x % 64) - 1;
}

void CellBits::dilate(int reach) {
    std::vector<uint64_t> next(bits_.size());
    const auto widen_layers = [&](int first, int end) {
        std::vector<uint64_t> layer(words_ * size_t(counts_.y));
        for (int z = first; z < end; ++z) {
            for (int y = 0; y < counts_.y; ++y)
                dilate_row(reach, row(y, z), layer.data() + size_t(y) * words_);
            uint64_t* to = next.data() + first_word(0, z);
            for (int y = 0; y < counts_.y; ++y)
                for (int from = std::max(y - reach, 0); from <= std::min(y + reach, counts_.y - 1);
                     ++from)
                    for (size_t word = 0; word < words_; ++word)
                        to[size_t(y) * words_ + word] |= layer[size_t(from) * words_ + word];
        }
    };
    const auto join_layers = [&](int first, int end) {
        const size_t size = words_ * size_t(counts_.y);
        for (int z = first; z < end; ++z) {
            uint64_t* to = row(0, z);
            std::fill(to, to + size, 0);
            for (int from = std::max(z - reach, 0); from <= std::min(z + reach, counts_.z - 1);
                 ++from)
                for (size_t word = 0; word < size; ++word)
                    to[word] |= next[size * size_t(from) + word];
        }
    };
    const uint64_t steps = bits_.size() * uint64_t(2 * reach + 1);
    for_ranges(counts_.z, steps, widen_layers);
    for_ranges(counts_.z, steps, join_layers);
}

}  // namespace voxelume
