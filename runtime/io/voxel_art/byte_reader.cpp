// SPDX-License-Identifier: Apache-2.0
#include "runtime/io/voxel_art/byte_reader.hpp"

#include <algorithm>

#include "runtime/io/arrays/array_stream.hpp"

namespace voxelume {
namespace {

constexpr uint64_t kMaxFile = uint64_t{1} << 31;
constexpr size_t kPiece = size_t{1} << 20;
constexpr uint64_t kDeflateRatio = 1032;  // maximum number of bytes that a byte of deflate becomes

}  // namespace

std::string read_all(const InputFile& file) {
    if (file.size() > kMaxFile)
        file.refuse(fmt::format("has {} bytes, {} at most are possible", file.size(), kMaxFile));
    std::string bytes(file.size(), '\0');
    file.read(0, bytes.data(), bytes.size());
    return bytes;
}

std::string read_all_inflated(const InputFile& file, size_t max) {
    char mark[2] = {};
    if (file.size() < sizeof mark) file.refuse("the file ends too early; it is truncated");
    file.read(0, mark, sizeof mark);
    const bool is_gzip = mark[0] == '\x1f' && mark[1] == '\x8b';
    ByteStream stream(file, 0, is_gzip ? DataEncoding::gzip : DataEncoding::raw);
    std::string bytes;
    // Reserving is cheap, since untouched pages take no memory; growing would copy everything.
    const uint64_t largest = is_gzip ? kDeflateRatio * file.size() : file.size();
    const size_t piece = std::min<uint64_t>(largest + 1, kPiece);
    bytes.reserve(std::min<uint64_t>(largest, max) + piece);
    for (size_t got = piece; got == piece;) {
        const size_t before = bytes.size();
        bytes.resize(before + piece);
        got = stream.read_some(bytes.data() + before, piece);
        bytes.resize(before + got);
        if (bytes.size() > max)
            file.refuse(fmt::format("becomes more than the {} MiB that are possible", max >> 20));
    }
    return bytes;
}

}  // namespace voxelume
