// SPDX-License-Identifier: Apache-2.0
#include "runtime/stages/index/numbering.hpp"

#include <algorithm>
#include <bit>

#include "runtime/base/error.hpp"
#include "runtime/grid/grid.hpp"
#include "runtime/grid/sector_table.hpp"

namespace voxelume {

Numbering number_bricks(const GridFrame& frame, const BrickContents& contents) {
    const glm::ivec3 brick_table = frame.bricks(), sector_table = frame.sectors();
    const size_t bricks = contents.brick_numbers.size(), counted = contents.counted;
    Numbering numbers;
    numbers.sectors.resize(size_t(sector_table.x) * sector_table.y * sector_table.z);
    std::vector<bool> occupied(numbers.sectors.size());
    std::vector<glm::uvec2> slots(bricks);  // sector and bit of each brick
    for (size_t i = 0; i < bricks; ++i) {
        if (contents.leaf_masks[i] == 0) continue;  // the brick may hold nodes beyond all voxels
        const int index = int(contents.brick_numbers[i]);
        slots[i] = sector_and_bit({index % brick_table.x, index / brick_table.x % brick_table.y,
                                   index / (brick_table.x * brick_table.y)},
                                  sector_table);
        occupied[slots[i].x] = true;
    }
    const uint32_t blocks = number_sectors(sector_table, occupied, numbers.sectors);
    std::vector<uint32_t> brick_of_record(blocks * kRecordsPerSector, kBrickOutside);
    for (size_t i = 0; i < bricks; ++i)
        if (contents.leaf_masks[i] != 0)
            brick_of_record[numbers.sectors[slots[i].x] * kRecordsPerSector + slots[i].y] =
                uint32_t(i);

    numbers.starts.resize(bricks * (counted + 1));
    numbers.bricks.resize(brick_of_record.size() * kWordsPerRecord);
    numbers.totals.resize(counted);
    uint64_t leaves = 0;
    for (size_t record = 0; record < brick_of_record.size(); ++record) {
        const size_t brick = brick_of_record[record];
        if (brick == kBrickOutside) continue;
        const uint64_t mask = contents.leaf_masks[brick];
        uint32_t* words = &numbers.bricks[record * kWordsPerRecord];
        words[0] = uint32_t(mask);
        words[1] = uint32_t(mask >> 32);
        words[2] = uint32_t(leaves);
        words[3] = uint32_t(leaves) + uint32_t(std::popcount(words[0]));
        uint32_t* start = &numbers.starts[brick * (counted + 1)];
        start[0] = uint32_t(leaves);
        leaves += size_t(std::popcount(mask));
        for (size_t i = 0; i < counted; ++i) {
            start[1 + i] = uint32_t(numbers.totals[i]);
            numbers.totals[i] += contents.counts[brick * counted + i];
        }
    }
    write_empty_cubes(numbers.bricks);
    numbers.leaf_count = uint32_t(leaves);
    return numbers;
}

void check_numbers(bool fields, uint64_t voxels, uint64_t primitives) {
    const uint64_t maximum = uint64_t{1} << (fields ? 28 : 30);
    if (std::max(voxels, primitives) > maximum)
        throw Error(ErrorKind::limit,
                    "this world has {} surface voxels and {} primitives in them, at most {} can be "
                    "numbered: use larger voxels",
                    voxels, primitives, maximum);
}

}  // namespace voxelume
