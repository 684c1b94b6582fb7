// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <string>
#include <vector>

#include "cli/completion_scripts.hpp"
#include "cli/shared/shell_text.hpp"

namespace voxelume::cli {
namespace {

// Devices have a line each: their number, and after a colon their name.
constexpr const char* kZshStart = R"zsh(#compdef voxelume
_voxelume_devices() {
    local -a found=($@ ${(f)"$(voxelume devices 2>/dev/null |
        sed -nE 's/^\*? +([0-9]+)  +[a-z]+  +([^ ]+( [^ ]+)*)  .*/\1:\2/p')"})
    _describe device found
}
_voxelume() {
    local -a commands=(
)zsh";

constexpr const char* kZshCommands = R"(    )
    if (( CURRENT == 2 )); then
        commands+=('help:print all commands, or the options of one')
        _describe command commands
        _arguments '--help[print all commands]' '--version[print the version]'
        return
    fi
    shift words
    (( CURRENT-- ))
    case $words[1] in
        help) (( CURRENT == 2 )) && _describe command commands ;;
)";

// Zsh calls the function at once when it loads it from $fpath. When .zshrc evaluates the script,
// the function is only defined.
constexpr const char* kZshEnd = R"(    esac
}
if [ "$funcstack[1]" = _voxelume ]; then
    _voxelume "$@"
else
    compdef _voxelume voxelume
fi
)";

std::string zsh_values(const OptionFacts& option) {
    if (option.value.empty()) return "";
    const std::string words = fmt::format("{}", fmt::join(option.words, " "));
    if (option.is_device) return ":device: _voxelume_devices " + words;
    if (option.is_list) return ":value:_values -s , value " + words;
    if (!option.words.empty()) return fmt::format(":value:({})", words);
    return takes_files(option) ? ":file:_files" : ":" + escaped(option.value, ":\\") + ": ";
}

/// What follows a command: one of a few words, or files.
std::string zsh_arguments(const CommandFacts& command) {
    for (const OptionFacts& option : command.options)
        if (option.names.empty() && !option.words.empty()) return "1" + zsh_values(option);
    return "*:file:_files";
}

}  // namespace

std::string zsh_script(const std::vector<CommandFacts>& commands) {
    std::string text = kZshStart;
    for (const CommandFacts& command : commands)
        text +=
            fmt::format("        {}\n", quoted(command.name + ":" + escaped(command.help, ":\\")));
    text += kZshCommands;
    for (const CommandFacts& command : commands) {
        text += fmt::format("        {})\n            _arguments", command.name);
        for (const OptionFacts& option : command.options)
            for (const std::string& name : option.names)
                text +=
                    fmt::format(" \\\n                {}",
                                quoted(fmt::format("*{}[{}]{}", name, escaped(option.help, "[]:\\"),
                                                   zsh_values(option))));
        text += fmt::format(" \\\n                {}\n            ;;\n",
                            quoted(zsh_arguments(command)));
    }
    return text + kZshEnd;
}

}  // namespace voxelume::cli
