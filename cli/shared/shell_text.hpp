// SPDX-License-Identifier: Apache-2.0
// Texts as words of a shell.
#pragma once

#include <string>
#include <string_view>

namespace voxelume::cli {

/// The text with a backslash before each of the characters, on one line.
std::string escaped(const std::string& text, std::string_view characters);

/// A text in single quotes of a shell.
std::string quoted(const std::string& text);

}  // namespace voxelume::cli
