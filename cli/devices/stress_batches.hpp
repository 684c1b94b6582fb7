// SPDX-License-Identifier: Apache-2.0
// One test of `stress` -> its cases in batches, and what they find.
#pragma once

#include <stop_token>

#include "cli/devices/stress_again.hpp"
#include "runtime/voxelume_verify.hpp"

namespace voxelume::cli {

/// Runs a test and prints its line. The first mismatches are printed as they are found, every half
/// a minute or so, so that a run that is ended early has told them.
StressResult run_in_batches(const StressTest& test, const StressCommand& command,
                            const Device& device, const std::stop_token& stop);

}  // namespace voxelume::cli
