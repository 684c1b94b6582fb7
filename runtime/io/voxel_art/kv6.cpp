// SPDX-License-Identifier: Apache-2.0
// KV6 -> cubes; io/volume/volume_kv6.cpp describes the format. X goes right, Y towards the observer
// and Z down.
#include <vector>

#include "runtime/io/volume/volume_kv6_read.hpp"
#include "runtime/io/voxel_art/byte_reader.hpp"
#include "runtime/io/voxel_art/cell_bricks.hpp"
#include "runtime/io/voxel_art/voxel_art.hpp"

namespace voxelume {
namespace {

constexpr size_t kHead = 32;

struct Kv6Cell {
    uint8_t blue, green, red, unused;
    uint16_t z;
    uint8_t faces, normal;
};
static_assert(sizeof(Kv6Cell) == 8);

}  // namespace

VoxelArt read_kv6(const std::filesystem::path& path) {
    const InputFile file(path);
    const Kv6Summary kv6 = read_kv6_summary(path);  // checks every count
    if (kv6.voxels == 0) file.refuse("has no voxels to show");
    const std::string bytes = read_all(file);
    ByteReader cells(bytes, file), columns(bytes, file);
    cells.take_bytes(kHead);
    columns.take_bytes(kHead + sizeof(Kv6Cell) * kv6.voxels + 4 * size_t(kv6.size[0]));
    CellBricks bricks({0, 0, 0}, {kv6.size[0], kv6.size[2], kv6.size[1]}, file);
    for (int x = 0; x < kv6.size[0]; ++x)
        for (int y = 0; y < kv6.size[1]; ++y)
            for (int left = columns.take<uint16_t>(); left > 0; --left) {
                const auto cell = cells.take<Kv6Cell>();
                bricks.set({x, kv6.size[2] - 1 - cell.z, y},
                           uint32_t(cell.red | cell.green << 8 | cell.blue << 16));
            }
    return {bricks.model(),
            {kv6.size[0], kv6.size[1], kv6.size[2]},
            {"surface voxels alone: the file has no others"}};
}

}  // namespace voxelume
