// SPDX-License-Identifier: Apache-2.0
// Bytes of a file from a position on -> the bytes of an array's values: as they are, inflated, or
// from numbers in text.
#pragma once

#include <cstddef>
#include <memory>

#include "runtime/base/files/input_file.hpp"
#include "runtime/io/arrays/cell_array.hpp"

namespace voxelume {

class ByteDecoder {
  public:
    virtual ~ByteDecoder() = default;
    /// Fills `data` with up to `size` bytes, fewer only at the end. Returns their number. Throws
    /// Error::input where the file is damaged.
    virtual size_t read_some(void* data, size_t size) = 0;
};

/// Makes a decoder, which never takes more memory than a few blocks. `type` is the type of numbers
/// in text. The file must outlive the decoder.
std::unique_ptr<ByteDecoder> byte_decoder(const InputFile& file, uint64_t start,
                                          DataEncoding encoding, CellType type);

}  // namespace voxelume
