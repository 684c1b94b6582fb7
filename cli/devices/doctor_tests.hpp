// SPDX-License-Identifier: Apache-2.0
// A self-test of every kernel of a device, for `doctor`.
#pragma once

#include <stop_token>

#include "cli/shared/report.hpp"
#include "runtime/voxelume.hpp"

namespace voxelume::cli {

struct DeviceTests {
    Report report;  ///< tables: "tests" against exact arithmetic, "pictures", and all "kernels"
    bool are_right = true;
};

/// Compares the device with exact arithmetic, and its pictures with their known hashes. A kernel is
/// right if all tests that launch it are. With `as_json`, a row lists all tests of its kernel,
/// otherwise the first. Throws the errors of rendering.
DeviceTests test_all_kernels(const Device& device, bool as_json, const std::stop_token& stop);

}  // namespace voxelume::cli
