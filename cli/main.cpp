// SPDX-License-Identifier: Apache-2.0
// The program `voxelume`: finds the command in its table, reads the options, runs the command and
// turns failures into exit codes.
#include <fcntl.h>
#include <malloc.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <climits>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <new>
#include <string>
#include <thread>

#include "cli/shared/build_facts.hpp"
#include "cli/shared/checks.hpp"
#include "cli/shared/commands.hpp"
#include "cli/shared/complaint.hpp"
#include "cli/shared/interrupt.hpp"
#include "cli/shared/settings.hpp"

namespace voxelume::cli {
namespace {

int print_help() {
    fmt::print("voxelume {}: images of voxel worlds, flat and volumetric\n\n", version());
    fmt::print("Usage: voxelume COMMAND [OPTIONS], options in any order\n\nCommands:\n");
    for (const Command& command : commands())
        fmt::print("  {:<12}{}\n", command.name, command.help);
    fmt::print("  {:<12}{}\n\n", "help", "print this, or a command's options: `help COMMAND`");
    fmt::print("{}", exit_codes_text());
    return 0;
}

const Command& find_command(const std::string& name) {
    std::vector<std::string_view> names = {"help"};
    for (const Command& command : commands()) {
        if (name == command.name) return command;
        names.emplace_back(command.name);
    }
    fail_usage("no command named {}{}", quote(name), suggest(name, names));
}

/// The first option or argument that `app` doesn't know, as part of a sentence.
std::string describe_extra(const CLI::App& app) {
    const std::string extra = app.remaining().front();
    if (!extra.starts_with('-')) return fmt::format("one argument too many: {}", quote(extra));
    std::vector<std::string> names;
    for (const CLI::Option* option : app.get_options())
        for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
    return fmt::format("no option named {}{}", quote(extra),
                       suggest(extra, std::vector<std::string_view>(names.begin(), names.end())));
}

int run_command(const Command& command, std::vector<std::string> arguments) {
    CLI::App app(command.help, fmt::format("voxelume {}", command.name));
    const Action action = command.add(app);
    try {
        std::reverse(arguments.begin(), arguments.end());  // CLI11 takes arguments from the back
        app.parse(std::move(arguments));
    } catch (const CLI::CallForHelp&) {
        fmt::print("{}", app.help());
        return 0;
    } catch (const CLI::ExtrasError&) {
        fail_usage("{}: {}", command.name, describe_extra(app));
    } catch (const CLI::ParseError& error) {
        fail_usage("{}: {}; see `voxelume help {}`", command.name, error.what(), command.name);
    }
    return action();
}

int run(std::vector<std::string> arguments) {
    if (arguments.empty()) fail_usage("a command is missing; `voxelume help` lists them");
    const std::string first = arguments.front();
    arguments.erase(arguments.begin());
    if (first == "--version") {
        fmt::print("voxelume {}\n{}", version(), build_facts());
        return 0;
    }
    const bool asks_for_help = first == "help" || first == "--help" || first == "-h";
    if (asks_for_help && arguments.empty()) return print_help();
    if (asks_for_help) return run_command(find_command(arguments.front()), {"--help"});
    if (first.starts_with('-'))
        fail_usage("the command comes before its options: voxelume COMMAND {}", first);
    return run_command(find_command(first), std::move(arguments));
}

/// Loads the settings. A mistake in their file ends commands that render; commands that help to
/// find the mistake only report it. Returns the exit code of `config`.
int load_settings_for(const std::string& command) try {
    load_settings();
    return 0;
} catch (const Error& error) {
    constexpr std::array kHelpers = {"--version", "help", "--help",     "-h",
                                     "doctor",    "man",  "completion", "config"};
    if (std::ranges::find(kHelpers, command) == kHelpers.end()) throw;
    const int code = complain(error.what(), error.kind());
    return command == "config" ? code : 0;
}

std::string stdout_failure() {
    return fmt::format("can't write to standard output: {}", std::strerror(errno));
}

/// Throws if what was printed did not arrive: `voxelume info x >/dev/full` has failed.
void flush_stdout() {
    if (std::fflush(stdout) != 0 || std::ferror(stdout) != 0)
        throw Error(ErrorKind::output, stdout_failure());
}

/// Opens standard streams that the caller has closed, so that no file or pipe gets their numbers:
/// otherwise `-` would read from the program itself, and messages would be written into images.
/// Reading from and writing to the streams opened here fails.
void open_closed_streams() {
    for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
        if (::fcntl(stream, F_GETFD) == -1 && errno == EBADF &&
            ::open("/dev/null", stream == STDIN_FILENO ? O_WRONLY : O_RDONLY) == -1)
            return;
}

/// The number of helper processes that may compile while a command runs, if the command makes
/// pictures: VOXELUME_COMPILERS, otherwise one if a core is idle. An image has one program, so more
/// helpers would have nothing to do; on busy cores even one would take time from other work and
/// save none.
int kernel_compilers(const std::string& command) {
    constexpr std::array kHelped = {"render", "view"};
    if (std::ranges::find(kHelped, command) == kHelped.end()) return 0;
    if (const char* const value = std::getenv("VOXELUME_COMPILERS"); value && *value)
        return std::clamp(std::atoi(value), 0, kMaxKernelCompilers);
    // Other programs of a pipe, which start together with this one, run for a moment only.
    for (int looks = 5; idle_cores() <= 0;
         std::this_thread::sleep_for(std::chrono::milliseconds(3)))
        if (--looks == 0) return 0;
    return 1;
}

/// Keeps freed memory in the process: on a CPU, buffers of some hundred megabytes come and go with
/// every frame, and the system would clear each of their pages again. Measured at 1024 x 1024
/// pixels: 75 -> 12 ms per frame outside of kernels. All threads share one heap, because PoCL's
/// workers take aligned pieces that glibc 2.36 doesn't reuse in their own heaps: 21 kB per frame.
void keep_freed_memory() {
#ifdef __GLIBC__
    mallopt(M_MMAP_THRESHOLD, 1 << 30);
    mallopt(M_TRIM_THRESHOLD, INT_MAX);
    mallopt(M_TOP_PAD, 64 << 20);
    mallopt(M_ARENA_MAX, 1);
#endif
}

/// Runs the command and returns the program's exit code. What is thrown becomes one line.
int run_command(int count, char** arguments) {
    try {
        const std::string command = count > 1 ? arguments[1] : "";
        const int fault = load_settings_for(command);
        // This comes before there are threads, so that all of them ignore what this one does.
        handle_interrupts();
        configure({.set_driver_environment = true,
                   .isolate_readers = true,
                   .kernel_compilers = kernel_compilers(command),
                   .image_threads = int(std::thread::hardware_concurrency())});
        const int code = run({arguments + (count > 0 ? 1 : 0), arguments + count});
        flush_stdout();
        return code == 0 ? fault : code;
    } catch (const Error& error) {
        if (error.kind() == ErrorKind::cancelled) {
            tell_interruption([&] { complain(error.what(), error.kind()); });
            return interrupted_code();
        }
        return complain(error.what(), error.kind());
    } catch (const std::bad_alloc&) {
        return complain("out of memory: use fewer or larger voxels, or a smaller picture",
                        ErrorKind::limit);
    } catch (const std::filesystem::filesystem_error& error) {
        return complain(fmt::format("{}: {}", error.path1().string(), error.code().message()),
                        ErrorKind::output);
    } catch (const std::exception& error) {
        if (std::ferror(stdout) != 0) return complain(stdout_failure(), ErrorKind::output);
        return complain(error.what(), ErrorKind::render);
    }
}

}  // namespace
}  // namespace voxelume::cli

int main(int count, char** arguments) {
    namespace cli = voxelume::cli;
    // If a file reaches `ulimit -f`, the write fails like any other; the process doesn't end.
    std::signal(SIGXFSZ, SIG_IGN);
    cli::open_closed_streams();
    cli::keep_freed_memory();
    const int code = cli::run_command(count, arguments);
    cli::end_interrupts();
    return code;
}
