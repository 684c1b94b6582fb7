// SPDX-License-Identifier: Apache-2.0
#include "runtime/io/voxel_art/median_cut.hpp"

#include <algorithm>
#include <array>

namespace voxelume {
namespace {

struct Entry {
    uint32_t color;
    uint64_t voxels;
    int channel(int c) const { return int(color >> 8 * c & 255); }
};

/// A range of entries, and the channel with the largest differences.
struct Box {
    size_t first, last;  ///< `last` is one past the end
    int channel = 0, side = 0;
};

Box box_of(const std::vector<Entry>& entries, size_t first, size_t last) {
    Box box{first, last, 0, 0};
    for (int c = 0; c < 3; ++c) {
        int low = 255, high = 0;
        for (size_t i = first; i < last; ++i) {
            low = std::min(low, entries[i].channel(c));
            high = std::max(high, entries[i].channel(c));
        }
        if (high - low > box.side) {
            box.side = high - low;
            box.channel = c;
        }
    }
    return box;
}

/// The end of the first half of the box's voxels; both halves have at least one entry.
size_t middle_of(const std::vector<Entry>& entries, const Box& box) {
    uint64_t all = 0, passed = 0;
    for (size_t i = box.first; i < box.last; ++i) all += entries[i].voxels;
    for (size_t i = box.first; i + 1 < box.last; ++i) {
        passed += entries[i].voxels;
        if (2 * passed >= all) return i + 1;
    }
    return box.last - 1;
}

uint32_t average(const std::vector<Entry>& entries, const Box& box) {
    std::array<uint64_t, 3> sums{};
    uint64_t all = 0;
    for (size_t i = box.first; i < box.last; ++i) {
        for (int c = 0; c < 3; ++c)
            sums[size_t(c)] += entries[i].voxels * uint64_t(entries[i].channel(c));
        all += entries[i].voxels;
    }
    uint32_t color = 0;
    for (size_t c = 0; c < 3; ++c) color |= uint32_t((sums[c] + all / 2) / all) << 8 * c;
    return color;
}

}  // namespace

Palette median_cut(const std::map<uint32_t, uint64_t>& voxels_by_color, size_t max) {
    std::vector<Entry> entries;
    entries.reserve(voxels_by_color.size());
    for (const auto& [color, voxels] : voxels_by_color) entries.push_back({color, voxels});
    std::vector<Box> boxes;
    boxes.reserve(max);
    if (entries.size() <= max)
        for (size_t i = 0; i < entries.size(); ++i) boxes.push_back({i, i + 1, 0, 0});
    else
        boxes.push_back(box_of(entries, 0, entries.size()));
    while (boxes.size() < max && entries.size() > max) {
        const auto longest = std::ranges::max_element(boxes, {}, &Box::side);
        if (longest->side == 0) break;
        const Box box = *longest;
        std::sort(entries.begin() + long(box.first), entries.begin() + long(box.last),
                  [&](const Entry& a, const Entry& b) {
                      return std::pair(a.channel(box.channel), a.color) <
                             std::pair(b.channel(box.channel), b.color);
                  });
        const size_t middle = middle_of(entries, box);
        *longest = box_of(entries, box.first, middle);
        boxes.push_back(box_of(entries, middle, box.last));
    }
    Palette palette;
    for (const Box& box : boxes) {
        for (size_t i = box.first; i < box.last; ++i)
            palette.numbers[entries[i].color] = uint32_t(palette.colors.size());
        palette.colors.push_back(average(entries, box));
    }
    return palette;
}

}  // namespace voxelume
