// SPDX-License-Identifier: Apache-2.0
// voxelume stress: compares what a device computes with exact arithmetic, case after case.
#include <CLI/CLI.hpp>
#include <chrono>
#include <memory>
#include <span>
#include <stop_token>
#include <string>
#include <vector>

#include "cli/devices/stress_again.hpp"
#include "cli/shared/checks.hpp"
#include "cli/shared/commands.hpp"
#include "cli/shared/interrupt.hpp"
#include "cli/shared/progress.hpp"
#include "cli/shared/tell.hpp"
#include "runtime/voxelume_verify.hpp"

namespace voxelume::cli {
namespace {

/// An interrupted run ends after its current batch, whose kernel may still have to be compiled. A
/// second Ctrl-C ends the program.
constexpr std::chrono::minutes kGrace{10};

/// The named tests, each once, in the order in which they are named; all tests if none is named.
std::vector<StressTest> chosen_tests(const std::vector<std::string>& only) {
    std::vector<StressTest> tests = stress_tests();
    if (only.empty()) return tests;
    std::vector<StressTest> chosen;
    std::vector<std::string_view> names;
    names.reserve(tests.size());
    for (const StressTest& test : tests) names.push_back(test.name);
    for (const std::string& name : chosen_names(only, names, "stress", "test"))
        if (std::ranges::find(chosen, name, &StressTest::name) == chosen.end())
            chosen.push_back(tests[size_t(std::ranges::find(names, name) - names.begin())]);
    return chosen;
}

void print_examples(const StressTest& test, std::span<const StressExample> examples,
                    const StressCommand& command) {
    for (const StressExample& example : examples)
        fmt::print("  {} case {}: {}\n    again: {}\n", test.name, example.number, example.text,
                   command_for(test.name, example.number, command));
    std::fflush(stdout);
}

/// Runs a test and prints its line. The first mismatches are printed as they are found, about every
/// half minute, so that a run that is ended early has reported them.
StressResult run_test(const StressTest& test, const StressCommand& command, const Device& device,
                      const std::stop_token& stop) {
    constexpr uint64_t kRaysAtOnce = 1 << 25;
    const auto start = std::chrono::steady_clock::now();
    const uint64_t count = std::max<uint64_t>(1, uint64_t(command.rays) / test.rays_per_case);
    const uint64_t at_once = std::max<uint64_t>(1, kRaysAtOnce / test.rays_per_case);
    StressResult all;
    for (uint64_t done = 0; done < count && !stop.stop_requested(); done += at_once) {
        const uint64_t now = std::min(count - done, at_once);
        StressResult part;
        {
            Progress bar(fmt::format("{} {} of {}", test.name, done / at_once + 1,
                                     (count + at_once - 1) / at_once),
                         now, stderr, command.quiet ? Drawing::never : Drawing::where_watched);
            const auto advance = [&](uint64_t cases) { bar.advance(cases); };
            part = run_stress(test.name, device,
                              {command.seed, command.first + done, now, advance, stop});
        }
        all.cases += part.cases;
        all.mismatches += part.mismatches;
        part.examples.resize(
            std::min(part.examples.size(), kMaxStressExamples - all.examples.size()));
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
    const std::vector<StressTest> tests = chosen_tests(command.only);
    const Device device = Device::open(command.device);
    if (!command.quiet)
        tell("\"{}\", {} lanes, seed {}\n", device.info().name, device.lanes(), command.seed);
    const Interruptible interruptible(kGrace);
    const std::stop_token stop = interruptible.stop();
    uint64_t cases = 0, mismatches = 0;
    for (const StressTest& test : tests) {
        if (stop.stop_requested()) break;
        const StressResult result = run_test(test, command, device, stop);
        cases += result.cases;
        mismatches += result.mismatches;
    }
    if (stop.stop_requested()) {
        tell_interruption(
            [&] { tell("interrupted after {} cases, {} mismatches\n", cases, mismatches); });
        return interrupted_code();
    }
    return mismatches == 0 ? 0 : 1;
}

std::string list_of_tests() {
    std::string list =
        "run only these tests: a name, or names separated by commas; may be given again:";
    for (const StressTest& test : stress_tests())
        list += fmt::format("\n{:<12}{}", test.name, test.help);
    return list;
}

}  // namespace

Action add_stress(CLI::App& app) {
    const auto command = std::make_shared<StressCommand>();
    app.add_option("--rays", command->rays,
                   "rays of every class, 1e6 by default; other tests scale with it")
        ->check(in_range(1, 1e15));
    app.add_option("--seed", command->seed, "seed of the cases, 1 by default")
        ->check(in_range(0, 1e18, Number::whole));
    app.add_option("--only", command->only, list_of_tests())
        ->type_name("TESTS")
        ->allow_extra_args(false);
    app.add_option("--first", command->first, "number of the first case, to repeat one")
        ->check(in_range(0, 1e18, Number::whole));
    app.add_option("--device", command->device,
                   "device: auto, cpu, gpu, a number, or part of a name")
        ->type_name("DEVICE")
        ->check(one_device);
    app.add_flag("-q,--quiet", command->quiet, "print no progress bar");
    return [command] { return run(*command); };
}

}  // namespace voxelume::cli
