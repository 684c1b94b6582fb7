// SPDX-License-Identifier: Apache-2.0
// The 64-bit hash FNV-1a, which changes if any bit of the input changes.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace voxelume::oracle {

class Fnv {
  public:
    void add(const void* data, size_t size) {
        const auto* bytes = static_cast<const unsigned char*>(data);
        for (size_t i = 0; i < size; ++i) hash_ = (hash_ ^ bytes[i]) * 0x100000001B3u;
    }
    template <class Value>
    void add(const std::vector<Value>& values) {
        add(values.data(), values.size() * sizeof(Value));
    }
    uint64_t value() const { return hash_; }

  private:
    uint64_t hash_ = 0xCBF29CE484222325u;
};

}  // namespace voxelume::oracle
