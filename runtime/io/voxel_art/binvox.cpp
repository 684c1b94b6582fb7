// SPDX-License-Identifier: Apache-2.0
// binvox: lines of text with the sizes, the position and the scale, then pairs of bytes: a value
// and its number of repetitions. Y runs fastest, then Z.
#include <cmath>
#include <sstream>

#include "runtime/io/voxel_art/byte_reader.hpp"
#include "runtime/io/voxel_art/cell_bricks.hpp"
#include "runtime/io/voxel_art/voxel_art.hpp"
#include "runtime/io/voxels/voxel_limits.hpp"

namespace voxelume {
namespace {

constexpr double kMaxBinvoxLength = 1e9;
constexpr uint64_t kMaxRun = 255;  // maximum number of cells of a pair of bytes

struct BinvoxHeader {
    glm::ivec3 size{0};  ///< along x, z and y, as the file has them
    glm::dvec3 translation{0};
    double scale = 1;
};

BinvoxHeader take_header(ByteReader& reader) {
    if (reader.take_bytes(7) != "#binvox") reader.refuse("not a binvox file");
    reader.take_line();
    BinvoxHeader header;
    for (int i = 0; i < 64; ++i) {
        std::istringstream line{std::string(reader.take_line())};
        std::string word;
        line >> word;
        if (word == "dim") line >> header.size.x >> header.size.z >> header.size.y;
        if (word == "translate")
            line >> header.translation.x >> header.translation.y >> header.translation.z;
        if (word == "scale") line >> header.scale;
        if (!line) reader.refuse("a line of its header has no number");
        if (word == "data") return header;
    }
    reader.refuse("its header has no end");
}

/// Refuses runs whose sum isn't the number of cells, before memory is taken for the cells.
void check_runs(ByteReader reader, uint64_t count) {
    for (uint64_t at = 0; at < count;) {
        const auto repeats = uint64_t(uint8_t(reader.take_bytes(2)[1]));
        if (repeats > count - at) reader.refuse("has more cells than its size");
        at += repeats;
    }
}

/// Steps to the next cell: Y runs fastest, then Z.
void step(glm::ivec3& cell, const glm::ivec3& size) {
    if (++cell.y < size.y) return;
    cell.y = 0;
    if (++cell.z < size.z) return;
    cell.z = 0;
    ++cell.x;
}

void set_runs(ByteReader reader, uint64_t count, const glm::ivec3& size, CellBricks& bricks) {
    glm::ivec3 cell(0);
    for (uint64_t at = 0; at < count;) {
        const std::string_view pair = reader.take_bytes(2);
        const int repeats = uint8_t(pair[1]);
        for (int i = 0; i < repeats; ++i) {
            if (pair[0] != 0) bricks.set(cell, 0xFFFFFF);
            step(cell, size);
        }
        at += uint64_t(repeats);
    }
}

}  // namespace

VoxelArt read_binvox(const std::filesystem::path& path) {
    const InputFile file(path);
    const std::string bytes = read_all(file);
    ByteReader reader(bytes, file);
    const BinvoxHeader header = take_header(reader);
    const glm::ivec3 size = header.size;
    check_voxel_span(glm::dvec3(size), file);
    const uint64_t count = uint64_t(size.x) * uint64_t(size.y) * uint64_t(size.z);
    if (count / kMaxRun > reader.left() / 2)
        reader.refuse("the file ends too early; it is truncated");
    check_runs(reader, count);
    CellBricks bricks({0, 0, 0}, size, file);
    bricks.fill([&] { set_runs(reader, count, size, bricks); });
    VoxelArt art{bricks.model(), size, {}};
    const double edge = header.scale / std::max({size.x, size.y, size.z});
    const glm::dvec3 t = header.translation;
    if (!(edge > 0 && header.scale <= kMaxBinvoxLength &&
          std::max({std::abs(t.x), std::abs(t.y), std::abs(t.z)}) <= kMaxBinvoxLength))
        reader.refuse("its scale or place is no length");
    check_voxel_edge(glm::dvec3(edge), t, file);
    art.model.frame.voxel_edge = glm::dvec3(edge);
    art.model.frame.origin = t + edge * art.model.frame.origin;
    return art;
}

}  // namespace voxelume
