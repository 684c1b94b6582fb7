// SPDX-License-Identifier: Apache-2.0
// Reads values of a file one after another. Every refusal begins with the file's name.
#pragma once

#include <cstring>
#include <string>
#include <string_view>

#include "runtime/base/files/input_file.hpp"

namespace voxelume {

/// All bytes of a file. Throws Error::input for more than 2 GiB.
std::string read_all(const InputFile& file);

/// All bytes of a file, inflated if it is gzip. Throws Error::input for damaged data, and as soon
/// as the result exceeds `max` bytes.
std::string read_all_inflated(const InputFile& file, size_t max);

/// Takes little-endian values from bytes that outlive the reader. Throws Error::input where they
/// end.
class ByteReader {
  public:
    ByteReader(std::string_view bytes, const InputFile& file) : bytes_(bytes), file_(file) {}

    template <class Value>
    Value take() {
        Value value;
        std::memcpy(&value, take_bytes(sizeof value).data(), sizeof value);
        return value;
    }
    std::string_view take_bytes(size_t count) {
        if (count > left()) refuse("the file ends too early; it is truncated");
        at_ += count;
        return bytes_.substr(at_ - count, count);
    }
    /// A line of text without its end.
    std::string_view take_line() {
        const size_t end = bytes_.find('\n', at_);
        if (end == std::string_view::npos) refuse("the file ends too early; it is truncated");
        const std::string_view line = bytes_.substr(at_, end - at_);
        at_ = end + 1;
        return line;
    }
    size_t left() const { return bytes_.size() - at_; }
    [[noreturn]] void refuse(const std::string& reason) const { file_.refuse(reason); }

  private:
    std::string_view bytes_;
    const InputFile& file_;
    size_t at_ = 0;
};

}  // namespace voxelume
