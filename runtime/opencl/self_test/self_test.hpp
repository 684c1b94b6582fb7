// SPDX-License-Identifier: Apache-2.0
// A driver's self-test: operations on which images depend, run on a device and compared with known
// answers.
#pragma once

#include <optional>
#include <string>

#include "runtime/opencl/device.hpp"

namespace voxelume {

/// The first fault in the device's answers, in words for people; empty if all are right.
///
/// Tests arithmetic with floats and long integers, atomic operations, private arrays, long loops,
/// and the walks of sixteen rays through a small world, with the code and the numbers of lanes that
/// images use. Takes two launches.
std::string find_fault(const Device& device);

/// The value of VOXELUME_SELF_TEST.
enum class SelfTestMode {
    once,   ///< not set: the first time that a device is opened with a driver
    again,  ///< "again": every time
    off,    ///< "off": never; faults that were found before don't matter
};

/// The mode. Throws Error::usage for another value of the variable.
SelfTestMode self_test_mode();

/// The kept result of a device's self-test: a fault, or an empty text. Without a value if the
/// device wasn't tested with this driver, number of lanes and compiler's options.
std::optional<std::string> kept_fault(const DeviceInfo& info);

/// The result of a self-test that this process made or read.
std::optional<std::string> fresh_fault(const DeviceInfo& info);

/// Keeps a result below `cache_folder()`, and for this process.
void keep_fault(const DeviceInfo& info, const std::string& fault);

}  // namespace voxelume
