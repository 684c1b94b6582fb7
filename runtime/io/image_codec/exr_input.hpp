// SPDX-License-Identifier: Apache-2.0
// OpenEXR's input stream onto an InputFile: the file is opened once, and a helper program, which
// may open none, reads the one that it was given.
#pragma once

#include <Iex.h>
#include <ImfIO.h>
#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "runtime/base/files/input_file.hpp"

namespace voxelume {

class ExrInput : public Imf::IStream {
  public:
    explicit ExrInput(const InputFile& file) : IStream(file.path().c_str()), file_(file) {}

    bool read(char bytes[], int count) override {
        const auto size = size_t(std::max(count, 0));
        const uint64_t left = file_.size() - std::min(position_, file_.size());
        if (size > left)  // as OpenEXR's own stream says it
            throw Iex::InputExc(
                fmt::format("Early end of file: read {} out of {} requested bytes.", left, size));
        if (size > kBlock) {
            file_.read(position_, bytes, size);
        } else {
            if (position_ < first_ || position_ + size > first_ + block_.size()) fill();
            std::copy_n(block_.data() + (position_ - first_), size, bytes);
        }
        position_ += size;
        return true;
    }
    uint64_t tellg() override { return position_; }
    void seekg(uint64_t position) override { position_ = position; }

  private:
    static constexpr size_t kBlock = 1 << 16;

    void fill() {
        block_.resize(size_t(std::min<uint64_t>(kBlock, file_.size() - position_)));
        file_.read(position_, block_.data(), block_.size());
        first_ = position_;
    }

    const InputFile& file_;
    uint64_t position_ = 0;
    std::vector<char> block_;
    uint64_t first_ = 0;  ///< the position of the block in the file
};

}  // namespace voxelume
