// voxelume stress: what a device does, held against exact arithmetic, case after case.
#include <CLI/CLI.hpp>
#include <array>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "cli/checks.hpp"
#include "cli/commands.hpp"
#include "cli/progress.hpp"
#include "runtime/base/error.hpp"
#include "runtime/opencl/device.hpp"
#include "runtime/verify/stress/stress.hpp"

namespace voxelume::cli {
namespace {

constexpr int kInterruptedCode = 130;

volatile std::sig_atomic_t is_interrupted = 0;

/// Has the first Ctrl-C end a run after the batch that it is in; a second one ends the program.
/// Where none is to be heard, as in the background of a script, that stays.
void wait_for_interrupt() {
    struct sigaction action {};
    if (sigaction(SIGINT, nullptr, &action) == 0 && action.sa_handler == SIG_IGN) return;
    action.sa_handler = [](int) { is_interrupted = 1; };
    action.sa_flags = int(SA_RESETHAND);
    sigaction(SIGINT, &action, nullptr);
}

struct StressCommand {
    double rays = 1e6;
    uint64_t seed = 1;
    std::vector<std::string> only;
    uint64_t first = 0;
    std::string device;
    bool quiet = false;
};

std::vector<const StressTest*> chosen_tests(const std::vector<std::string>& only) {
    std::vector<const StressTest*> chosen;
    std::vector<std::string_view> names;
    for (const StressTest& test : stress_tests()) {
        names.push_back(test.name);
        if (only.empty()) chosen.push_back(&test);
    }
    for (const std::string& name : chosen_names(only, names, "stress", "test")) {
        const auto known = std::ranges::find(names, name);
        const StressTest* test = &stress_tests()[size_t(known - names.begin())];
        if (std::ranges::find(chosen, test) == chosen.end()) chosen.push_back(test);
    }
    return chosen;
}

/// Variables of the environment that change what a device does.
constexpr std::array kSettings = {
    "VOXELUME_DEVICE",    "VOXELUME_LANES",         "VOXELUME_WORK_GROUP",   "VOXELUME_UNITS",
    "VOXELUME_BUFFER_MB", "VOXELUME_BUILD_OPTIONS", "POCL_MAX_PTHREAD_COUNT"};

/// A word of a shell's line.
std::string shell_word(const std::string& text) {
    const char* plain = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789-_=+,./:@%";
    if (!text.empty() && text.find_first_not_of(plain) == std::string::npos) return text;
    std::string word = "'";
    for (const char c : text) word += c == '\'' ? "'\\''" : std::string(1, c);
    return word + "'";
}

/// The line that tries one case again, beside those that it was tried with.
std::string command_for(const StressTest& test, uint64_t number, const StressCommand& command) {
    std::string text;
    for (const char* name : kSettings)
        if (const char* value = std::getenv(name); value && *value)
            text += fmt::format("{}={} ", name, shell_word(value));
    text += fmt::format("voxelume stress --only {} --seed {} --rays 1 --first {}", test.name,
                        command.seed, number);
    if (!command.device.empty()) text += " --device " + shell_word(command.device);
    return text;
}

void print_examples(const StressTest& test, std::span<const StressExample> examples,
                    const StressCommand& command) {
    for (const StressExample& example : examples)
        fmt::print("  {} case {}: {}\n    again: {}\n", test.name, example.number, example.text,
                   command_for(test, example.number, command));
    std::fflush(stdout);
}

/// Runs a test and prints its line. The first mismatches are printed as they are found, every half
/// a minute or so, so that a run that is ended early has told them.
StressResult run_test(const StressTest& test, const StressCommand& command, const Device& device) {
    constexpr uint64_t kRaysAtOnce = 1 << 25;
    const auto start = std::chrono::steady_clock::now();
    const uint64_t count = std::max<uint64_t>(1, uint64_t(command.rays) / test.rays_per_case);
    const uint64_t at_once = std::max<uint64_t>(1, kRaysAtOnce / test.rays_per_case);
    StressResult all;
    for (uint64_t done = 0; done < count && !is_interrupted; done += at_once) {
        const uint64_t now = std::min(count - done, at_once);
        StressResult part;
        {
            Progress bar(fmt::format("{} {} of {}", test.name, done / at_once + 1,
                                     (count + at_once - 1) / at_once),
                         now, stderr, command.quiet);
            part = test.run({device, command.seed, command.first + done, now,
                             [&bar](uint64_t cases) { bar.advance(cases); },
                             [] { return is_interrupted != 0; }});
        }
        all.cases += part.cases;
        all.mismatches += part.mismatches;
        part.examples.resize(std::min(part.examples.size(), kMaxExamples - all.examples.size()));
        all.examples.insert(all.examples.end(), part.examples.begin(), part.examples.end());
        print_examples(test, part.examples, command);
    }
    const double seconds =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    fmt::print("{:<12}{:>14} cases {:>10} mismatches {:>10.1f} s\n", test.name, all.cases,
               all.mismatches, seconds);
    std::fflush(stdout);
    return all;
}

int run(const StressCommand& command) {
    const std::vector<const StressTest*> tests = chosen_tests(command.only);
    wait_for_interrupt();
    const Device device = Device::open(command.device);
    if (!command.quiet)
        fmt::print(stderr, "\"{}\", {} lanes, seed {}\n", device.info().name, device.lanes(),
                   command.seed);
    uint64_t cases = 0, mismatches = 0;
    for (const StressTest* test : tests) {
        if (is_interrupted) break;
        const StressResult result = run_test(*test, command, device);
        cases += result.cases;
        mismatches += result.mismatches;
    }
    if (is_interrupted) {
        fmt::print(stderr, "interrupted: {} cases till then, {} mismatches\n", cases, mismatches);
        return kInterruptedCode;
    }
    return mismatches == 0 ? 0 : 1;
}

std::string list_of_tests() {
    std::string list =
        "of these tests only, each once: a name, or names with commas; may be given again:";
    for (const StressTest& test : stress_tests())
        list += fmt::format("\n{:<12}{}", test.name, test.help);
    return list;
}

}  // namespace

Action add_stress(CLI::App& app) {
    const auto command = std::make_shared<StressCommand>();
    app.add_option("--rays", command->rays,
                   "rays of every class, 1e6 without; other tests try in proportion")
        ->check(in_range(1, 1e15));
    app.add_option("--seed", command->seed, "of the cases, 1 without")
        ->check(in_range(0, 1e18, Number::whole));
    app.add_option("--only", command->only, list_of_tests())->allow_extra_args(false);
    app.add_option("--first", command->first, "number of the first case, to try one again")
        ->check(in_range(0, 1e18, Number::whole));
    app.add_option("--device", command->device, "auto, cpu, gpu, a number, or part of a name")
        ->check(one_device);
    app.add_flag("-q,--quiet", command->quiet, "no progress bar");
    return [command] { return run(*command); };
}

}  // namespace voxelume::cli
