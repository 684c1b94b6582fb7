// SPDX-License-Identifier: Apache-2.0
// What an earlier process found of the device that a selector names.
#pragma once

#include <string_view>

#include "runtime/opencl/device.hpp"

namespace voxelume {

/// The facts of the device that Device::open would open for `selector`, of `all` and `all/N` the
/// first that Device::open_all would open, for plans: drivers take ten times as long to load as a
/// small scene does to plan.
///
/// The facts are those of an earlier process, if the machine hasn't been started since, and if this
/// program, the system's drivers and packages, its cards, the environment, and the processors and
/// memory that a process may use are still the same. Otherwise the device is opened, as it always
/// is for `all`, and where the environment says where drivers are. Limits that Voxelume sets are
/// those of this process. Throws as Device::open does.
DeviceInfo device_for_plans(std::string_view selector);

}  // namespace voxelume
