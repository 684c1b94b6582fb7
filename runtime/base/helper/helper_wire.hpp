// SPDX-License-Identifier: Apache-2.0
// Values on their way from a helper program to the process that started it.
//
// The receiver trusts nothing: counts have limits, and memory grows with the bytes that have
// arrived, not with those that are announced.
#pragma once

#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdint>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <type_traits>
#include <vector>

#include "runtime/base/helper/helper_process.hpp"

namespace voxelume {

/// The helper's end. Bytes that nobody takes any more end the helper.
class WireSender {
  public:
    explicit WireSender(int descriptor) : descriptor_(descriptor) { block_.reserve(kBlock); }

    template <class Value>
    void value(const Value& value) {
        static_assert(std::is_trivially_copyable_v<Value>);
        bytes(&value, sizeof value);
    }
    template <class Value>
    void values(std::span<const Value> values) {
        static_assert(std::is_trivially_copyable_v<Value>);
        value(uint64_t{values.size()});
        bytes(values.data(), values.size_bytes());
    }
    template <class Value>
    void values(const std::vector<Value>& vector) {
        values(std::span<const Value>(vector));
    }
    void text(const std::string& text) { values(std::span<const char>(text)); }
    void texts(const std::map<std::string, std::string>& texts) {
        value(uint64_t{texts.size()});
        for (const auto& [key, value] : texts) {
            text(key);
            text(value);
        }
    }

    void flush() {
        write_out(block_.data(), block_.size());
        block_.clear();
    }

  private:
    static constexpr size_t kBlock = 1 << 16;

    void bytes(const void* data, size_t size) {
        if (block_.size() + size > kBlock) flush();
        const char* first = static_cast<const char*>(data);
        if (size > kBlock) return write_out(first, size);
        block_.insert(block_.end(), first, first + size);
    }
    void write_out(const char* data, size_t size) const {
        while (size > 0) {
            const ssize_t written = write(descriptor_, data, size);
            if (written < 0 && errno == EINTR) continue;
            if (written <= 0) _exit(1);
            data += written;
            size -= size_t(written);
        }
    }

    int descriptor_;
    std::vector<char> block_;
};

/// The receiver's end. Throws HelperFailure where the helper ends early or sends impossible values.
class WireReceiver {
  public:
    explicit WireReceiver(HelperProcess& helper) : helper_(helper) {}

    template <class Value>
    Value value() {
        static_assert(std::is_trivially_copyable_v<Value>);
        Value value;
        bytes(&value, sizeof value);
        return value;
    }
    /// A count that is at most `max`.
    uint64_t count(uint64_t max) {
        const auto count = value<uint64_t>();
        if (count > max) fail();
        return count;
    }
    template <class Value>
    std::vector<Value> values(uint64_t max) {
        static_assert(std::is_trivially_copyable_v<Value>);
        const uint64_t total = count(max), step = (uint64_t{1} << 20) / sizeof(Value);
        std::vector<Value> values;
        while (values.size() < total) {
            const size_t known = values.size(), next = std::min<uint64_t>(step, total - known);
            values.resize(known + next);
            bytes(values.data() + known, next * sizeof(Value));
        }
        return values;
    }
    /// Fills `target`. The values are sent with their number, which has to be the same.
    template <class Value>
    void fill(std::span<Value> target) {
        static_assert(std::is_trivially_copyable_v<Value>);
        if (value<uint64_t>() != target.size()) fail();
        bytes(target.data(), target.size_bytes());
    }
    std::string text(uint64_t max) {
        const std::vector<char> characters = values<char>(max);
        return {characters.begin(), characters.end()};
    }
    /// Texts with keys of at most 64 kB.
    std::map<std::string, std::string> texts() {
        std::map<std::string, std::string> texts;
        for (uint64_t left = count(kMaxEntries); left > 0; --left) {
            const std::string key = text(1 << 16);
            texts[key] = text(kMaxText);
        }
        return texts;
    }

    [[noreturn]] static void fail() {
        throw HelperFailure(HelperFailure::Cause::died, "its reader answered what can't be");
    }

  private:
    void bytes(void* data, size_t size) {
        char* target = static_cast<char*>(data);
        while (size > 0) {
            if (first_ == filled_ && size >= kBlock) {  // large arrays aren't copied
                const size_t length = helper_.read(target, size);
                target += length;
                size -= length;
                continue;
            }
            if (first_ == filled_) refill();
            const size_t length = std::min(size, filled_ - first_);
            std::copy_n(block_.get() + first_, length, target);
            first_ += length;
            target += length;
            size -= length;
        }
    }
    void refill() {
        if (!block_) block_ = std::make_unique_for_overwrite<char[]>(kBlock);
        filled_ = helper_.read(block_.get(), kBlock);
        first_ = 0;
    }

    static constexpr uint64_t kMaxEntries = 1 << 20, kMaxText = 1 << 30;
    static constexpr size_t kBlock = 1 << 16;  ///< larger memory may be mapped anew each time
    HelperProcess& helper_;
    std::unique_ptr<char[]> block_;
    size_t filled_ = 0;  ///< bytes of the block
    size_t first_ = 0;   ///< the next one of them
};

}  // namespace voxelume
