// SPDX-License-Identifier: Apache-2.0
// Programs compiled once: from source, or from the disk cache of an earlier run.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "runtime/opencl/ahead/compile_job.hpp"
#include "runtime/opencl/device.hpp"

namespace voxelume {

/// A source and its compiler's options.
struct ProgramText {
    std::string source, options;
};

/// A program for `device`, built so that its kernels can be created.
///
/// The compiler's result is kept below `cache_folder()`, under a hash of the source with its
/// includes, the options, and the versions of the platform, the driver and this cache; damaged
/// files never reach a driver. A build that fails without a message about the source is tried a
/// second time. PoCL's compiled kernels are kept for every program with an equal kernel, whatever
/// else it holds. Throws Error::build with the compiler's log, in which `label`
/// names the program.
cl::Program build_program(const Device& device, const std::string& label, const ProgramText& text);

/// True for a device whose compiled kernels are kept in PoCL's own files.
bool keeps_pocl_folder(const DeviceInfo& info);

/// True where helper processes may compile kernels ahead for this process: see KernelCompilers.
bool is_compiled_ahead(const DeviceInfo& info);

/// Starts the helpers, because this process is about to compile. Returns true if one compiles for
/// this device; none does where the cache can't be written.
bool prepare_to_compile(const DeviceInfo& info);

/// True if the cache has a program.
bool is_program_kept(const DeviceInfo& info, const ProgramText& text);

/// Makes a program of the cache ready in another thread, for build_program to take. If the cache
/// lacks it, lets a helper compile it and its kernels into the cache.
void build_ahead(const Device& device, CompileJob job);

/// True for GPUs whose drivers compile programs side by side: then each kernel is compiled alone,
/// see kernel_builds.hpp. Intel's driver for CPUs compiles one program at a time, and takes 23
/// instead of 14 s for the kernels of scenes/whitted.json one by one.
bool compiles_kernels_alone(const DeviceInfo& info);

/// The options of a compiler without its -D constants.
std::string without_constants(std::string_view options);

/// The sources of the programs that the device has made ready, each once.
std::vector<std::string> program_sources(const Device& device);

/// Saves what the platform compiled after its programs were built, at the kernels' first launch.
/// Called when a device is closed; nothing may run on it.
void keep_compiled_kernels(const DeviceInfo& info);

/// Saves compiled kernels for processes that wait for them, after all enqueued work has run: see
/// CompileTurn. Call this when every kernel of some work was enqueued once, such as that of a batch
/// of tiles.
void share_compiled_kernels(const Device& device);

}  // namespace voxelume
