// What a user may write to choose devices: auto, cpu, gpu, all, all/N, an index, part of a name.
#pragma once

#include <string_view>

#include "runtime/opencl/device.hpp"

namespace voxelume {

/// 1 for the selector "all", N for "all/N", 0 for others. Throws Error::usage where N is no number.
int parts_of_all(std::string_view selector);

/// Whether `selector` names the device; "all" and "auto" name every one.
bool names_device(std::string_view selector, const DeviceInfo& info);

}  // namespace voxelume
