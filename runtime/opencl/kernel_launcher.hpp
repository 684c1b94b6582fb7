// SPDX-License-Identifier: Apache-2.0
// Launches that make PoCL compile a kernel, which it does at a kernel's first launch.
#pragma once

#include <CL/opencl.hpp>

#include "runtime/opencl/ahead/compile_job.hpp"

namespace voxelume {

/// Launches kernels once, for one group, with zeroes: kernels return at once where their
/// work-item's number isn't below the count that they are given.
class KernelLauncher {
  public:
    /// Throws cl::Error, as `compile` does.
    KernelLauncher(const cl::Context& context, const cl::Device& device);

    /// Returns when the kernel is compiled, or when it can't be launched so.
    void compile(const cl::Program& program, const CompiledKernel& wanted) const;

  private:
    cl::CommandQueue queue_;
    cl::Buffer dummy_;
};

}  // namespace voxelume
