// SPDX-License-Identifier: Apache-2.0
// Memory for large arrays that are filled once.
#pragma once

#include <cstddef>
#include <vector>

namespace voxelume {

/// Asks the system for large pages where the array will lie. Each page of 4 kB costs a fault of
/// 0.5 µs when it is first touched, which is as long as filling it takes.
void advise_huge_pages(void* data, size_t bytes);

/// Takes the memory of whole pages at once, where the system can: what is stored there stays.
void populate_pages(void* data, size_t bytes);

/// Reserves memory for `count` elements, in large pages where there are any.
template <class Element>
void reserve_in_huge_pages(std::vector<Element>& elements, size_t count) {
    elements.reserve(count);
    advise_huge_pages(elements.data(), elements.capacity() * sizeof(Element));
}

}  // namespace voxelume
