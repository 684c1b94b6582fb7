// SPDX-License-Identifier: Apache-2.0
// Words of OBJ that say nothing about a mesh, and backslashes that join lines.
#pragma once

#include <string_view>

#include "runtime/io/mesh/mesh_source.hpp"

namespace voxelume {

/// Statements of the format that say nothing about a mesh. The parser handles v, f, vn, vt, and
/// p and l with numbers, itself.
inline constexpr std::string_view kSkippedStatements[] = {
    "vp",     "deg",        "bmat",      "step",  "cstype", "p",        "l",        "fo",  "curv",
    "curv2",  "surf",       "parm",      "trim",  "hole",   "scrv",     "sp",       "end", "con",
    "g",      "s",          "mg",        "o",     "bevel",  "c_interp", "d_interp", "lod", "maplib",
    "usemap", "shadow_obj", "trace_obj", "ctech", "stech",  "call",     "scmp",     "csh", "bsp",
    "bzp",    "cdc",        "cdp",       "res",   "ctexp"};

/// True if nothing but blanks follows the backslash on its line.
inline bool ends_line(const char* backslash) {
    const char* const p = skip_blanks(backslash + 1);
    return *p == '\n' || *p == '\0';
}

/// True if the line [begin, end) ends in a backslash.
inline bool ends_in_backslash(const char* begin, const char* end) {
    while (end > begin && (is_blank(end[-1]) || end[-1] == '\n')) {
        --end;
    }
    return end > begin && end[-1] == '\\';
}

}  // namespace voxelume
