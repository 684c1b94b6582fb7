// SPDX-License-Identifier: Apache-2.0
// The options of the commands as data, for completion and the manual page.
#pragma once

#include <string>
#include <vector>

namespace voxelume::cli {

struct OptionFacts {
    std::vector<std::string> names;  ///< "-o", "--output"; empty for an argument
    std::string argument;            ///< what an argument is called: "SCENE"
    std::string value;               ///< what follows, as help has it: "TEXT"; empty for a flag
    std::vector<std::string> words;  ///< the values that there are, if they are few
    bool is_list = false;            ///< true if several of them may be given, with commas between
    bool is_device = false;          ///< true if the number of a device is a value, too
    std::string help;
};

struct CommandFacts {
    std::string name, help;
    std::vector<OptionFacts> options;  ///< in the order of help
};

/// All commands with what they declare.
std::vector<CommandFacts> command_facts();

}  // namespace voxelume::cli
