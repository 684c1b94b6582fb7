// SPDX-License-Identifier: Apache-2.0
// Checks of options before a command works: names of outputs, numbers, choices.
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

/// The ending of a file's name, in lower case: ".png" for "Bunny.PNG".
std::string ending_of(const std::filesystem::path& file);

/// The absolute path of the file that a name leads to, with links resolved where they can be.
std::filesystem::path real_path(const std::filesystem::path& file);

/// True if a file's name ends like those of triangle meshes.
bool is_mesh_name(const std::filesystem::path& file);

/// Throws Error::usage if the name has none of the extensions (without extensions, any name will
/// do), and Error::output if no file can be created there. `command` opens the message about the
/// name.
void check_output(const std::string& path, const std::vector<std::string>& extensions,
                  const char* command);

/// Throws as check_output does; the extensions are those of images.
void check_image_output(const std::string& path, const char* command);

/// Throws as check_output does; the extensions are those of files of voxels.
void check_voxels_output(const std::string& path, const char* command);

/// The endings of files of voxels that hold surfaces, or of those that hold only cubes, separated
/// by blanks.
std::string endings_of_voxels(bool has_surfaces);

/// Throws Error::usage if two outputs are the same file, however they are spelled. Empty names are
/// ignored.
void check_distinct(const std::vector<std::string>& paths, const char* command);

/// Reads "640x480"; the X may be a capital. Throws Error::usage; `command` opens the message.
Size parse_size(const std::string& text, const char* command);

enum class Number { whole, any };

/// A check for CLI::Option::check: returns what is wrong with an option's text, or nothing.
using Check = std::function<std::string(const std::string&)>;

/// Accepts numbers from `minimum` to `maximum`.
Check in_range(double minimum, double maximum, Number number = Number::any);

/// Accepts values separated by commas, each of which passes `check`. `example` shows what is
/// accepted.
Check list_of(Check check, const char* example);

/// The values of such texts, one by one.
std::vector<std::string> listed(const std::vector<std::string>& texts);

/// Accepts one of the names.
Check one_of(std::vector<std::string_view> names);

/// A check for options that accept one device, not "all" or "all/2".
std::string one_device(const std::string& selector);

/// The names in the comma-separated texts of an option --only. Throws Error::usage, listing the
/// `names` that exist, if a name isn't among them or a text is empty. `command` opens the message,
/// and `kind` says what is named.
std::vector<std::string> chosen_names(const std::vector<std::string>& texts,
                                      const std::vector<std::string_view>& names,
                                      const char* command, const char* kind);

/// The value that an option's text names. Throws Error::usage, suggesting the nearest name.
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
