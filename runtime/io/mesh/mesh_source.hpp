// The bytes of a mesh file, and the sentences that say where they are wrong.
#pragma once

#include "runtime/base/error.hpp"

#include <string>
#include <string_view>

namespace voxelume {

/// A mesh file in memory. `bytes` is a string because the NUL behind it ends every scan.
struct MeshSource {
    const std::string& bytes;
    std::string name;  ///< the file as the user wrote it; opens every message

    const char* begin() const { return bytes.data(); }
    const char* end() const { return bytes.data() + bytes.size(); }

    /// Throws Error::input "name: sentence".
    [[noreturn]] void fail(std::string_view sentence) const;
    /// Throws Error::input "name:line: sentence"; lines are counted only now.
    [[noreturn]] void fail_at_line(const char* at, std::string_view sentence) const;
    /// Throws Error::input "name: byte offset: sentence".
    [[noreturn]] void fail_at_byte(const char* at, std::string_view sentence) const;

    /// Refuses a file with a NUL in it: text has none, and the scans of text stop at the first.
    void require_text() const;
};

/// The token at `at` for a message: quoted, at most 24 characters, anything unprintable as '?'.
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

/// Scans a number of at most float's range that a blank, a line's end or `also_end` follows.
/// Throws Error::input with the line.
float require_number(const MeshSource& source, const char*& p, char also_end = '\0');

}  // namespace voxelume
