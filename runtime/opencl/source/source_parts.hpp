// SPDX-License-Identifier: Apache-2.0
// The parts of a kernel source: functions, macros, types, constants, directives.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace voxelume {

/// A definition or a declaration at the top of a source, a directive, or a whole condition that
/// can't be decided.
struct SourcePart {
    std::string text;
    std::vector<std::string> names;  ///< the names that it defines; empty if that can't be told
    bool is_kernel = false;
    bool is_macro = false;
    bool is_called = false;  ///< a function, or a macro with parameters
    /// The macro that is called at the top, and its first argument: it may check a type's size.
    std::string macro, argument;
};

/// The parts of an OpenCL source that resolve_conditions has gone through.
std::vector<SourcePart> source_parts(std::string_view resolved);

/// An identifier in a text.
struct Mention {
    std::string_view word;
    bool is_member = false;    ///< it stands behind . or ->
    bool is_call = false;      ///< it stands before an opening parenthesis
    bool is_declared = false;  ///< it stands behind a type, as a variable that is declared does
};

/// The identifiers in a text, in order and with repeats.
std::vector<Mention> mentions(std::string_view text);
std::vector<std::string_view> identifiers(std::string_view text);

bool is_decimal_digit(char c);
bool is_of_identifier(char c);

}  // namespace voxelume
