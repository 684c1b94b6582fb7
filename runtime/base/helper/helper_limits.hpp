// SPDX-License-Identifier: Apache-2.0
// The limits that a helper program sets itself before it looks at what it is given.
#pragma once

#include <cstdint>

namespace voxelume {

struct HelperLimits {
    uint64_t memory_bytes = 0;      ///< bytes of address space
    uint64_t max_memory_bytes = 0;  ///< after raise_memory_limit()
    uint64_t seconds = 0;           ///< seconds of processor time
};

/// Limits this process for the rest of its life: memory, computing, descriptors, no written files,
/// no core file, no new rights, and an end together with the process that started it. Returns false
/// where the system doesn't grant a limit.
///
/// Sanitizers reserve address space beyond any limit, so programs built with them have no limit on
/// it.
bool limit_helper(const HelperLimits& limits);

/// Raises the limit of address space to `max_memory_bytes`.
void raise_memory_limit();

}  // namespace voxelume
