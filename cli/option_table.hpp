// SPDX-License-Identifier: Apache-2.0
// The options of the commands as data, for completion and the manual page.
#pragma once

#include <string>
#include <vector>

namespace voxelume::cli {

struct OptionFacts {
    std::vector<std::string> names;  ///< "-o", "--output"; empty for an argument
    std::string argument;            ///< the name of an argument: "SCENE"
    std::string value;               ///< kind of the value, as in help: "TEXT"; empty for a flag
    std::vector<std::string> words;  ///< the possible values, if they are few
    bool is_list = false;            ///< true if several of them may be given, separated by commas
    bool is_device = false;          ///< true if the number of a device is also a value
    std::string help;
};

struct CommandFacts {
    std::string name, help;
    std::vector<OptionFacts> options;  ///< in the order of help
};

/// All commands with the options that they declare.
std::vector<CommandFacts> command_facts();

}  // namespace voxelume::cli
