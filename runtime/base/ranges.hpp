// SPDX-License-Identifier: Apache-2.0
// Work on ranges of numbers, on all cores.
#pragma once

#include <algorithm>
#include <future>
#include <thread>
#include <vector>

namespace voxelume {

/// Calls `use(first, end)` for ranges that cover the numbers from 0 to `count`, at the same time.
/// Throws what one of the calls threw, when all have ended.
template <class Use>
void for_ranges(int count, const Use& use) {
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
