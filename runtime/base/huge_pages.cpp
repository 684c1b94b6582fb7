// SPDX-License-Identifier: Apache-2.0
#include "runtime/base/huge_pages.hpp"

#include <sys/mman.h>

#include <cstdint>

namespace voxelume {

namespace {

/// Gives the system advice on the whole huge pages of an array.
void advise(void* data, size_t bytes, int advice) {
    constexpr uintptr_t kHugePage = uintptr_t{1} << 21;
    const auto first = (reinterpret_cast<uintptr_t>(data) + kHugePage - 1) / kHugePage * kHugePage;
    const auto last = (reinterpret_cast<uintptr_t>(data) + bytes) / kHugePage * kHugePage;
    // Where the system has no such pages, or no such advice, nothing changes.
    if (data != nullptr && last > first)
        madvise(reinterpret_cast<void*>(first), last - first, advice);
}

}  // namespace

void advise_huge_pages(void* data, size_t bytes) {
    advise(data, bytes, MADV_HUGEPAGE);
}

}  // namespace voxelume
