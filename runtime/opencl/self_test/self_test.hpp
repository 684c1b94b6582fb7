// SPDX-License-Identifier: Apache-2.0
// A driver's self-test: what images depend on, asked of a device, against answers that are known.
#pragma once

#include <optional>
#include <string>

#include "runtime/opencl/device.hpp"

namespace voxelume {

/// The fault of the device in words for people, the first that its answers show; empty if all are
/// right.
///
/// Asks for arithmetic with floats and long integers, atomic operations, private arrays, and the
/// walks of sixteen rays through a small world, in code and numbers of lanes that images use. Takes
/// two launches.
std::string find_fault(const Device& device);

/// What VOXELUME_SELF_TEST asks for.
enum class SelfTestMode {
    once,   ///< not set: the first time that a device is opened with a driver
    again,  ///< "again": every time
    off,    ///< "off": never; faults that were found before don't matter
};

/// Throws Error::usage for another value of the variable.
SelfTestMode self_test_mode();

/// The result that is kept of a device's self-test: a fault, or an empty text; nothing if it wasn't
/// tested with this driver, for this number of lanes and these compiler's options.
std::optional<std::string> kept_fault(const DeviceInfo& info);

/// The result of a self-test that this process made or read.
std::optional<std::string> fresh_fault(const DeviceInfo& info);

/// Keeps a result below `cache_folder()`, and for this process.
void keep_fault(const DeviceInfo& info, const std::string& fault);

}  // namespace voxelume
