// SPDX-License-Identifier: Apache-2.0
// The tests of `voxelume stress`: they compare a device's results with exact arithmetic on the
// host.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "runtime/opencl/device.hpp"

namespace voxelume {

/// The cases of a test to try. A case depends on the seed and its number alone. A case that is
/// tried again goes through the device together with the same other cases.
struct StressRun {
    const Device& device;
    uint64_t seed = 1;
    uint64_t first = 0, count = 0;
    /// Called after every batch with the number of its cases.
    std::function<void(uint64_t)> advance;
    /// Called before every batch. Returns true to end the run early; if empty, the run never ends
    /// early.
    std::function<bool()> is_over{};
};

/// A case with a wrong result.
struct StressExample {
    uint64_t number = 0;  ///< the value of StressRun::first for a run of this case alone
    std::string text;     ///< the input, and the difference

    friend bool operator==(const StressExample&, const StressExample&) = default;
};

/// The result of a run.
struct StressResult {
    uint64_t cases = 0;
    uint64_t mismatches = 0;
    uint64_t cells = 0;                   ///< cells compared, as far as the test counts them
    std::vector<StressExample> examples;  ///< examples of the first mismatches
};

/// Cases that go through the device together, and those of them that are compared.
struct StressBatch {
    uint64_t start = 0;         ///< number of the first case
    size_t size = 0;            ///< number of cases that go through the device; equal for all
                                ///< batches of a test
    size_t first = 0, end = 0;  ///< cases to compare, counted from `start`
};

/// Calls `work(batch)` for batches of `size` cases that begin at multiples of it, until they cover
/// all cases of the run, or it is over.
template <class Work>
void for_each_batch(const StressRun& run, size_t size, const Work& work) {
    const uint64_t end = run.first + run.count;
    for (uint64_t start = run.first / size * size; start < end; start += size) {
        if (run.is_over && run.is_over()) return;
        StressBatch batch{start, size, 0, size};
        if (run.first > start) batch.first = size_t(run.first - start);
        if (end - start < size) batch.end = size_t(end - start);
        work(batch);
        if (run.advance) run.advance(batch.end - batch.first);
    }
}

inline constexpr size_t kMaxExamples = 5;

/// Counts the mismatch of a case. `describe()` is called for the first mismatches only.
template <class Describe>
void note_mismatch(StressResult& result, uint64_t number, const Describe& describe) {
    ++result.mismatches;
    if (result.examples.size() < kMaxExamples) result.examples.push_back({number, describe()});
}

struct StressTest {
    std::string name;
    std::string help;            ///< one line that says what the cases are
    uint64_t rays_per_case = 1;  ///< cost of a case, in rays
    std::function<StressResult(const StressRun&)> run;
};

/// All tests, in the order in which they run.
const std::vector<StressTest>& stress_tests();

/// Calls `work(i)` for 0 .. count-1 on all of the host's cores.
void for_each_in_parallel(uint64_t count, const std::function<void(uint64_t)>& work);

}  // namespace voxelume
