// SPDX-License-Identifier: Apache-2.0
// The seconds of one render, by stage.
#pragma once

#include "runtime/opencl/device.hpp"

namespace voxelume {

struct RenderReport;

struct BenchTimes {
    double load = 0, voxelize = 0, place = 0, index = 0;
    double image = 0;     ///< sight, trace, shade and resolve
    double total = 0;     ///< sum of all above
    double kernels = 0;   ///< part of `total` in which kernels run on the device, since
                          ///< clear_counters()
    double programs = 0;  ///< time of the first render for making kernels that weren't ready; not
                          ///< part of the total
};

/// A row isn't measured again once its renders have taken this many seconds.
inline constexpr double kMaxRowSeconds = 1;

/// Resets the device's counters.
void clear_counters(const Device& device);

/// The times of a render, after clear_counters().
BenchTimes times_of(const RenderReport& report, const DeviceCounters& counters);

}  // namespace voxelume
