// SPDX-License-Identifier: Apache-2.0
// What a user sets once for all calls, in the environment or in a file.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace voxelume::cli {

/// The maximum number of processes that may compile while a command runs.
inline constexpr int kMaxKernelCompilers = 64;

/// A row of the table of settings.
struct Setting {
    const char* name;          ///< its name in the file
    const char* variable;      ///< its name in the environment, which takes precedence
    const char* help;          ///< what it means
    const char* default_text;  ///< the value without a setting, for people
    /// What is wrong with a value; null: every value is valid.
    std::string (*fault)(const std::string& value) = nullptr;
};

/// All settings. `voxelume config` and the manual page are made from this table.
std::span<const Setting> settings();

/// An environment variable that belongs to other programs, too.
struct SharedVariable {
    const char* variable;
    const char* help;  ///< its effect on this program
};

/// All of these variables that the program reads.
std::span<const SharedVariable> shared_variables();

/// The value of a setting, and where it comes from.
struct SettingValue {
    const Setting* setting = nullptr;
    std::string value;   ///< empty for the default
    std::string origin;  ///< "default", the variable, or the file with its line
};

/// The file of settings: the one that VOXELUME_CONFIG names, otherwise voxelume/config in
/// XDG_CONFIG_HOME, otherwise in ~/.config. It is empty if VOXELUME_CONFIG is set to an empty text.
std::filesystem::path settings_file();

/// The environment variable that the name of this file comes from.
std::string settings_file_origin();

/// Reads the file, if there is one, and puts its values into the environment where that has none,
/// for the library and for commands. Must be called once, before there are threads. Throws
/// Error::usage for a file that can't be read, for lines that are no settings, and if
/// VOXELUME_CONFIG names a file that doesn't exist; in these cases no value of the file holds. Also
/// throws for wrong values in the environment.
void load_settings();

/// The settings that load_settings found, in the order of the table.
const std::vector<SettingValue>& loaded_settings();

}  // namespace voxelume::cli
