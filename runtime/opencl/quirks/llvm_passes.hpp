// SPDX-License-Identifier: Apache-2.0
// The passes of LLVM that PoCL's kernels go through.
#pragma once

#include <cstdint>

namespace voxelume {

/// How often this process took the few passes of llvm_passes.cpp in place of the standard ones.
uint64_t few_passes_taken();

}  // namespace voxelume
