// SPDX-License-Identifier: Apache-2.0
// The number of combinations of settings that a test tries.
#pragma once

#include <cstddef>
#include <cstdlib>
#include <vector>

namespace voxelume {

/// True in `./bootstrap.sh test --all`, which sets VXL_TEST_ALL.
inline bool is_exhaustive() {
    return std::getenv("VXL_TEST_ALL") != nullptr;
}

/// All of `values` in an exhaustive run, otherwise only the one whose turn it is. Each value makes
/// kernels compile again: tests of several scenes take turns, so that each value still occurs with
/// some scene.
template <class T>
std::vector<T> in_turn(const std::vector<T>& values, size_t turn) {
    if (is_exhaustive()) return values;
    return {values[turn % values.size()]};
}

/// One lane and, in an exhaustive run, 4, 8 and 16, otherwise the number of these whose turn it is.
inline std::vector<int> lanes_to_compare(size_t turn) {
    std::vector<int> lanes = in_turn<int>({4, 8, 16}, turn);
    lanes.insert(lanes.begin(), 1);
    return lanes;
}

/// Why a test is skipped by default.
inline constexpr const char* kOnlyWithAll = "`./bootstrap.sh test --all` runs it";

}  // namespace voxelume
