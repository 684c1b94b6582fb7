// SPDX-License-Identifier: Apache-2.0
// Jobs for helper processes that compile.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace voxelume {

/// The program that compiles kernels in parallel to the process that renders.
inline constexpr const char* kKernelCompilerName = "voxelume-kernel-compiler";

/// A kernel, and the number of work-items in each of its groups, for which PoCL compiles it.
struct CompiledKernel {
    std::string name;
    uint64_t group = 1;
};

/// What a helper says: it wants a kernel of its job, or it has ended its job.
enum class HelperAnswer : char { has_failed, has_kept, wants_kernel };

/// A program, and those of its kernels that will be launched.
struct CompileJob {
    std::string label;  ///< its name in messages
    std::string source, options;
    std::vector<CompiledKernel> kernels;
};

/// The bytes of a job for a helper, without its kernels: their count, then texts with their counts.
std::string bytes_of(const CompileJob& job);

/// The bytes of a kernel, or of the end of a job's kernels.
std::string bytes_of(const std::optional<CompiledKernel>& kernel);

/// The next job from a descriptor; empty at its end. Throws std::runtime_error for bytes that
/// aren't a job.
std::optional<CompileJob> next_job(int descriptor);

/// The next kernel of a job; empty after the last, and at the descriptor's end. Throws as next_job.
std::optional<CompiledKernel> next_kernel(int descriptor);

}  // namespace voxelume
