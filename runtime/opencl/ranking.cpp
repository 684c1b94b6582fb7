// SPDX-License-Identifier: Apache-2.0
#include "runtime/opencl/ranking.hpp"

#include <algorithm>
#include <tuple>

namespace voxelume {
namespace {

bool contains(std::string_view text, std::string_view part) {
    return text.find(part) != std::string_view::npos;
}

/// The floats that one compute unit handles at once: what the makers count as a unit differs. A
/// CPU's unit is a core with its vector registers.
int floats_per_unit(const DeviceInfo& info) {
    if (info.kind == DeviceKind::cpu) return info.lanes;
    struct Maker {
        std::string_view name;
        int floats;
    };
    constexpr Maker kMakers[] = {
        {"NVIDIA", 128}, {"AMD", 64}, {"Advanced Micro Devices", 64}, {"Intel", 8}, {"Apple", 128}};
    for (const Maker& maker : kMakers)
        if (contains(info.vendor, maker.name)) return maker.floats;
    return 32;
}

/// Drivers that don't say their clock are taken for one of 1 GHz.
double arithmetic(const DeviceInfo& info) {
    return double(info.compute_units) * floats_per_unit(info) *
           (info.clock > 0 ? info.clock : 1000);
}

}  // namespace

bool is_software(const DeviceInfo& info) {
    return contains(info.name, "llvmpipe") || contains(info.name, "softpipe") ||
           contains(info.name, "swrast");
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

}  // namespace voxelume
