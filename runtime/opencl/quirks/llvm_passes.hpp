// SPDX-License-Identifier: Apache-2.0
// The passes of LLVM that PoCL's kernels go through.
#pragma once

#include <cstdint>

namespace voxelume {

/// The number of times that this process replaced the standard passes by those of llvm_passes.cpp.
uint64_t few_passes_taken();

}  // namespace voxelume
