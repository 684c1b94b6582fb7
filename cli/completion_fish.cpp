// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <string>
#include <vector>

#include "cli/completion_scripts.hpp"
#include "cli/shared/shell_text.hpp"

namespace voxelume::cli {
namespace {

// Fish's own functions would take any word of the line for the command, even the name of a file.
constexpr const char* kFish = R"(# fish completion for voxelume
function __voxelume_command
    set -l words (commandline -opc)
    test (count $words) -ge 2; and contains -- $words[2] $argv
end
function __voxelume_no_command
    test (count (commandline -opc)) -eq 1
end
function __voxelume_devices
    printf '%s\n' $argv
    voxelume devices 2>/dev/null |
        sed -nE 's/^\*? +([0-9]+)  +[a-z]+  +([^ ]+( [^ ]+)*)  .*/\1\t\2/p'
end
function __voxelume_list
    set -l start (commandline -ct | string replace -rf '^(?:--[a-z-]+=)?(.*,).*' '$1')
    or set start ''
    printf '%s\n' $start$argv
end
complete -c voxelume -n __voxelume_no_command -l help -d 'print all commands'
complete -c voxelume -n __voxelume_no_command -l version -d 'print the version'
complete -c voxelume -n __voxelume_no_command -f -a help -d 'print commands, or the options of one'
)";

std::string fish_option(const std::string& command, const OptionFacts& option) {
    const bool is_argument = option.names.empty();
    if (is_argument && option.words.empty()) return "";
    std::string text = fmt::format("complete -c voxelume -n '__voxelume_command {}'{}", command,
                                   is_argument ? " -f" : "");
    for (const std::string& name : option.names)
        text += name.starts_with("--") ? " -l " + name.substr(2) : " -s " + name.substr(1);
    const std::string words = fmt::format("{}", fmt::join(option.words, " "));
    if (option.is_device)
        text += fmt::format(" -x -a {}", quoted("(__voxelume_devices " + words + ")"));
    else if (option.is_list)
        text += fmt::format(" -x -a {}", quoted("(__voxelume_list " + words + ")"));
    else if (!option.words.empty())
        text += fmt::format(" -x -a {}", quoted(words));
    else if (!option.value.empty())
        text += takes_files(option) ? " -r -F" : " -x";
    return text + fmt::format(" -d {}\n", quoted(escaped(option.help, "\\")));
}

}  // namespace

std::string fish_script(const std::vector<CommandFacts>& commands) {
    std::string text = kFish;
    for (const CommandFacts& command : commands)
        for (const char* when : {"__voxelume_no_command", "'__voxelume_command help'"})
            text += fmt::format("complete -c voxelume -n {} -f -a {} -d {}\n", when, command.name,
                                quoted(escaped(command.help, "\\")));
    for (const CommandFacts& command : commands)
        for (const OptionFacts& option : command.options) text += fish_option(command.name, option);
    return text;
}

}  // namespace voxelume::cli
