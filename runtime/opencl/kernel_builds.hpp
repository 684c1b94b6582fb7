// SPDX-License-Identifier: Apache-2.0
// Kernels of GPUs, each compiled alone, in a thread of its own.
//
// Drivers of GPUs compile a whole program at once, one kernel after another: 22 s for the image of
// scenes/whitted.json on an H100, 13 s with its kernels in parallel. Kernels that no scene launches
// aren't compiled, and those that several scenes share only once.
#pragma once

#include <functional>
#include <future>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>

#include "runtime/opencl/program_cache.hpp"

namespace voxelume {

/// The parts of a device that a compiler needs; the device may be closed while the compiler runs.
struct CompilerTarget {
    DeviceInfo info;
    std::shared_ptr<const cl::Context> context;
    std::shared_ptr<const cl::Device> device;
};

CompilerTarget compiler_target(const Device& device);

/// A program, and whether an earlier run compiled it.
struct BuiltProgram {
    std::shared_ptr<const cl::Program> program;
    bool is_from_cache = false;
    double ms = 0;  ///< the milliseconds that it took
};

/// A program of a driver other than PoCL from the cache, or compiled and kept there. Throws as
/// build_program does, or cl::Error.
BuiltProgram build_with_binary(const CompilerTarget& target, const std::string& label,
                               const ProgramText& text);

/// The source of one kernel alone, and the key of its content.
struct KernelPart {
    std::string key;
    ProgramText text;
};

/// A program, and its kernels by their names.
struct ProgramParts {
    ProgramText whole;
    std::map<std::string, KernelPart> kernels;
};

/// The kernels of a context that are compiled or being compiled, and programs that are made ready
/// before they are needed.
class KernelBuilds {
  public:
    /// The parts of the program with this key, a source and options.
    std::shared_ptr<const ProgramParts> parts_of(const std::string& key, const std::string& source,
                                                 const std::string& options);

    /// Compiles a kernel in another thread, unless that was begun before. If it doesn't compile
    /// alone, its whole program is compiled, whose messages refer to the original sources.
    std::shared_future<BuiltProgram> start(const CompilerTarget& target, const std::string& label,
                                           const KernelPart& part, const ProgramText& whole);

    /// Runs `build`, which makes the program with this key, in another thread, unless that was
    /// begun before or no thread can be started.
    void begin(const std::string& key, std::function<BuiltProgram()> build);

    /// Waits for the program of `begin` with this key, which is begun anew by the next call of it.
    /// Empty if none was begun. Throws what `build` threw.
    std::optional<BuiltProgram> take(const std::string& key);

  private:
    std::mutex mutex_;
    std::map<std::string, std::shared_ptr<const ProgramParts>> parts_;
    std::map<std::string, std::shared_future<BuiltProgram>> builds_;
    std::map<std::string, std::future<BuiltProgram>> begun_;
};

}  // namespace voxelume
