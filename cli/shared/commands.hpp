// SPDX-License-Identifier: Apache-2.0
// The commands of `voxelume`, one file each; command_table.cpp lists them.
#pragma once

#include <functional>
#include <span>

// NOLINTNEXTLINE(readability-identifier-naming): the library's own name
namespace CLI {
class App;
}

namespace voxelume::cli {

/// What a command does once its options have been read; returns the exit code.
using Action = std::function<int()>;

/// Declares a command's options on `app` and returns its action.
///
/// The options live in the action (a shared pointer that both capture): `app` fills them before it
/// runs. A failure is thrown as `voxelume::Error`; `main` prints its sentence and exits with its
/// code. Results go to stdout, messages for people to stderr.
using AddCommand = Action (*)(CLI::App& app);

/// A row of the table of commands.
struct Command {
    const char* name;
    const char* help;  ///< one line, for `voxelume help`
    AddCommand add;
};

/// All commands. Help, manual page and completion are made from this table and the options that the
/// commands declare.
std::span<const Command> commands();

/// The exit codes, as lines for people.
const char* exit_codes_text();

Action add_bench(CLI::App& app);
Action add_check(CLI::App& app);
Action add_completion(CLI::App& app);
Action add_config(CLI::App& app);
Action add_convert(CLI::App& app);
Action add_devices(CLI::App& app);
Action add_diff(CLI::App& app);
Action add_doctor(CLI::App& app);
Action add_render(CLI::App& app);
Action add_import(CLI::App& app);
Action add_info(CLI::App& app);
Action add_man(CLI::App& app);
Action add_merge(CLI::App& app);
Action add_stress(CLI::App& app);
Action add_view(CLI::App& app);
Action add_warm(CLI::App& app);
Action add_voxelize(CLI::App& app);

}  // namespace voxelume::cli
