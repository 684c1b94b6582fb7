// SPDX-License-Identifier: Apache-2.0
// voxelume stress: compares what a device computes with exact arithmetic, case after case.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <memory>
#include <stop_token>
#include <string>
#include <vector>

#include "cli/devices/stress_again.hpp"
#include "cli/devices/stress_batches.hpp"
#include "cli/shared/checks.hpp"
#include "cli/shared/commands.hpp"
#include "cli/shared/interrupt.hpp"
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
        const StressResult result = run_in_batches(test, command, device, stop);
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
