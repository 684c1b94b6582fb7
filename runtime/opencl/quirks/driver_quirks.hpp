// SPDX-License-Identifier: Apache-2.0
// What some OpenCL drivers need that others don't: a row for each.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace voxelume {

/// How what a driver compiled is kept on disk.
enum class ProgramKeeping : uint8_t {
    binaries,     ///< as the driver gives it, a program each
    pocl_folder,  ///< in files of PoCL's own, a kernel each; asked for a binary, it compiles twice
    none
};

/// What sets the driver of a platform apart.
struct DriverQuirks {
    std::string_view platform{};  ///< CL_PLATFORM_NAME; empty: every platform without a row
    ProgramKeeping keeping = ProgramKeeping::binaries;
    std::string_view build_options{};    ///< what the options of every program end with
    bool compiles_with_programs = true;  ///< its GPUs' kernels, not each at its first launch
    bool is_slow_to_declare = false;     ///< it reads its own declarations for each program
    std::string_view generic_name{};     ///< part of the names of devices that it compiles for
                                         ///< as if it didn't know them; empty: it never says so
    std::string_view note_on_generic{};  ///< what their users are told
};

/// The row of a platform.
const DriverQuirks& driver_quirks(std::string_view platform);

/// The floats that one compute unit of a GPU handles at once: what makers count as a unit differs.
int floats_per_unit(std::string_view vendor);

/// True for a driver that computes on the CPU what is meant for a graphics card: Mesa's llvmpipe
/// and softpipe.
bool is_software_rasterizer(std::string_view device_name);

}  // namespace voxelume
