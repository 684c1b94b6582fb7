// SPDX-License-Identifier: Apache-2.0
// Words for messages: text in quotes, the nearest of several names, a place in a file.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>

namespace voxelume {

/// Place in a text; both count from 1, and the column counts characters, not bytes.
struct TextPosition {
    int line = 1;
    int column = 1;
};

/// Text from a file, in quotes, made safe for a terminal and cut to a readable length.
std::string quote(std::string_view text);

/// `a "model"` or `an "observer"`.
std::string with_article(std::string_view name);

/// The ending of a file's name, in lower case: ".png" of "Bunny.PNG".
std::string ending_of(const std::filesystem::path& file);

/// ` did you mean "brick"?` for the nearest of the names, or a list of them, or nothing. It begins
/// with `; `.
std::string suggest(std::string_view text, std::span<const std::string_view> names);

}  // namespace voxelume
