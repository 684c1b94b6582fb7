// SPDX-License-Identifier: Apache-2.0
// Work on ranges of numbers, on all cores.
#pragma once

#include <algorithm>
#include <cstdint>
#include <future>
#include <thread>
#include <vector>

namespace voxelume {

/// Calls `use(first, end)` for ranges that cover the numbers from 0 to `count`, at the same time if
/// `steps`, about how many values all calls look at, are worth threads. Throws what one of the
/// calls threw, when all have ended.
template <class Use>
void for_ranges(int count, uint64_t steps, const Use& use) {
    constexpr uint64_t kFewSteps = 4096;  // take less time than threads take to begin
    if (steps < kFewSteps) return use(0, count);
    constexpr unsigned kMaxRanges = 8;  // each may hold memory of its own
    const int ranges = int(std::clamp(std::thread::hardware_concurrency(), 1u, kMaxRanges));
    const auto bound = [&](int range) { return int(int64_t{count} * range / ranges); };
    std::vector<std::future<void>> others;
    for (int i = 1; i < ranges; ++i)
        if (bound(i) < bound(i + 1)) others.push_back(std::async(use, bound(i), bound(i + 1)));
    if (bound(0) < bound(1)) use(bound(0), bound(1));
    for (std::future<void>& other : others) other.get();
}

}  // namespace voxelume
