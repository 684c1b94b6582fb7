// SPDX-License-Identifier: Apache-2.0
// voxelume completion SHELL: prints a script with which the shell completes commands and options.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <array>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "cli/completion_scripts.hpp"
#include "cli/option_table.hpp"
#include "cli/shared/checks.hpp"
#include "cli/shared/commands.hpp"

namespace voxelume::cli {
namespace {

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
