// SPDX-License-Identifier: Apache-2.0
// voxelume completion SHELL: prints a script with which the shell completes commands and options.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <memory>

#include "cli/option_table.hpp"
#include "cli/shared/checks.hpp"
#include "cli/shared/commands.hpp"

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

/// The variables that bash sets for the values of an option. In a list, words begin with what is
/// already listed.
std::string bash_values(const OptionFacts& option) {
    return fmt::format("words=\"{}{}\"{}", fmt::join(option.words, " "),
                       option.is_device ? " $(_voxelume_devices)" : "",
                       option.is_list ? " start=-" : "");
}

/// True if files are offered for an option; other kinds of values have their own names, such as
/// FRAMES.
bool takes_files(const OptionFacts& option) {
    return option.value == "TEXT";
}

std::string names_of_commands(const std::vector<CommandFacts>& commands) {
    std::vector<std::string> names;
    names.reserve(commands.size());
    for (const CommandFacts& command : commands) names.push_back(command.name);
    return fmt::format("{}", fmt::join(names, " "));
}

std::string bash_script(const std::vector<CommandFacts>& commands) {
    std::string values, options;
    for (const CommandFacts& command : commands) {
        std::string names;
        for (const OptionFacts& option : command.options) {
            if (option.names.empty() && !option.words.empty())  // the word that follows the command
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

/// The text with a backslash before each of the given characters.
std::string escaped(const std::string& text, std::string_view characters) {
    std::string result;
    for (const char c : text) {
        if (characters.find(c) != characters.npos) result += '\\';
        result += c == '\n' ? ' ' : c;
    }
    return result;
}

/// The text in single quotes, for a shell.
std::string quoted(const std::string& text) {
    std::string result = "'";
    for (const char c : text)
        if (c == '\'')
            result += "'\\''";
        else
            result += c;
    return result + "'";
}

std::string zsh_values(const OptionFacts& option) {
    if (option.value.empty()) return "";
    const std::string words = fmt::format("{}", fmt::join(option.words, " "));
    if (option.is_device) return ":device: _voxelume_devices " + words;
    if (option.is_list) return ":value:_values -s , value " + words;
    if (!option.words.empty()) return fmt::format(":value:({})", words);
    return takes_files(option) ? ":file:_files" : ":" + escaped(option.value, ":\\") + ": ";
}

/// What may follow a command: one of a few words, or files.
std::string zsh_arguments(const CommandFacts& command) {
    for (const OptionFacts& option : command.options)
        if (option.names.empty() && !option.words.empty()) return "1" + zsh_values(option);
    return "*:file:_files";
}

// Each device has a line: its number, a colon, and its name.
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

// Zsh calls the function immediately when it loads it from $fpath. When .zshrc evaluates the
// script, the function is only defined.
constexpr const char* kZshEnd = R"(    esac
}
if [ "$funcstack[1]" = _voxelume ]; then
    _voxelume "$@"
else
    compdef _voxelume voxelume
fi
)";

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

// Fish's own functions would take any word of the line for the command, even a file's name.
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

using MakeScript = std::string (*)(const std::vector<CommandFacts>& commands);

constexpr std::array kShells = {std::pair<std::string_view, MakeScript>{"bash", bash_script},
                                std::pair<std::string_view, MakeScript>{"zsh", zsh_script},
                                std::pair<std::string_view, MakeScript>{"fish", fish_script}};

}  // namespace

Action add_completion(CLI::App& app) {
    const auto shell = std::make_shared<std::string>();
    app.add_option(
           "SHELL", *shell,
           "bash, zsh or fish; add to ~/.bashrc: eval \"$(voxelume completion bash)\", likewise "
           "to ~/.zshrc after compinit; to ~/.config/fish/config.fish: voxelume completion "
           "fish | source")
        ->type_name("bash|zsh|fish")
        ->required();
    return [shell] {
        fmt::print("{}", choose(*shell, kShells, "completion")(command_facts()));
        return 0;
    };
}

}  // namespace voxelume::cli
