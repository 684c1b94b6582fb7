// SPDX-License-Identifier: Apache-2.0
#include "runtime/io/gltf/data_uri.hpp"

#include <cstdint>

namespace voxelume {
namespace {

/// The six bits of a character of base64; -1 for another.
int bits_of(char c) {
    if (c >= 'A' && c <= 'Z') return c - 'A';
    if (c >= 'a' && c <= 'z') return c - 'a' + 26;
    if (c >= '0' && c <= '9') return c - '0' + 52;
    if (c == '+' || c == '-') return 62;
    return c == '/' || c == '_' ? 63 : -1;
}

int hex_digit(char c) {
    if (c >= '0' && c <= '9') return c - '0';
    if (c >= 'a' && c <= 'f') return c - 'a' + 10;
    return c >= 'A' && c <= 'F' ? c - 'A' + 10 : -1;
}

}  // namespace

std::optional<std::string> data_of_uri(std::string_view uri) {
    const size_t comma = uri.find(',');
    if (comma == uri.npos || !uri.substr(0, comma).ends_with(";base64")) return {};
    std::string_view text = uri.substr(comma + 1);
    while (text.ends_with('=')) text.remove_suffix(1);
    std::string bytes;
    bytes.reserve(text.size() / 4 * 3 + 3);
    uint32_t pending = 0;
    int count = 0;
    for (const char c : text) {
        const int bits = bits_of(c);
        if (bits < 0) return {};
        pending = pending << 6 | uint32_t(bits);
        count += 6;
        if (count < 8) continue;
        count -= 8;
        bytes += static_cast<char>(pending >> count & 255);
    }
    return bytes;
}

std::string name_of_uri(std::string_view uri) {
    std::string name;
    for (size_t i = 0; i < uri.size(); ++i) {
        const int high = uri[i] == '%' && i + 2 < uri.size() ? hex_digit(uri[i + 1]) : -1;
        const int low = high >= 0 ? hex_digit(uri[i + 2]) : -1;
        if (low < 0) {
            name += uri[i];
            continue;
        }
        name += static_cast<char>(high << 4 | low);
        i += 2;
    }
    return name;
}

}  // namespace voxelume
