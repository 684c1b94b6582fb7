// SPDX-License-Identifier: Apache-2.0
// Where writers of file formats put their bytes: a file, or memory.
#pragma once

#include <cstdint>
#include <cstring>
#include <functional>
#include <string>

#include "runtime/base/error.hpp"

namespace voxelume {

/// Fills `data` with a file's bytes from a position on, or throws.
using ReadBytes = std::function<void(uint64_t position, char* data, size_t size)>;

/// Takes bytes at a position that moves on.
class ByteSink {
  public:
    virtual ~ByteSink() = default;

    /// Throws Error::output.
    virtual void write(const void* data, size_t size) = 0;
    virtual void seek(uint64_t position) = 0;
    /// Throws Error::output with the reason, or with an earlier failure.
    [[noreturn]] virtual void fail(const std::string& reason) = 0;
};

/// Keeps the bytes.
class MemorySink : public ByteSink {
  public:
    /// `name` opens messages.
    explicit MemorySink(std::string name) : name_(std::move(name)) {}

    void write(const void* data, size_t size) override {
        if (bytes_.size() < position_ + size) bytes_.resize(position_ + size);
        if (size > 0) std::memcpy(&bytes_[position_], data, size);
        position_ += size;
    }
    void seek(uint64_t position) override { position_ = position; }
    [[noreturn]] void fail(const std::string& reason) override {
        throw Error(ErrorKind::output, "{}: {}", SourcePlace(name_), reason);
    }

    std::string take() { return std::move(bytes_); }

  private:
    std::string name_, bytes_;
    uint64_t position_ = 0;
};

}  // namespace voxelume
