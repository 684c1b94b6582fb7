// SPDX-License-Identifier: Apache-2.0
#include "runtime/base/utf8.hpp"

#include <algorithm>
#include <cstdint>

namespace voxelume {
namespace {

/// The number of bytes that continue a character whose first byte is `first`; -1 for a byte that
/// begins none.
int bytes_after(uint8_t first) {
    if (first < 0x80) return 0;
    if (first >= 0xC2 && first < 0xE0) return 1;
    if (first >= 0xE0 && first < 0xF0) return 2;
    return first >= 0xF0 && first < 0xF5 ? 3 : -1;
}

/// True if a code is in the range of characters with this number of `further` bytes.
bool is_code(uint32_t code, int further) {
    constexpr uint32_t kMin[] = {0, 0x80, 0x800, 0x10000};
    return code >= kMin[further] && code <= 0x10FFFF && (code < 0xD800 || code > 0xDFFF);
}

void add_character(uint32_t code, std::string& out) {
    const auto add = [&](uint32_t byte) { out += static_cast<char>(byte); };
    if (code < 0x80) return add(code);
    const int further = code < 0x800 ? 1 : code < 0x10000 ? 2 : 3;
    add((0xFF00u >> (further + 1) & 0xFF) | code >> 6 * further);
    for (int k = further - 1; k >= 0; --k) add(0x80 | (code >> 6 * k & 0x3F));
}

}  // namespace

bool is_utf8(const std::string& text) {
    for (size_t i = 0; i < text.size();) {
        const auto first = static_cast<uint8_t>(text[i]);
        const int further = bytes_after(first);
        if (further < 0 || text.size() - i <= size_t(further)) return false;
        uint32_t code = further == 0 ? first : first & (0x3Fu >> further);
        for (int k = 1; k <= further; ++k) {
            const auto byte = static_cast<uint8_t>(text[i + size_t(k)]);
            if ((byte & 0xC0) != 0x80) return false;
            code = code << 6 | (byte & 0x3Fu);
        }
        if (!is_code(code, further)) return false;
        i += size_t(further) + 1;
    }
    return true;
}

std::string utf8_text(const std::string& text) {
    if (is_utf8(text)) return text;
    std::string out;
    for (const char c : text) {
        const auto byte = static_cast<uint8_t>(c);
        if (byte < 0x80) {
            out += c;
        } else {
            out += static_cast<char>(0xC0 | byte >> 6);
            out += static_cast<char>(0x80 | (byte & 0x3F));
        }
    }
    return out;
}

bool is_utf16(const std::string& text) {
    return text.starts_with("\xFF\xFE") || text.starts_with("\xFE\xFF");
}

std::string utf8_of_utf16(const std::string& text) {
    const size_t high = text.starts_with("\xFE\xFF") ? 0 : 1;
    const size_t units = text.size() / 2;
    const auto unit = [&](size_t i) {
        return i >= units
                   ? 0u
                   : uint32_t(uint8_t(text[2 * i + high])) << 8 | uint8_t(text[2 * i + 1 - high]);
    };
    std::string out;
    out.reserve(units);
    for (size_t i = 1; i < units; ++i) {
        uint32_t code = unit(i);
        const uint32_t next = unit(i + 1);
        if (code >= 0xD800 && code < 0xDC00 && next >= 0xDC00 && next < 0xE000) {
            code = 0x10000 + ((code & 0x3FF) << 10 | (next & 0x3FF));
            ++i;
        }
        add_character(is_code(code, code < 0x80      ? 0
                                    : code < 0x800   ? 1
                                    : code < 0x10000 ? 2
                                                     : 3)
                          ? code
                          : 0xFFFD,
                      out);
    }
    return out;
}

}  // namespace voxelume
