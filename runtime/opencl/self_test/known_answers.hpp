// SPDX-License-Identifier: Apache-2.0
// The questions of a driver's self-test with their answers. The answers were computed in exact
// arithmetic, not by a driver; tests/opencl/self_test_test.cpp computes them again in another way.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "kernels/shared/self_test.h"

namespace voxelume {

/// One row of questions or answers.
struct KnownRow {
    const char* what;  ///< subject of the row, in words for people
    std::array<uint32_t, VXL_KNOWN_COLUMNS> words;
};

/// The rows of questions, in the order of shared/self_test.h, without the last: rays have no end.
std::span<const KnownRow> known_questions();
/// The right answers, in the order of shared/self_test.h.
std::span<const KnownRow> known_answers();
/// The voxels of the world through which rays go, in no order.
std::span<const std::array<uint8_t, 3>> known_voxels();

}  // namespace voxelume
