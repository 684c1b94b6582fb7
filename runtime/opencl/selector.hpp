// SPDX-License-Identifier: Apache-2.0
// The selectors with which a user chooses devices: auto, cpu, gpu, all, all/N, an index, part of a
// name.
#pragma once

#include <string_view>

#include "runtime/opencl/device.hpp"

namespace voxelume {

/// Returns 1 for the selector "all", N for "all/N", 0 for others. Throws Error::usage if N is no
/// number.
int parts_of_all(std::string_view selector);

/// True if `selector` names the device; "all" and "auto" name every device.
bool names_device(std::string_view selector, const DeviceInfo& info);

/// True if `selector` is an index or part of a name: it means that device and no other.
bool names_one_device(std::string_view selector);

}  // namespace voxelume
