// SPDX-License-Identifier: Apache-2.0
// voxelume completion SHELL: a script with which the shell completes commands and options.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <memory>

#include "cli/checks.hpp"
#include "cli/commands.hpp"
#include "cli/option_table.hpp"

namespace voxelume::cli {
namespace {

constexpr const char* kBash = R"(# bash completion for voxelume
_voxelume() {{
    local word=${{COMP_WORDS[COMP_CWORD]}} before=${{COMP_WORDS[COMP_CWORD-1]}} words=""
    if [ "$COMP_CWORD" -eq 1 ]; then
        COMPREPLY=($(compgen -W "help {0}" -- "$word"))
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
        COMPREPLY=($(compgen -W "$words" -- "$word"))
    else
        compopt -o filenames 2>/dev/null
        mapfile -t COMPREPLY < <(compgen -f -- "$word")
    fi
}}
complete -F _voxelume voxelume
)";

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
            if (option.names.empty() && !option.words.empty())  // what follows the command
                values += fmt::format("        {0}:{0}) words=\"{1}\" ;;\n", command.name,
                                      fmt::join(option.words, " "));
            for (const std::string& name : option.names) {
                names += (names.empty() ? "" : " ") + name;
                if (!option.words.empty())
                    values += fmt::format("        {}:{}) words=\"{}\" ;;\n", command.name, name,
                                          fmt::join(option.words, " "));
            }
        }
        options += fmt::format("            {}) words=\"{}\" ;;\n", command.name, names);
    }
    return fmt::format(kBash, names_of_commands(commands), values, options);
}

/// The text with a backslash before each of the characters.
std::string escaped(const std::string& text, std::string_view characters) {
    std::string result;
    for (const char c : text) {
        if (characters.find(c) != characters.npos) result += '\\';
        result += c == '\n' ? ' ' : c;
    }
    return result;
}

/// A text in single quotes of a shell.
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
    return option.words.empty() ? ":value:_files"
                                : fmt::format(":value:({})", fmt::join(option.words, " "));
}

/// What follows a command: one of a few words, or files.
std::string zsh_arguments(const CommandFacts& command) {
    for (const OptionFacts& option : command.options)
        if (option.names.empty() && !option.words.empty()) return "1" + zsh_values(option);
    return "*:file:_files";
}

std::string zsh_script(const std::vector<CommandFacts>& commands) {
    std::string text = "#compdef voxelume\n_voxelume() {\n    local -a commands=(\n";
    for (const CommandFacts& command : commands)
        text +=
            fmt::format("        {}\n", quoted(command.name + ":" + escaped(command.help, ":\\")));
    text +=
        "    )\n    if (( CURRENT == 2 )); then\n        _describe command commands\n"
        "        return\n    fi\n    shift words\n    (( CURRENT-- ))\n    case $words[1] in\n";
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
    return text + "    esac\n}\n_voxelume \"$@\"\n";
}

std::string fish_script(const std::vector<CommandFacts>& commands) {
    std::string text = "# fish completion for voxelume\n";
    for (const CommandFacts& command : commands)
        text += fmt::format("complete -c voxelume -n __fish_use_subcommand -f -a {} -d {}\n",
                            command.name, quoted(escaped(command.help, "\\")));
    for (const CommandFacts& command : commands)
        for (const OptionFacts& option : command.options) {
            const bool is_argument = option.names.empty();
            if (is_argument && option.words.empty()) continue;
            text += fmt::format("complete -c voxelume -n '__fish_seen_subcommand_from {}'{}",
                                command.name, is_argument ? " -f" : "");
            for (const std::string& name : option.names)
                text += name.starts_with("--") ? " -l " + name.substr(2) : " -s " + name.substr(1);
            if (!option.words.empty())
                text += fmt::format(" -x -a {}",
                                    quoted(fmt::format("{}", fmt::join(option.words, " "))));
            else if (!option.value.empty())
                text += " -r";
            text += fmt::format(" -d {}\n", quoted(escaped(option.help, "\\")));
        }
    return text;
}

using MakeScript = std::string (*)(const std::vector<CommandFacts>& commands);

constexpr std::array kShells = {std::pair<std::string_view, MakeScript>{"bash", bash_script},
                                std::pair<std::string_view, MakeScript>{"zsh", zsh_script},
                                std::pair<std::string_view, MakeScript>{"fish", fish_script}};

}  // namespace

Action add_completion(CLI::App& app) {
    const auto shell = std::make_shared<std::string>();
    app.add_option("SHELL", *shell,
                   "bash, zsh or fish; for bash, add to ~/.bashrc: eval \"$(voxelume completion "
                   "bash)\"")
        ->type_name("bash|zsh|fish")
        ->required();
    return [shell] {
        fmt::print("{}", choose(*shell, kShells, "completion")(command_facts()));
        return 0;
    };
}

}  // namespace voxelume::cli
