// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <string>
#include <vector>

#include "cli/completion_scripts.hpp"

namespace voxelume::cli {
namespace {

constexpr const char* kBash = R"(# bash completion for voxelume
_voxelume_devices() {{
    voxelume devices 2>/dev/null | sed -nE 's/^\*? +([0-9]+)  .*/\1/p'
}}
_voxelume() {{
    local word=${{COMP_WORDS[COMP_CWORD]}} before=${{COMP_WORDS[COMP_CWORD-1]}} words="" start=""
    if [ "$word" = = ]; then
        word=""
    elif [ "$before" = = ]; then
        before=${{COMP_WORDS[COMP_CWORD-2]}}
    fi
    local listed=${{word%"${{word##*,}}"}}
    if [ "$COMP_CWORD" -eq 1 ]; then
        COMPREPLY=($(compgen -W "help --help --version {0}" -- "$word"))
        return
    fi
    case ${{COMP_WORDS[1]}}:$before in
        help:*) words="{0}" ;;
{1}    esac
    if [ -z "$words" ] && [[ $word == -* ]]; then
        case ${{COMP_WORDS[1]}} in
{2}        esac
    fi
    if [ -n "$words" ]; then
        [ "$start" = - ] && start=$listed && compopt -o nospace 2>/dev/null
        COMPREPLY=($(compgen -P "$start" -W "$words" -- "${{word#"$start"}}"))
    else
        compopt -o filenames 2>/dev/null
        mapfile -t COMPREPLY < <(compgen -f -- "$word")
    fi
}}
complete -F _voxelume voxelume
)";

/// What bash sets for the values of an option; a list begins with what is listed already.
std::string bash_values(const OptionFacts& option) {
    return fmt::format("words=\"{}{}\"{}", fmt::join(option.words, " "),
                       option.is_device ? " $(_voxelume_devices)" : "",
                       option.is_list ? " start=-" : "");
}

std::string names_of_commands(const std::vector<CommandFacts>& commands) {
    std::vector<std::string> names;
    names.reserve(commands.size());
    for (const CommandFacts& command : commands) names.push_back(command.name);
    return fmt::format("{}", fmt::join(names, " "));
}

}  // namespace

std::string bash_script(const std::vector<CommandFacts>& commands) {
    std::string values, options;
    for (const CommandFacts& command : commands) {
        std::string names;
        for (const OptionFacts& option : command.options) {
            if (option.names.empty() && !option.words.empty())  // what follows the command
                values += fmt::format("        {0}:{0}) words=\"{1}\" ;;\n", command.name,
                                      fmt::join(option.words, " "));
            for (const std::string& name : option.names) {
                names += (names.empty() ? "" : " ") + name;
                if (!option.words.empty())
                    values += fmt::format("        {}:{}) {} ;;\n", command.name, name,
                                          bash_values(option));
                else if (!option.value.empty() && !takes_files(option))
                    values += fmt::format("        {}:{}) return ;;\n", command.name, name);
            }
        }
        options += fmt::format("            {}) words=\"{}\" ;;\n", command.name, names);
    }
    return fmt::format(kBash, names_of_commands(commands), values, options);
}

}  // namespace voxelume::cli
