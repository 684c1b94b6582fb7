// SPDX-License-Identifier: Apache-2.0
#include "runtime/io/arrays/array_stream.hpp"

#include <algorithm>

#include "runtime/io/image/png_values.hpp"

namespace voxelume {
namespace {

constexpr size_t kBlock = 1 << 17;
constexpr size_t kMaxPiece = size_t{1} << 30;  // zlib counts in 32 bits

void swap_bytes(std::byte* data, size_t size, size_t each) {
    for (size_t i = 0; i < size; i += each) std::reverse(data + i, data + i + each);
}

}  // namespace

ByteStream::ByteStream(const InputFile& file, uint64_t start, bool is_gzip)
    : file_(file), position_(start), is_gzip_(is_gzip) {
    constexpr int kGzipOrZlib = 15 + 32;
    if (!is_gzip) return;
    block_.resize(kBlock);
    if (inflateInit2(&stream_, kGzipOrZlib) != Z_OK) file.refuse("zlib doesn't start");
}

ByteStream::~ByteStream() {
    if (is_gzip_) inflateEnd(&stream_);
}

/// Inflates into what the stream has room for. False at the end of the file.
bool ByteStream::inflate_block() {
    if (stream_.avail_in == 0) {
        const size_t size = position_ < file_.size()
                                ? std::min<uint64_t>(block_.size(), file_.size() - position_)
                                : 0;
        if (size == 0) return false;
        file_.read(position_, block_.data(), size);
        position_ += size;
        stream_.next_in = block_.data();
        stream_.avail_in = uInt(size);
    }
    if (has_ended_) {
        // Another member may follow, which begins with no zero, or zeros that fill a block up.
        for (; stream_.avail_in > 0 && *stream_.next_in == 0; --stream_.avail_in) ++stream_.next_in;
        if (stream_.avail_in == 0) return true;
        if (inflateReset(&stream_) != Z_OK) file_.refuse("its compressed data are damaged");
        has_ended_ = false;
    }
    const int code = inflate(&stream_, Z_NO_FLUSH);
    if (code != Z_OK && code != Z_STREAM_END) file_.refuse("its compressed data are damaged");
    has_ended_ = code == Z_STREAM_END;
    return true;
}

size_t ByteStream::read_some(void* data, size_t size) {
    if (!is_gzip_) {
        const uint64_t left = position_ < file_.size() ? file_.size() - position_ : 0;
        const size_t count = size_t(std::min<uint64_t>(size, left));
        file_.read(position_, data, count);
        position_ += count;
        return count;
    }
    size_t done = 0;
    while (done < size) {
        const size_t piece = std::min(size - done, kMaxPiece);
        stream_.next_out = static_cast<Bytef*>(data) + done;
        stream_.avail_out = uInt(piece);
        const bool goes_on = inflate_block();
        done += piece - stream_.avail_out;
        if (!goes_on) break;
    }
    return done;
}

void ByteStream::skip(uint64_t count) {
    if (!is_gzip_) {
        position_ += count;
        return;
    }
    std::vector<char> passed(size_t(std::min<uint64_t>(count, kBlock)));
    for (; count > 0; count -= std::min<uint64_t>(count, kBlock))
        read(passed.data(), size_t(std::min<uint64_t>(count, kBlock)));
}

void ByteStream::read(void* data, size_t size) {
    if (read_some(data, size) != size) file_.refuse("its data end too early; it is truncated");
}

ArraySlabs::ArraySlabs(const CellArray& array, const InputFile& data, int thickness)
    : array_(array), file_(data), stream_(data, array.start, array.is_gzip), thickness_(thickness) {
    stream_.skip(array.skip);
}

int ArraySlabs::next() {
    first_ += layers_;
    layers_ = std::min(thickness_, array_.counts.z - first_);
    if (layers_ == 0) return 0;
    const size_t each = bytes_of(array_.type);
    const size_t layer = size_t(array_.counts.x) * size_t(array_.counts.y) * each;
    if (!array_.slices.empty()) {
        read_slices();
    } else if (array_.is_planar) {
        plane_ = layer * size_t(layers_);
        bytes_.resize(plane_ * size_t(array_.channels));
        for (int c = 0; c < array_.channels; ++c)
            file_.read(
                array_.start + layer * (size_t(array_.counts.z) * size_t(c) + size_t(first_)),
                bytes_.data() + size_t(c) * plane_, plane_);
    } else {
        plane_ = layer * size_t(layers_) * size_t(array_.channels);
        bytes_.resize(plane_);
        stream_.read(bytes_.data(), plane_);
    }
    if (array_.is_swapped) swap_bytes(bytes_.data(), bytes_.size(), each);
    return layers_;
}

void ArraySlabs::read_slices() {
    const PngShape shape{array_.counts.x, array_.counts.y, int(8 * bytes_of(array_.type)),
                         array_.channels};
    bytes_.clear();
    for (int slice = first_; slice < first_ + layers_; ++slice) {
        const std::vector<std::byte> values = read_png_values(array_.slices[size_t(slice)], shape);
        bytes_.insert(bytes_.end(), values.begin(), values.end());
    }
    plane_ = bytes_.size();
}

}  // namespace voxelume
