// SPDX-License-Identifier: Apache-2.0
#include "runtime/io/arrays/array_codes.hpp"

#include <algorithm>
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

using ByteRow = uint8_t __attribute__((vector_size(kBrickSize)));
struct Rows {
    ByteRow at[kBrickSize];
};

/// Transposes 16 rows of 16 bytes: four times, rows are interleaved with those eight behind them,
/// like cards that are shuffled.
void transpose(Rows& rows) {
    for (int round = 0; round < 4; ++round) {
        Rows mixed;
        for (int i = 0; i < 8; ++i) {
            const ByteRow a = rows.at[i], b = rows.at[i + 8];
            mixed.at[2 * i] = __builtin_shufflevector(a, b, 0, 16, 1, 17, 2, 18, 3, 19, 4, 20, 5,
                                                      21, 6, 22, 7, 23);
            mixed.at[2 * i + 1] = __builtin_shufflevector(a, b, 8, 24, 9, 25, 10, 26, 11, 27, 12,
                                                          28, 13, 29, 14, 30, 15, 31);
        }
        rows = mixed;
    }
}

/// Writes a brick without missing cells. Axis `side` of the file runs along the model's rows.
void write_whole(const ByteBrick& brick, const OffsetsInBrick& offsets, size_t side,
                 uint8_t* codes) {
    const bool is_mirrored = offsets[side][0] > offsets[side][1];
    const size_t other = side == 1 ? 2 : 1;
    for (int j = 0; j < kBrickSize; ++j) {
        Rows rows;
        for (int k = 0; k < kBrickSize; ++k)
            std::memcpy(&rows.at[is_mirrored && side != 0 ? kBrickSize - 1 - k : k],
                        side == 1 ? row_of(brick, k, j) : row_of(brick, j, k), sizeof(ByteRow));
        if (side != 0) transpose(rows);
        for (size_t k = 0; k < kBrickSize; ++k) {
            ByteRow& row = rows.at[k];
            if (side == 0 && is_mirrored)
                row = __builtin_shufflevector(row, row, 15, 14, 13, 12, 11, 10, 9, 8, 7, 6, 5, 4, 3,
                                              2, 1, 0);
            std::memcpy(codes + (offsets[other][size_t(j)] | offsets[side == 0 ? 2 : 0][k]), &row,
                        sizeof row);
        }
    }
}

}  // namespace

void write_codes(const ByteBrick& brick, const OffsetsInBrick& offsets, uint8_t* codes) {
    if (is_uniform(brick)) {
        std::memset(codes, *brick.first, kVoxelsPerBrick);
        return;
    }
    if (brick.count == glm::ivec3(kBrickSize)) {
        size_t side = 0;
        while (std::max(offsets[side][0], offsets[side][1]) >= uint32_t(kBrickSize)) ++side;
        write_whole(brick, offsets, side, codes);
        return;
    }
    std::memset(codes, 0, kVoxelsPerBrick);
    for (size_t z = 0; z < size_t(brick.count.z); ++z)
        for (size_t y = 0; y < size_t(brick.count.y); ++y) {
            const uint8_t* const row = row_of(brick, int(y), int(z));
            uint8_t* const to = codes + (offsets[2][z] | offsets[1][y]);
            for (size_t x = 0; x < size_t(brick.count.x); ++x) to[offsets[0][x]] = row[x];
        }
}

}  // namespace voxelume
