// SPDX-License-Identifier: Apache-2.0
#include "runtime/io/arrays/array_codes.hpp"

#include <cstring>

#include "runtime/grid/brick_cells.hpp"

namespace voxelume {
namespace {

const uint8_t* row_of(const ByteBrick& brick, int y, int z) {
    return brick.first + size_t(y) * brick.row + size_t(z) * brick.layer;
}

bool is_uniform(const ByteBrick& brick) {
    if (brick.count != glm::ivec3(kBrickSize)) return false;
    const uint64_t value = uint64_t{*brick.first} * 0x0101010101010101;
    for (int z = 0; z < kBrickSize; ++z) {
        uint64_t differs = 0;
        for (int y = 0; y < kBrickSize; ++y) {
            std::array<uint64_t, 2> row{};
            std::memcpy(row.data(), row_of(brick, y, z), sizeof row);
            differs |= (row[0] ^ value) | (row[1] ^ value);
        }
        if (differs != 0) return false;
    }
    return true;
}

}  // namespace

void write_codes(const ByteBrick& brick, const PlacesInBrick& places, uint8_t* codes) {
    if (is_uniform(brick)) {
        std::memset(codes, *brick.first, kVoxelsPerBrick);
        return;
    }
    if (brick.count != glm::ivec3(kBrickSize)) std::memset(codes, 0, kVoxelsPerBrick);
    for (size_t z = 0; z < size_t(brick.count.z); ++z)
        for (size_t y = 0; y < size_t(brick.count.y); ++y) {
            const uint8_t* const row = row_of(brick, int(y), int(z));
            uint8_t* const to = codes + (places[2][z] | places[1][y]);
            for (size_t x = 0; x < size_t(brick.count.x); ++x) to[places[0][x]] = row[x];
        }
}

}  // namespace voxelume
