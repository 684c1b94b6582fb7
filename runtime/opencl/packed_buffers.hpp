// SPDX-License-Identifier: Apache-2.0
// Buffers <-> bytes that are few and quick to read, for the caches on disk.
#pragma once

#include <cstring>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "runtime/opencl/buffer.hpp"

namespace voxelume {

/// Writes values and buffers one after another, and stops when they are more than `max_bytes`.
class PackedWriter {
  public:
    explicit PackedWriter(uint64_t max_bytes = UINT64_MAX) : max_bytes_(max_bytes) {}

    template <class Value>
    void put(const Value& value) {
        static_assert(std::is_trivially_copyable_v<Value>);
        bytes_.append(reinterpret_cast<const char*>(&value), sizeof value);
    }
    /// Waits for the device's queue.
    template <class T>
    void put(const Buffer<T>& buffer) {
        if (is_too_large()) return;
        const std::vector<T> values = buffer.read();
        put_array(std::as_bytes(std::span(values)));
    }
    bool is_too_large() const { return bytes_.size() > max_bytes_; }
    std::string take() { return std::move(bytes_); }

  private:
    void put_array(std::span<const std::byte> array);
    std::string bytes_;
    uint64_t max_bytes_;
};

/// Reads values and buffers from the front of `bytes`. After a failure every further read fails.
class PackedReader {
  public:
    explicit PackedReader(std::string_view bytes) : rest_(bytes) {}

    template <class Value>
    void take(Value& value) {
        static_assert(std::is_trivially_copyable_v<Value>);
        if (!has(sizeof value)) return;
        std::memcpy(&value, rest_.data(), sizeof value);
        rest_.remove_prefix(sizeof value);
    }
    /// Allocates the buffer. Throws Error::limit if the device's memory doesn't suffice.
    template <class T>
    void take(const Device& device, const char* name, Buffer<T>& buffer) {
        const uint64_t bytes = begin_array();
        is_whole_ = is_whole_ && bytes % sizeof(T) == 0;
        if (!is_whole_) return;
        buffer = Buffer<T>(device, name, bytes / sizeof(T));
        buffer.write_in_place(
            [&](std::span<T> values) { take_array(std::as_writable_bytes(values)); });
    }
    bool is_done() const { return is_whole_ && rest_.empty(); }

  private:
    bool has(uint64_t size) {
        is_whole_ = is_whole_ && size <= rest_.size();
        return is_whole_;
    }
    uint64_t begin_array();
    void take_array(std::span<std::byte> array);

    std::string_view rest_;
    bool is_whole_ = true;
};

}  // namespace voxelume
