// SPDX-License-Identifier: Apache-2.0
// Special needs of OpenCL drivers: one row for each driver that has some.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace voxelume {

/// How the compiled programs of a driver are kept on disk.
enum class ProgramKeeping : uint8_t {
    binaries,     ///< as the driver's binaries, one per program
    pocl_folder,  ///< in files of PoCL's own, one per kernel; asked for a binary, PoCL compiles
                  ///< twice
    none
};

/// The special needs of the driver of a platform.
struct DriverQuirks {
    std::string_view platform{};  ///< CL_PLATFORM_NAME; empty: every platform without a row
    ProgramKeeping keeping = ProgramKeeping::binaries;
    std::string_view build_options{};   ///< appended to the options of every program
    bool compiles_side_by_side = true;  ///< GPUs' kernels may be compiled in threads of their own
    int max_work_group = 0;             ///< larger groups get wrong results; 0: none do
    bool is_slow_to_declare = false;    ///< the driver reads its own declarations for each program
    std::string_view generic_name{};  ///< part of the names of devices that the driver doesn't know
                                      ///< and compiles for generically; empty: unknown
    std::string_view note_on_generic{};  ///< note for users of such devices
};

/// The row of a platform.
const DriverQuirks& driver_quirks(std::string_view platform);

/// The floats that one compute unit of a GPU handles at once: vendors count units differently.
int floats_per_unit(std::string_view vendor);

/// True for a driver that emulates a graphics card on the CPU: Mesa's llvmpipe and softpipe.
bool is_software_rasterizer(std::string_view device_name);

}  // namespace voxelume
