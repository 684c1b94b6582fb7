// SPDX-License-Identifier: Apache-2.0
#include "runtime/grid/sector_table.hpp"

namespace voxelume {
namespace {

/// For every cell of a table: true if the aligned group of `edge`³ cells around it is empty.
template <class IsEmpty>
std::vector<bool> empty_groups(const glm::ivec3& size, int edge, const IsEmpty& is_empty) {
    const glm::ivec3 groups = (size + edge - 1) / edge;
    std::vector<bool> empty(size_t(groups.x) * groups.y * groups.z, true);
    std::vector<bool> result(size_t(size.x) * size.y * size.z);
    const auto for_each_cell = [&](auto&& visit) {
        size_t cell = 0;
        for (int z = 0; z < size.z; ++z)
            for (int y = 0; y < size.y; ++y)
                for (int x = 0; x < size.x; ++x, ++cell)
                    visit(cell, size_t(x / edge) +
                                    size_t(groups.x) *
                                        (size_t(y / edge) + size_t(groups.y) * size_t(z / edge)));
    };
    for_each_cell([&](size_t cell, size_t group) {
        if (!is_empty(cell)) empty[group] = false;
    });
    for_each_cell([&](size_t cell, size_t group) { result[cell] = empty[group]; });
    return result;
}

}  // namespace

glm::uvec2 sector_and_bit(const glm::ivec3& b, const glm::ivec3& sectors) {
    const glm::ivec3 s = b / kBricksPerSector, in = b % kBricksPerSector;
    return {s.x + sectors.x * (s.y + sectors.y * s.z), in.x | in.y << 2 | in.z << 4};
}

uint32_t number_sectors(const glm::ivec3& size, const std::vector<bool>& occupied,
                        std::vector<uint32_t>& sectors) {
    const std::vector<bool> far_empty =
        empty_groups(size, 4, [&](size_t sector) { return !occupied[sector]; });
    uint32_t block = 0;
    for (size_t sector = 0; sector < sectors.size(); ++sector)
        sectors[sector] = occupied[sector] ? block++ : kEmptyCube | (far_empty[sector] ? 8u : 6u);
    return block;
}

void write_empty_cubes(std::vector<uint32_t>& bricks) {
    constexpr uint64_t kGroup = 0x0000000000330033ull;  // the bits of an aligned group of 2³ bricks
    for (size_t first = 0; first < bricks.size(); first += kRecordsPerSector * kWordsPerRecord) {
        uint64_t occupied = 0;
        for (size_t bit = 0; bit < kRecordsPerSector; ++bit) {
            const uint32_t* record = &bricks[first + bit * kWordsPerRecord];
            if (record[0] | record[1]) occupied |= uint64_t{1} << bit;
        }
        for (size_t bit = 0; bit < kRecordsPerSector; ++bit) {
            if (occupied >> bit & 1) continue;
            const bool group_empty = (occupied >> (bit & 0b101010) & kGroup) == 0;
            uint32_t* record = &bricks[first + bit * kWordsPerRecord];
            record[2] = record[3] = kEmptyCube | (group_empty ? 5u : 4u);
        }
    }
}

}  // namespace voxelume
