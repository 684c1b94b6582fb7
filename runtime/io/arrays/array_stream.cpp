// SPDX-License-Identifier: Apache-2.0
#include "runtime/io/arrays/array_stream.hpp"

#include <algorithm>
#include <bit>

#include "runtime/io/image/png_values.hpp"

namespace voxelume {
namespace {

void swap_bytes(std::byte* data, size_t size, size_t each) {
    for (size_t i = 0; i < size; i += each) std::reverse(data + i, data + i + each);
}

/// The value of a number of 16 bits, exactly.
float float_of_half(uint16_t half) {
    // s eeeee mmmmmmmmmm: shifted to a float's bits, the exponent lacks 127 - 15. Multiplying by a
    // power of 2 adds that, and gives subnormal numbers their exponent.
    const uint32_t bits = uint32_t(half & 0x7fff) << 13;
    const bool is_finite = (half & 0x7c00) != 0x7c00;
    const float magnitude =
        is_finite ? std::bit_cast<float>(bits) * 0x1p112f : std::bit_cast<float>(bits | 0x7f800000);
    return (half & 0x8000) != 0 ? -magnitude : magnitude;
}

/// The bytes from the start of the data to a layer of cells whose channels are interleaved.
uint64_t start_of_layer(const CellArray& array, int layer) {
    if (!in_any_order(array)) return 0;
    return array.skip + array.bytes() / uint64_t(array.counts.z) * uint64_t(layer);
}

}  // namespace

ByteStream::ByteStream(const InputFile& file, uint64_t start, DataEncoding encoding, CellType type)
    : file_(file), decoder_(byte_decoder(file, start, encoding, type)) {}

void ByteStream::skip(uint64_t count) {
    constexpr uint64_t kBlock = 1 << 17;
    std::vector<char> passed(size_t(std::min(count, kBlock)));
    for (; count > 0; count -= std::min(count, kBlock))
        read(passed.data(), size_t(std::min(count, kBlock)));
}

void ByteStream::read(void* data, size_t size) {
    if (read_some(data, size) != size) file_.refuse("its data end too early; it is truncated");
}

ArraySlabs::ArraySlabs(const CellArray& array, const InputFile& data, int thickness, int first,
                       int end)
    : array_(array),
      file_(data),
      stream_(data, array.start + start_of_layer(array, first), array.encoding, array.type),
      thickness_(thickness),
      first_(first),
      end_(end) {
    if (!in_any_order(array)) stream_.skip(array.skip);
}

int ArraySlabs::next() {
    first_ += layers_;
    layers_ = std::min(thickness_, end_ - first_);
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
    if (array_.type == CellType::f16) widen_halves();
    return layers_;
}

void ArraySlabs::widen_halves() {
    halves_.swap(bytes_);
    const size_t count = halves_.size() / sizeof(uint16_t);
    bytes_.resize(count * sizeof(float));
    const auto* const from = reinterpret_cast<const uint16_t*>(halves_.data());
    auto* const to = reinterpret_cast<float*>(bytes_.data());
    for (size_t i = 0; i < count; ++i) to[i] = float_of_half(from[i]);
    plane_ *= sizeof(float) / sizeof(uint16_t);
}

void ArraySlabs::read_slices() {
    const PngShape shape{array_.counts.x, array_.counts.y, int(8 * bytes_of(array_.type)),
                         array_.channels};
    if (first_ + layers_ > ahead_end_) {  // several at once: each time may start a program
        constexpr size_t kAhead = 1 << 22;
        const int count = std::clamp(int(kAhead / shape.bytes()), layers_, std::max(layers_, 64));
        ahead_first_ = first_;
        ahead_end_ = std::min(first_ + count, end_);
        ahead_ = read_png_values(
            std::span(array_.slices).subspan(size_t(first_), size_t(ahead_end_ - first_)), shape);
    }
    plane_ = shape.bytes() * size_t(layers_);
    const auto* const begin = ahead_.data() + shape.bytes() * size_t(first_ - ahead_first_);
    bytes_.assign(begin, begin + plane_);
}

}  // namespace voxelume
