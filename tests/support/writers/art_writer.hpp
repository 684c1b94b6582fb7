// SPDX-License-Identifier: Apache-2.0
// Writes files of voxel editors and games according to their specifications, for tests of readers.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "tests/support/writers/array_writer.hpp"

namespace voxelume {

template <class... Values>
std::string bytes_of_all(Values... values) {
    std::string bytes;
    (append_value(bytes, values), ...);
    return bytes;
}

/// A value of named binary tags, with its kind and name where it has one.
class NbtWriter {
  public:
    static std::string text(const std::string& s) { return big(uint16_t(s.size())) + s; }
    template <class Value>
    static std::string big(Value value) {
        std::string bytes;
        append_value(bytes, value, true);
        return bytes;
    }
    static std::string named(char kind, const std::string& name, const std::string& value) {
        return std::string(1, kind) + text(name) + value;
    }
    static std::string whole(const std::string& name, int16_t value) {
        return named(2, name, big(value));
    }
    static std::string whole(const std::string& name, int32_t value) {
        return named(3, name, big(value));
    }
    static std::string bytes(const std::string& name, const std::string& content) {
        return named(7, name, big(int32_t(content.size())) + content);
    }
    static std::string words(const std::string& name, const std::string& s) {
        return named(8, name, text(s));
    }
    static std::string compound(const std::string& name, const std::string& members) {
        return named(10, name, members + '\0');
    }
    static std::string compounds(const std::string& name, const std::vector<std::string>& items) {
        std::string value = std::string(1, 10) + big(int32_t(items.size()));
        for (const std::string& item : items) value += item + '\0';
        return named(9, name, value);
    }
    static std::string longs(const std::string& name, const std::vector<uint64_t>& values) {
        std::string value = big(int32_t(values.size()));
        for (const uint64_t number : values) value += big(number);
        return named(12, name, value);
    }
};

}  // namespace voxelume
