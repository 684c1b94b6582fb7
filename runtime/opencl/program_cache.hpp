// Programs compiled once: from source, or from what an earlier run left on the disk.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "runtime/opencl/device.hpp"

namespace voxelume {

/// A source and its compiler's options.
struct ProgramText {
    std::string source, options;
};

/// A program for `device`, ready for its kernels to be taken.
///
/// What the compiler made is kept below `cache_folder()`, under a hash of the source with its
/// includes, the options, and the versions of the platform, the driver and this cache; nothing
/// damaged is ever handed to a driver. A build that fails without a word about the source is tried
/// a second time. Throws Error::build with the compiler's log; `label` says whose. Kernels compiled
/// of one of the `parts` that it was joined from are kept for other programs with that part.
cl::Program build_program(const Device& device, const std::string& label, const ProgramText& text,
                          std::span<const ProgramText> parts = {});

/// The sources of the programs that the device has ready, each program's once.
std::vector<std::string> program_sources(const Device& device);

/// Keeps what the platform compiled after its programs were built, at the kernels' first launch.
/// Called when a device is closed; nothing may run on it.
void keep_compiled_kernels(const DeviceInfo& info);

}  // namespace voxelume
