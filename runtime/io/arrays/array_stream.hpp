// SPDX-License-Identifier: Apache-2.0
// The values of an array, a slab of cells at a time, from plain or compressed files.
#pragma once

#include <algorithm>
#include <cstddef>
#include <memory>
#include <vector>

#include "runtime/base/files/input_file.hpp"
#include "runtime/base/ranges.hpp"
#include "runtime/io/arrays/byte_decoder.hpp"
#include "runtime/io/arrays/cell_array.hpp"

namespace voxelume {

/// Bytes of values from a position of a file on. Never takes more memory than a few blocks in
/// addition to the caller's.
class ByteStream {
  public:
    ByteStream(const InputFile& file, uint64_t start, DataEncoding encoding,
               CellType type = CellType::u8);

    /// Fills `data`. Throws Error::input where the file ends before that, or is damaged.
    void read(void* data, size_t size);
    /// Fills `data` with up to `size` bytes, fewer only at the file's end. Returns their number.
    size_t read_some(void* data, size_t size) { return decoder_->read_some(data, size); }
    void skip(uint64_t count);

  private:
    const InputFile& file_;
    std::unique_ptr<ByteDecoder> decoder_;
};

/// Layers of an array along the file's last axis.
class ArraySlabs {
  public:
    /// The array must have passed check_array().
    ArraySlabs(const CellArray& array, const InputFile& data, int thickness)
        : ArraySlabs(array, data, thickness, 0, array.counts.z) {}
    /// The layers from `first` to one before `end`; `first` is 0 unless layers are in_any_order().
    ArraySlabs(const CellArray& array, const InputFile& data, int thickness, int first, int end);

    /// Reads the next slab. Returns its number of layers; 0 after the last.
    int next();
    int first() const { return first_; }  ///< number of its first layer
    /// The values of channel `c`, of cells in the file's order. Interleaved channels are in channel
    /// 0 together. Values of float16 are float32 here.
    const std::byte* values(int c = 0) const { return bytes_.data() + size_t(c) * plane_; }

  private:
    void read_slices();
    void widen_halves();

    const CellArray& array_;
    const InputFile& file_;
    ByteStream stream_;
    int thickness_;
    int first_, end_;
    int layers_ = 0;
    size_t plane_ = 0;  ///< bytes of a slab, or of one of its channels where they are apart
    std::vector<std::byte> bytes_, halves_;
    std::vector<std::byte> ahead_;         ///< of a stack of slices: those of several layers
    int ahead_first_ = 0, ahead_end_ = 0;  ///< which
};

/// True if a layer can be read without those before it.
inline bool in_any_order(const CellArray& array) {
    return array.encoding == DataEncoding::raw;
}

/// Calls `use(first, end)` for ranges that cover the array's layers, at the same time where they
/// can be read in any order. Ranges begin at multiples of `thickness`.
template <class Use>
void for_layer_ranges(const CellArray& array, int thickness, const Use& use) {
    const int layers = array.counts.z;
    if (!in_any_order(array)) return use(0, layers);
    for_ranges((layers + thickness - 1) / thickness, array.cells(), [&](int first, int end) {
        use(first * thickness, std::min(end * thickness, layers));
    });
}

/// Calls `use` with the first value as a pointer of its type.
template <class Use>
void with_type(CellType type, const std::byte* values, const Use& use) {
    const auto as = [&](auto* pointer) { use(reinterpret_cast<decltype(pointer)>(values)); };
    switch (type) {
        case CellType::boolean:
        case CellType::u8:
            return as(static_cast<const uint8_t*>(nullptr));
        case CellType::i8:
            return as(static_cast<const int8_t*>(nullptr));
        case CellType::u16:
            return as(static_cast<const uint16_t*>(nullptr));
        case CellType::i16:
            return as(static_cast<const int16_t*>(nullptr));
        case CellType::u32:
            return as(static_cast<const uint32_t*>(nullptr));
        case CellType::i32:
            return as(static_cast<const int32_t*>(nullptr));
        case CellType::u64:
            return as(static_cast<const uint64_t*>(nullptr));
        case CellType::i64:
            return as(static_cast<const int64_t*>(nullptr));
        case CellType::f16:  // slabs have f16 as f32
        case CellType::f32:
            return as(static_cast<const float*>(nullptr));
        case CellType::f64:
            return as(static_cast<const double*>(nullptr));
    }
}

}  // namespace voxelume
