// SPDX-License-Identifier: Apache-2.0
// What a helper process is told to compile.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace voxelume {

/// The program that compiles kernels beside the one that renders.
inline constexpr const char* kKernelCompilerName = "voxelume-kernel-compiler";

/// A kernel, and the number of work-items in each of its groups, for which PoCL compiles it.
struct CompiledKernel {
    std::string name;
    uint64_t group = 1;
};

/// A program, and those of its kernels that will be launched.
struct CompileJob {
    std::string label;  ///< its name in messages
    std::string source, options;
    std::vector<CompiledKernel> kernels;
};

/// The bytes of a job on its way to a helper: their count, then texts with theirs.
std::string bytes_of(const CompileJob& job);

/// The next job from a descriptor; nothing at its end. Throws std::runtime_error where the bytes
/// are none of a job.
std::optional<CompileJob> next_job(int descriptor);

}  // namespace voxelume
