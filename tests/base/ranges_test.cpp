// SPDX-License-Identifier: Apache-2.0
#include "runtime/base/ranges.hpp"

#include <gmock/gmock.h>

#include <atomic>
#include <stdexcept>

namespace voxelume {
namespace {

TEST(Ranges, CoverEachNumberOnce) {
    for (const uint64_t steps : {uint64_t{1}, uint64_t{1} << 20})
        for (const int count : {0, 1, 2, 7, 1000}) {
            std::vector<std::atomic<int>> used(size_t(count) + 1);
            for_ranges(count, steps, [&](int first, int end) {
                for (int i = first; i < end; ++i) ++used[size_t(i)];
            });
            for (int i = 0; i < count; ++i) ASSERT_EQ(used[size_t(i)], 1) << count << ' ' << i;
            EXPECT_EQ(used[size_t(count)], 0) << count;
        }
}

TEST(Ranges, OfFewStepsAreOne) {
    std::atomic<int> calls = 0;
    for_ranges(1000, 4095, [&](int first, int end) {
        EXPECT_EQ(first, 0);
        EXPECT_EQ(end, 1000);
        ++calls;
    });
    EXPECT_EQ(calls, 1);
}

TEST(Ranges, PassErrorsOnWhenAllHaveEnded) {
    for (const uint64_t steps : {uint64_t{1}, uint64_t{1} << 20}) {
        std::atomic<int> begun = 0, ended = 0;
        EXPECT_THROW(for_ranges(1000, steps,
                                [&](int first, int end) {
                                    ++begun;
                                    if (end == 1000) throw std::runtime_error("the last range");
                                    EXPECT_LT(first, end);
                                    ++ended;
                                }),
                     std::runtime_error);
        EXPECT_EQ(ended, begun - 1);
    }
}

}  // namespace
}  // namespace voxelume
