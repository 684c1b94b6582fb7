// SPDX-License-Identifier: Apache-2.0
// Settings of devices from the environment.
#pragma once

#include <string>
#include <string_view>

#include "runtime/opencl/device.hpp"

namespace voxelume {

/// `selector`, or VOXELUME_DEVICE if it is empty, or else "auto".
std::string selector_or_default(std::string_view selector);

/// Limits a device's memory as VOXELUME_MEMORY_MB, VOXELUME_BUFFER_MB and the process's limits say.
/// A CPU's memory is main memory.
void limit_memory(DeviceInfo& info);

/// A device with the settings with which it is opened: `lanes`, or VOXELUME_LANES if `lanes` is 0,
/// or else its own; the limits of its memory, VOXELUME_WORK_GROUP, VOXELUME_BATCH and
/// VOXELUME_BUILD_OPTIONS. Throws Error::usage for impossible values.
DeviceInfo settled(DeviceInfo info, int lanes);

/// VOXELUME_UNITS; 0 if it isn't set.
int units_to_use();

}  // namespace voxelume
