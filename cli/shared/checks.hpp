// SPDX-License-Identifier: Apache-2.0
// What commands check of their options before they work: names of outputs, numbers, choices.
#pragma once

#include <fmt/format.h>

#include <array>
#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "runtime/voxelume.hpp"

namespace voxelume::cli {

/// Throws Error::usage.
template <class... Args>
[[noreturn]] void fail_usage(fmt::format_string<Args...> format, Args&&... args) {
    throw Error(ErrorKind::usage, fmt::format(format, std::forward<Args>(args)...));
}

/// What a file's name ends with, in small letters: ".png" of "Bunny.PNG".
std::string ending_of(const std::filesystem::path& file);

/// True if a file's name ends as those of triangle meshes do.
bool is_mesh_name(const std::filesystem::path& file);

/// Throws Error::usage when the name has none of the extensions (any will do if there are none),
/// Error::output when no file can be made there. `command` opens the message about the name.
void check_output(const std::string& path, const std::vector<std::string>& extensions,
                  const char* command);

/// Throws as check_output does, for the endings of images.
void check_image_output(const std::string& path, const char* command);

/// Throws as check_output does, for the endings of files of voxels.
void check_voxels_output(const std::string& path, const char* command);

/// The endings of files of voxels that hold surfaces, or of those that hold cubes alone, with
/// blanks between them.
std::string endings_of_voxels(bool has_surfaces);

/// Throws Error::usage when two outputs are one file, however it is spelled; empty names are none.
void check_distinct(const std::vector<std::string>& paths, const char* command);

/// "640x480", or with a capital X. Throws Error::usage; `command` opens the message.
Size parse_size(const std::string& text, const char* command);

enum class Number { whole, any };

/// For CLI::Option::check: what is wrong with an option's text, if anything is.
using Check = std::function<std::string(const std::string&)>;

/// Numbers from `minimum` to `maximum`.
Check in_range(double minimum, double maximum, Number number = Number::any);

/// Values with commas between, each of which passes `check`. `example` is what is accepted.
Check list_of(Check check, const char* example);

/// The values of such texts.
std::vector<std::string> listed(const std::vector<std::string>& texts);

/// One of the names.
Check one_of(std::vector<std::string_view> names);

/// For options where "all" and "all/2" are no answer.
std::string one_device(const std::string& selector);

/// The names that the texts of an option --only have between commas. Throws Error::usage, saying
/// which `names` there are, where one isn't among them or a text has none; `command` opens the
/// message, and each is a `kind`.
std::vector<std::string> chosen_names(const std::vector<std::string>& texts,
                                      const std::vector<std::string_view>& names,
                                      const char* command, const char* kind);

/// The value that an option's text names. Throws Error::usage with the nearest name.
template <class Value, size_t count>
Value choose(const std::string& text,
             const std::array<std::pair<std::string_view, Value>, count>& choices,
             const char* option) {
    std::array<std::string_view, count> names;
    for (size_t i = 0; i < count; ++i) {
        if (text == choices[i].first) return choices[i].second;
        names[i] = choices[i].first;
    }
    fail_usage("{}: there is no {}{}", option, quote(text), suggest(text, names));
}

}  // namespace voxelume::cli
