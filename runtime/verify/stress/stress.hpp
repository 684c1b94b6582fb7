// The tests of `voxelume stress`: what a device does, held against exact arithmetic on the host.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "runtime/opencl/device.hpp"

namespace voxelume {

/// Which cases of a test are tried. A case depends on the seed and its number alone: one that is
/// tried again goes through the device beside the same other ones.
struct StressRun {
    const Device& device;
    uint64_t seed = 1;
    uint64_t first = 0, count = 0;
    /// Told after every batch how many cases it had.
    std::function<void(uint64_t)> advance;
    /// Asked before every batch whether the run is to end before its time; empty: never.
    std::function<bool()> is_over{};
};

/// A case that came out wrong.
struct StressExample {
    uint64_t number = 0;  ///< StressRun::first of a run of this case alone
    std::string text;     ///< the input, and what differs

    friend bool operator==(const StressExample&, const StressExample&) = default;
};

/// What came out.
struct StressResult {
    uint64_t cases = 0;
    uint64_t mismatches = 0;
    uint64_t cells = 0;                   ///< compared, as far as the test counts them
    std::vector<StressExample> examples;  ///< of the first mismatches
};

/// Cases that go through the device together, and which of them are compared.
struct StressBatch {
    uint64_t start = 0;         ///< the number of its first case
    size_t size = 0;            ///< cases that go through the device: always the same of a batch
    size_t first = 0, end = 0;  ///< those to compare, counted from `start`
};

/// Calls `work(batch)` for batches of `size` cases that begin at multiples of it, until they hold
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

/// Counts the mismatch of a case; `describe(text)` is asked for the first ones only.
template <class Describe>
void note_mismatch(StressResult& result, uint64_t number, const Describe& describe) {
    ++result.mismatches;
    if (result.examples.size() < kMaxExamples) result.examples.push_back({number, describe()});
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
