// SPDX-License-Identifier: Apache-2.0
// The bytes of a mesh file, and the messages that say where they are wrong.
#pragma once

#include "runtime/base/error.hpp"

#include <string>
#include <string_view>

namespace voxelume {

/// A mesh file in memory. `bytes` is a string because the NUL after its end stops every scan.
struct MeshSource {
    const std::string& bytes;
    std::string name;  ///< the file as the user wrote it; opens every message

    const char* begin() const { return bytes.data(); }
    const char* end() const { return bytes.data() + bytes.size(); }

    /// Throws Error::input "name: sentence".
    [[noreturn]] void fail(std::string_view sentence) const;
    /// Throws Error::input "name:line: sentence". Lines are counted only when this is called.
    [[noreturn]] void fail_at_line(const char* at, std::string_view sentence) const;
    /// Throws Error::input "name: byte offset: sentence".
    [[noreturn]] void fail_at_byte(const char* at, std::string_view sentence) const;

    /// Refuses a file that contains a NUL: text has none, and the scans of text stop at the first
    /// NUL.
    void require_text() const;
};

/// The token at `at` for a message: in quotes, at most 24 characters, every unprintable one as '?'.
std::string quoted_token(const char* at);

inline bool is_blank(char c) {
    return c == ' ' || c == '\t' || c == '\r' || c == '\v' || c == '\f';
}
inline bool ends_token(char c) {
    return is_blank(c) || c == '\n' || c == '\0';
}

inline const char* skip_blanks(const char* p) {
    while (is_blank(*p)) {
        ++p;
    }
    return p;
}

inline const char* skip_token(const char* p) {
    while (!ends_token(*p)) {
        ++p;
    }
    return p;
}

/// Scans a number within float's range that is followed by a blank, the end of the line or
/// `also_end`. Throws Error::input with the line.
float require_number(const MeshSource& source, const char*& p, char also_end = '\0');

}  // namespace voxelume
