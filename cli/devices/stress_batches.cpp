// SPDX-License-Identifier: Apache-2.0
#include "cli/devices/stress_batches.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <span>

#include "cli/shared/progress.hpp"

namespace voxelume::cli {
namespace {

void print_examples(const StressTest& test, std::span<const StressExample> examples,
                    const StressCommand& command) {
    for (const StressExample& example : examples)
        fmt::print("  {} case {}: {}\n    again: {}\n", test.name, example.number, example.text,
                   command_for(test.name, example.number, command));
    std::fflush(stdout);
}

}  // namespace

StressResult run_in_batches(const StressTest& test, const StressCommand& command,
                            const Device& device, const std::stop_token& stop) {
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

}  // namespace voxelume::cli
