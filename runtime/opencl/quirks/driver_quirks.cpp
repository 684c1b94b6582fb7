// SPDX-License-Identifier: Apache-2.0
#include "runtime/opencl/quirks/driver_quirks.hpp"

#include <algorithm>
#include <array>

namespace voxelume {
namespace {

constexpr DriverQuirks kOthers{};

constexpr std::array kDrivers = {
    // PoCL would read 17,000 declarations for each program, which takes 80 ms. It names a CPU
    // "pthread-<processor as LLVM knows it>-<processor>".
    DriverQuirks{.platform = "Portable Computing Language",
                 .keeping = ProgramKeeping::pocl_folder,
                 .compiles_side_by_side = false,
                 .is_slow_to_declare = true,
                 .generic_name = "-generic-",
                 .note_on_generic =
                     "PoCL doesn't know this processor and compiles for a generic one, which is "
                     "slow: use a newer PoCL"},
    // Oclgrind 21.10 interprets LLVM code, but not the alias hints that LLVM adds as it inlines. A
    // binary would lose the line numbers. Programs of a context share LLVM's objects, without a
    // lock: two that are built at the same time end the process.
    DriverQuirks{.platform = "Oclgrind",
                 .keeping = ProgramKeeping::none,
                 .build_options = " -cl-opt-disable -DOCLGRIND",
                 .compiles_side_by_side = false},
    // Intel's OpenCL for CPUs 2026.22.10 makes vectors of a group's work-items, and then gets exact
    // triangles wrong: 2,340 of 10,000 rays of `stress --only exact` with groups of 16 or 64, and
    // none with 8, or without its optimizer.
    DriverQuirks{.platform = "Intel(R) OpenCL", .max_work_group = 8},
};

struct Maker {
    std::string_view vendor;
    int floats;
};
constexpr std::array kMakers = {Maker{"NVIDIA", 128}, Maker{"AMD", 64},
                                Maker{"Advanced Micro Devices", 64}, Maker{"Intel", 8},
                                Maker{"Apple", 128}};

constexpr std::array<std::string_view, 3> kRasterizers = {"llvmpipe", "softpipe", "swrast"};

bool contains(std::string_view text, std::string_view part) {
    return text.find(part) != std::string_view::npos;
}

}  // namespace

const DriverQuirks& driver_quirks(std::string_view platform) {
    const auto* const row = std::ranges::find(kDrivers, platform, &DriverQuirks::platform);
    return row == kDrivers.end() ? kOthers : *row;
}

int floats_per_unit(std::string_view vendor) {
    for (const Maker& maker : kMakers)
        if (contains(vendor, maker.vendor)) return maker.floats;
    return 32;
}

bool is_software_rasterizer(std::string_view device_name) {
    return std::ranges::any_of(kRasterizers,
                               [&](std::string_view name) { return contains(device_name, name); });
}

}  // namespace voxelume
