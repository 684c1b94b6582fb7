// The tests of `voxelume stress`: what a device does, held against exact arithmetic on the host.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "runtime/opencl/device.hpp"

namespace voxelume {

/// Which cases of a test are tried. A case depends on the seed and its number alone.
struct StressRun {
    const Device& device;
    uint64_t seed = 1;
    uint64_t first = 0, count = 0;
    /// Told after every batch how many cases it had.
    std::function<void(uint64_t)> advance;
};

/// What came out.
struct StressResult {
    uint64_t cases = 0;
    uint64_t mismatches = 0;
    uint64_t cells = 0;                 ///< compared, as far as the test counts them
    std::vector<std::string> examples;  ///< of the first mismatches: the input, and what differs
};

inline constexpr size_t kMostExamples = 5;

/// Counts the mismatch of a case; `describe(text)` is asked for the first ones only.
template <class Describe>
void note_mismatch(StressResult& result, uint64_t number, const Describe& describe) {
    ++result.mismatches;
    if (result.examples.size() < kMostExamples)
        result.examples.push_back("case " + std::to_string(number) + ": " + describe());
}

struct StressTest {
    std::string name;
    std::string help;            ///< one line: what its cases are
    uint64_t rays_per_case = 1;  ///< a case costs about as much as so many rays
    std::function<StressResult(const StressRun&)> run;
};

/// All tests, in the order in which they run.
const std::vector<StressTest>& stress_tests();

/// Calls `work(i)` for 0 .. count-1 on all of the host's cores.
void for_each_in_parallel(uint64_t count, const std::function<void(uint64_t)>& work);

}  // namespace voxelume
