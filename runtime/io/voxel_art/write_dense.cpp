// SPDX-License-Identifier: Apache-2.0
// Voxels -> dense arrays: numpy's .npy, NRRD and binvox.
#include <zlib.h>

#include <algorithm>
#include <array>
#include <memory>
#include <string>

#include "runtime/base/error.hpp"
#include "runtime/base/files/atomic_file.hpp"
#include "runtime/base/files/stamp.hpp"
#include "runtime/base/text.hpp"
#include "runtime/io/voxel_art/cube_list.hpp"

namespace voxelume {
namespace {

constexpr uint64_t kMaxDenseBytes = uint64_t{1} << 33;
constexpr uint64_t kMaxBinvoxCells = uint64_t{1} << 31;

uint64_t cells_in(const glm::ivec3& size) {
    return uint64_t(size.x) * uint64_t(size.y) * uint64_t(size.z);
}

void check_dense(const glm::ivec3& size, uint64_t bytes) {
    if (bytes > kMaxDenseBytes)
        throw Error(ErrorKind::limit,
                    "an array of {} x {} x {} cells takes {:.1f} GB; use larger voxels", size.x,
                    size.y, size.z, double(bytes) / 1e9);
}

/// The order of the cells in a file, and the number of values of each.
struct DenseOrder {
    std::array<size_t, 3> stride;  ///< by the model's axes, cells
    uint64_t cells = 0;
    size_t channels = 1;
};

/// One byte a cell, or red, green, blue and opacity.
std::vector<uint8_t> dense_bytes(const CubeList& cubes, const DenseOrder& order) {
    const uint64_t bytes = order.cells * order.channels;
    check_dense(cubes.size, bytes);
    std::vector<uint8_t> dense(bytes);
    for (size_t i = 0; i < cubes.cells.size(); ++i) {
        const glm::ivec3& cell = cubes.cells[i];
        uint8_t* at = dense.data() + order.channels * (size_t(cell.x) * order.stride[0] +
                                                       size_t(cell.y) * order.stride[1] +
                                                       size_t(cell.z) * order.stride[2]);
        if (order.channels == 1) {
            *at = 1;
            continue;
        }
        const uint32_t color = cubes.colors[i];
        at[0] = uint8_t(color);
        at[1] = uint8_t(color >> 8);
        at[2] = uint8_t(color >> 16);
        at[3] = uint8_t(255 - (color >> 24));
    }
    return dense;
}

/// Writes bytes as one gzip member whose header has no time.
void write_gzip(AtomicFile& file, const std::vector<uint8_t>& bytes) {
    z_stream stream{};
    constexpr int kGzip = 15 + 16, kMemoryLevel = 8, kLevel = 1;
    if (deflateInit2(&stream, kLevel, Z_DEFLATED, kGzip, kMemoryLevel, Z_DEFAULT_STRATEGY) != Z_OK)
        file.fail("zlib doesn't start");
    const std::unique_ptr<z_stream, decltype(&deflateEnd)> end(&stream, &deflateEnd);
    std::vector<Bytef> block(1 << 16);
    constexpr size_t kMaxInput = size_t{1} << 30;  // zlib counts in 32 bits
    int code = Z_OK;
    for (size_t done = 0; code != Z_STREAM_END;) {
        if (stream.avail_in == 0) {
            const size_t piece = std::min(kMaxInput, bytes.size() - done);
            stream.next_in = const_cast<Bytef*>(bytes.data() + done);
            stream.avail_in = uInt(piece);
            done += piece;
        }
        stream.next_out = block.data();
        stream.avail_out = uInt(block.size());
        code = deflate(&stream, done == bytes.size() ? Z_FINISH : Z_NO_FLUSH);
        file.write(block.data(), block.size() - stream.avail_out);
    }
}

}  // namespace

void check_colors(const std::filesystem::path& path, const glm::ivec3& size) {
    const std::string ending = ending_of(path);
    if (ending == ".npy" || ending == ".nrrd") check_dense(size, 4 * cells_in(size));
}

WriterNotes write_npy(const std::filesystem::path& path, const CubeList& cubes) {
    const glm::ivec3& n = cubes.size;
    const size_t channels = cubes.colors.empty() ? 1 : 4;
    const DenseOrder order{{size_t(n.y) * size_t(n.z), size_t(n.z), 1}, cells_in(n), channels};
    const std::vector<uint8_t> dense = dense_bytes(cubes, order);
    std::string header =
        fmt::format("{{'descr': '|u1', 'fortran_order': False, 'shape': ({}, {}, {}{}), }}", n.x,
                    n.y, n.z, channels == 4 ? ", 4" : "");
    while ((10 + header.size() + 1) % 64 != 0) header += ' ';
    header += '\n';
    AtomicFile file(path);
    const std::array<char, 10> start = {
        '\x93', 'N', 'U', 'M', 'P', 'Y', 1, 0, char(header.size() & 255), char(header.size() >> 8)};
    file.write(start.data(), start.size());
    file.write(header.data(), header.size());
    file.write(dense.data(), dense.size());
    file.commit();
    return {};
}

WriterNotes write_nrrd(const std::filesystem::path& path, const CubeList& cubes) {
    const glm::ivec3& n = cubes.size;
    const glm::dvec3 &e = cubes.voxel_edge, first = cubes.origin + e / 2.0;
    const size_t channels = cubes.colors.empty() ? 1 : 4;
    const DenseOrder order{{1, size_t(n.x), size_t(n.x) * size_t(n.y)}, cells_in(n), channels};
    const std::vector<uint8_t> dense = dense_bytes(cubes, order);
    const bool is_color = channels == 4;
    const std::string header = fmt::format(
        "NRRD0005\n# Voxels\ntype: uchar\ndimension: {}\nspace: 3D-right-handed\n"
        "sizes: {}{} {} {}\nspace directions: {}({},0,0) (0,{},0) (0,0,{})\nkinds: {}space space "
        "space\nencoding: gzip\nspace origin: ({},{},{})\nspace units: \"m\" \"m\" "
        "\"m\"\nstamp:={}\n\n",
        is_color ? 4 : 3, is_color ? "4 " : "", n.x, n.y, n.z, is_color ? "none " : "", e.x, e.y,
        e.z, is_color ? "RGBA-color " : "", first.x, first.y, first.z, stamp_of(kNoFrame));
    AtomicFile file(path);
    file.write(header.data(), header.size());
    write_gzip(file, dense);
    file.commit();
    return {};
}

WriterNotes write_binvox(const std::filesystem::path& path, const CubeList& cubes) {
    // Other programs expect a cube; Y is fastest, then Z.
    const int side = std::max({cubes.size.x, cubes.size.y, cubes.size.z});
    const size_t n = size_t(side);
    if (cells_in(glm::ivec3(side)) > kMaxBinvoxCells)
        throw Error(ErrorKind::limit,
                    "a .binvox is a cube, and one of {0} x {0} x {0} cells is larger than {1} "
                    "cells; use larger voxels",
                    side, kMaxBinvoxCells);
    const DenseOrder order{{n * n, 1, n}, cells_in(glm::ivec3(side)), 1};
    const std::vector<uint8_t> dense = dense_bytes(cubes, order);
    std::string runs;
    for (size_t i = 0; i < dense.size();) {
        size_t end = i + 1;
        while (end < dense.size() && end - i < 255 && dense[end] == dense[i]) ++end;
        runs += char(dense[i]);
        runs += char(end - i);
        i = end;
    }
    const glm::dvec3 &o = cubes.origin, &e = cubes.voxel_edge;
    const std::string header =
        fmt::format("#binvox 1\ndim {0} {0} {0}\ntranslate {1} {2} {3}\nscale {4}\ndata\n", side,
                    o.x, o.y, o.z, e.x * side);
    AtomicFile file(path);
    file.write(header.data(), header.size());
    file.write(runs.data(), runs.size());
    file.commit();
    WriterNotes notes;
    if (!cubes.colors.empty()) notes.emplace_back("a .binvox has no colours");
    if (e.x != e.y || e.y != e.z) notes.emplace_back("a .binvox has voxels of one edge: that of x");
    return notes;
}

}  // namespace voxelume
