// SPDX-License-Identifier: Apache-2.0
// Memory for large arrays that are filled once.
#pragma once

#include <cstddef>
#include <memory>
#include <new>
#include <utility>
#include <vector>

namespace voxelume {

/// Asks the system for large pages where the array will lie. Each page of 4 kB costs a fault of
/// 0.5 µs when it is first touched, which is as long as filling it takes.
void advise_huge_pages(void* data, size_t bytes);

/// Leaves elements of an array undefined where it grows, so that the code that fills it touches its
/// memory first, in any number of threads.
template <class Element>
struct UnfilledMemory : std::allocator<Element> {
    template <class Other>
    struct rebind {  // NOLINT(readability-identifier-naming): as the standard has it
        using other = UnfilledMemory<Other>;
    };
    template <class Other>
    void construct(Other* place) noexcept {
        ::new (static_cast<void*>(place)) Other;
    }
    template <class Other, class... Values>
    void construct(Other* place, Values&&... values) {
        ::new (static_cast<void*>(place)) Other(std::forward<Values>(values)...);
    }
};

template <class Element>
using UnfilledVector = std::vector<Element, UnfilledMemory<Element>>;

/// Reserves memory for `count` elements, in large pages where there are any.
template <class Element, class Memory>
void reserve_in_huge_pages(std::vector<Element, Memory>& elements, size_t count) {
    elements.reserve(count);
    advise_huge_pages(elements.data(), elements.capacity() * sizeof(Element));
}

}  // namespace voxelume
