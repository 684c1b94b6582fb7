// SPDX-License-Identifier: Apache-2.0
// Arrays that grow by large parts.
#pragma once

#include <algorithm>

#include "runtime/base/huge_pages.hpp"

namespace voxelume {

/// Makes room for `more` further elements, in large pages where there are any.
template <class Element, class Memory>
void make_room(std::vector<Element, Memory>& elements, size_t more) {
    const size_t wanted = elements.size() + more;
    if (wanted > elements.capacity())
        reserve_in_huge_pages(elements, std::max(wanted, 2 * elements.capacity()));
}

}  // namespace voxelume
