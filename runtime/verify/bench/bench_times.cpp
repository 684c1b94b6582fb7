// SPDX-License-Identifier: Apache-2.0
#include "runtime/verify/bench/bench_times.hpp"

#include "runtime/render/renderer.hpp"

namespace voxelume {

void clear_counters(const Device& device) {
    DeviceCounters& counters = device.counters();
    counters.peak_bytes = counters.bytes_in_use;
    counters.build_ms = 0;
    counters.kernel_ms.clear();
}

BenchTimes times_of(const RenderReport& report, const DeviceCounters& counters) {
    BenchTimes times;
    times.load = report.world.load_seconds;
    times.voxelize = report.world.voxelize_seconds;
    times.place = report.world.place_seconds;
    times.index = report.world.index_seconds;
    times.image = report.image_seconds;
    times.total = times.load + times.voxelize + times.place + times.index + times.image;
    for (const auto& [kernel, ms] : counters.kernel_ms) times.kernels += ms / 1e3;
    return times;
}

}  // namespace voxelume
