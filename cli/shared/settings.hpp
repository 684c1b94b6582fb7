// SPDX-License-Identifier: Apache-2.0
// What a user sets once for all calls: in the environment, or else in a file.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace voxelume::cli {

/// The most processes that may compile beside a command.
inline constexpr int kMaxKernelCompilers = 64;

/// A row of the table of settings.
struct Setting {
    const char* name;          ///< in the file
    const char* variable;      ///< in the environment, where it counts more
    const char* help;          ///< what it means
    const char* default_text;  ///< what holds without it, for people
    std::string (*fault)(const std::string& value) = nullptr;  ///< what is wrong; null: nothing is
};

/// All of them. `voxelume config` and the manual page are made from this table.
std::span<const Setting> settings();

/// A variable of the environment that belongs to other programs, too.
struct SharedVariable {
    const char* variable;
    const char* help;  ///< what it does to this program
};

/// All of them that the program reads.
std::span<const SharedVariable> shared_variables();

/// The value of a setting, and where it comes from.
struct SettingValue {
    const Setting* setting = nullptr;
    std::string value;   ///< empty for a default
    std::string origin;  ///< "default", the variable, or the file with its line
};

/// The file of settings: VOXELUME_CONFIG, else voxelume/config in XDG_CONFIG_HOME, else in
/// ~/.config. Empty if VOXELUME_CONFIG is set to nothing.
std::filesystem::path settings_file();

/// Where the name of that file comes from: a variable of the environment.
std::string settings_file_origin();

/// Reads the file, if there is one, and puts its values into the environment where that has none,
/// for the library and for commands. To be called once, before there are threads. Throws
/// Error::usage for a file that can't be read, lines that are no settings, and a file that
/// VOXELUME_CONFIG names and that isn't there; no value of the file holds then. Throws it for wrong
/// values of the environment, too.
void load_settings();

/// What load_settings found, in the order of the table.
const std::vector<SettingValue>& loaded_settings();

}  // namespace voxelume::cli
