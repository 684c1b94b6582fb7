// SPDX-License-Identifier: Apache-2.0
#include "runtime/opencl/ranking.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <optional>
#include <tuple>
#include <utility>

#include "runtime/base/error.hpp"
#include "runtime/opencl/quirks/driver_quirks.hpp"
#include "runtime/opencl/selector.hpp"

namespace voxelume {
namespace {

/// A CPU's unit is a core with its vector registers. Drivers that don't say their clock are taken
/// for one of 1 GHz.
double arithmetic(const DeviceInfo& info) {
    const int floats = info.kind == DeviceKind::cpu ? info.lanes : floats_per_unit(info.vendor);
    return double(info.compute_units) * floats * (info.clock > 0 ? info.clock : 1000);
}

[[noreturn]] void throw_no_match(const std::vector<DeviceInfo>& devices,
                                 std::string_view selector) {
    if (devices.empty())
        throw Error(ErrorKind::device,
                    "no OpenCL device found: install a driver, for a CPU the package "
                    "pocl-opencl-icd, or set OCL_ICD_VENDORS to the folder that names yours");
    std::string names;
    for (const DeviceInfo& info : devices) {
        names += fmt::format("{}[{}] {}", names.empty() ? "" : ", ", info.index, info.name);
        if (!info.unusable.empty())
            names += fmt::format(" (not usable: {})", info.unusable);
        else if (is_software(info))
            names += " (a software rasterizer, used only if it is named)";
    }
    throw Error(ErrorKind::device, "no usable device matches \"{}\"; there are: {}", selector,
                names);
}

/// The largest groups that kernels are started with.
size_t needed_group(DeviceKind kind) {
    return kind == DeviceKind::cpu ? 16 : 64;
}

}  // namespace

std::string missing_ability(DeviceKind kind, std::string_view version, size_t largest_group) {
    int major = 0, minor = 0;
    const std::string text(version);
    if (std::sscanf(text.c_str(), "OpenCL %d.%d", &major, &minor) == 2 &&
        std::pair(major, minor) < std::pair(1, 2))
        return fmt::format("it speaks OpenCL {}.{}, and kernels need 1.2", major, minor);
    if (largest_group < needed_group(kind))
        return fmt::format("its groups have at most {} work-items, and kernels need {}",
                           largest_group, needed_group(kind));
    return {};
}

bool is_software(const DeviceInfo& info) {
    return is_software_rasterizer(info.name);
}

bool are_one_card(const DeviceInfo& a, const DeviceInfo& b) {
    return !a.card.empty() && a.card == b.card && a.platform != b.platform;
}

bool is_better(const DeviceInfo& a, const DeviceInfo& b) {
    const auto rank = [](const DeviceInfo& info) {
        const bool is_gpu = info.kind == DeviceKind::gpu;
        return std::tuple(is_gpu, is_gpu && !info.shares_memory, arithmetic(info));
    };
    return rank(a) > rank(b);
}

bool is_usable(const DeviceInfo& info) {
    return info.unusable.empty() && !is_software(info);
}

size_t best_device(const std::vector<DeviceInfo>& devices, std::string_view selector) {
    const bool is_named = names_one_device(selector);
    std::optional<size_t> best;
    for (size_t i = 0; i < devices.size(); ++i) {
        const DeviceInfo& info = devices[i];
        if (!(is_named ? info.unusable.empty() : is_usable(info))) continue;
        if (!names_device(selector, info)) continue;
        if (!best || is_better(info, devices[*best])) best = i;
    }
    if (!best) throw_no_match(devices, selector);
    return *best;
}

std::vector<size_t> distinct_gpus(const std::vector<DeviceInfo>& devices) {
    std::vector<size_t> gpus;
    for (size_t i = 0; i < devices.size(); ++i) {
        if (devices[i].kind != DeviceKind::gpu || !is_usable(devices[i])) continue;
        const auto same = std::ranges::find_if(
            gpus, [&](size_t other) { return are_one_card(devices[i], devices[other]); });
        if (same == gpus.end())
            gpus.push_back(i);
        else if (is_better(devices[i], devices[*same]))
            *same = i;
    }
    return gpus;
}

}  // namespace voxelume
