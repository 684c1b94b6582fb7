// SPDX-License-Identifier: Apache-2.0
// The parts of a kernel source: functions, macros, types, constants, directives.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace voxelume {

/// A directive, a definition or a declaration at the top of a source.
struct SourcePart {
    enum class Kind { definition, condition, branch, condition_end };  ///< #if, #else, #endif
    Kind kind = Kind::definition;
    std::string text;
    std::string name;  ///< the defined name; empty if it is unknown
    bool is_kernel = false;
};

/// The parts of an OpenCL source. Comments and `#line` are left out, as is code under `#ifdef
/// __cplusplus`; lines that end in a backslash are joined to the next.
std::vector<SourcePart> source_parts(std::string_view source);

/// The identifiers in a text, in order and with repeats.
std::vector<std::string_view> identifiers(std::string_view text);

}  // namespace voxelume
