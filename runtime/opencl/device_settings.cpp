// SPDX-License-Identifier: Apache-2.0
#include "runtime/opencl/device_settings.hpp"

#include <algorithm>
#include <bit>
#include <charconv>
#include <cstdlib>
#include <limits>

#include "runtime/base/error.hpp"
#include "runtime/base/main_memory.hpp"
#include "runtime/opencl/quirks/driver_quirks.hpp"

namespace voxelume {
namespace {

std::string environment(const char* name) {
    const char* value = std::getenv(name);
    return value ? value : "";
}

/// The lanes that the caller asks for, else those of VOXELUME_LANES, else the device's own.
int lanes_for(const DeviceInfo& info, int asked) {
    const std::string text = asked != 0 ? std::to_string(asked) : environment("VOXELUME_LANES");
    if (text.empty()) return info.lanes;
    for (const int lanes : {1, 4, 8, 16})
        if (text == std::to_string(lanes)) return lanes;
    throw Error(ErrorKind::usage, "{} lanes per work-item: there are kernels for 1, 4, 8 and 16",
                text);
}

/// The number, at least 1, in an environment variable; 0 if it isn't set.
int number_in_environment(const char* name) {
    const std::string text = environment(name);
    if (text.empty()) return 0;
    int number = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    if (error != std::errc() || end != text.data() + text.size() || number < 1)
        throw Error(ErrorKind::usage, "{}={}: must be a whole number from 1 to {}, in digits", name,
                    text, std::numeric_limits<int>::max());
    return number;
}

/// The number of rays in a batch that fills a GPU: smaller launches leave most of it idle, and each
/// costs some 10 us. On an H100 frames are 6 to 20 times faster than with a CPU's batches.
constexpr uint64_t kGpuBatchRays = 1u << 21;

/// The number of rays in a batch for each core of a CPU: fewer leave cores without work at a
/// batch's end, and more don't stay in its caches. Two cores of a Zen 4 take 0.92 times as long for
/// two spheres at 1024 x 768 as with twice as many rays, and as long for other scenes.
constexpr uint32_t kRaysOfCore = 1u << 15;

/// The bytes of a ray over all depths. All rays of a batch may take a quarter of a GPU's memory.
constexpr uint64_t kBytesOfRay = 8192;

/// The batch of a device. A GPU with memory of its own has larger batches; a GPU that shares a
/// CPU's memory is small, too.
uint32_t batch_for(const DeviceInfo& info) {
    if (info.kind == DeviceKind::cpu)
        return std::clamp(uint32_t(info.compute_units) * kRaysOfCore, kCpuBatchRays / 2,
                          kCpuBatchRays);
    if (info.kind != DeviceKind::gpu || info.shares_memory) return kCpuBatchRays;
    const uint64_t rays = std::bit_floor(info.memory / 4 / kBytesOfRay);
    return uint32_t(std::clamp<uint64_t>(rays, kCpuBatchRays, kGpuBatchRays));
}

}  // namespace

std::string selector_or_default(std::string_view selector) {
    const std::string by_default = environment("VOXELUME_DEVICE");
    if (!selector.empty()) return std::string(selector);
    return by_default.empty() ? "auto" : by_default;
}

void limit_memory(DeviceInfo& info) {
    info.memory =
        std::min(info.memory, info.kind == DeviceKind::cpu ? main_memory() : chosen_memory_limit());
    const auto limit = [](const char* name, uint64_t& bytes) {
        const auto megabytes = uint64_t(number_in_environment(name));
        if (megabytes != 0) bytes = std::min(bytes, megabytes << 20);
    };
    limit("VOXELUME_MEMORY_MB", info.memory);
    limit("VOXELUME_BUFFER_MB", info.max_allocation);
    info.max_allocation = std::min(info.max_allocation, info.memory);
}

DeviceInfo settled(DeviceInfo info, int lanes) {
    info.lanes = lanes_for(info, lanes);
    limit_memory(info);
    info.work_group = number_in_environment("VOXELUME_WORK_GROUP");
    if (const int maximum = driver_quirks(info.platform).max_work_group; maximum > 0)
        info.work_group = std::min(info.work_group, maximum);
    const auto batch = uint32_t(number_in_environment("VOXELUME_BATCH"));
    // Halves of batches are whole groups of sixteen rays.
    info.batch_rays =
        batch > 0 ? std::min(std::max(batch, 32u), 1u << 24) / 32 * 32 : batch_for(info);
    info.build_options = environment("VOXELUME_BUILD_OPTIONS");
    return info;
}

int units_to_use() {
    return number_in_environment("VOXELUME_UNITS");
}

}  // namespace voxelume
