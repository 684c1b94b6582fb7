// SPDX-License-Identifier: Apache-2.0
// The commands and their options -> what completes them, a script for each shell.
#pragma once

#include <string>
#include <vector>

#include "cli/option_table.hpp"

namespace voxelume::cli {

std::string bash_script(const std::vector<CommandFacts>& commands);
std::string fish_script(const std::vector<CommandFacts>& commands);
std::string zsh_script(const std::vector<CommandFacts>& commands);

/// True if files are offered for it: other values have a name of their own, such as FRAMES.
inline bool takes_files(const OptionFacts& option) {
    return option.value == "TEXT";
}

}  // namespace voxelume::cli
