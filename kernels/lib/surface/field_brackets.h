// SPDX-License-Identifier: Apache-2.0
// The brackets that a field stands in, packed as in shared/field_place.h.
#ifndef VXL_FIELD_BRACKETS_H
#define VXL_FIELD_BRACKETS_H

#include "shared/field_place.h"

/// The number of brackets around a field.
static inline int bracket_depth(uint path) {
    return (path != 0) + (path >> VXL_BRACKET_BITS != 0) + (path >> 2 * VXL_BRACKET_BITS != 0);
}

/// The number of brackets that two fields are both in.
static inline int shared_brackets(uint a, uint b) {
    const int max_depth = min(bracket_depth(a), bracket_depth(b));
    int shared = 0;
    for (uint apart = a ^ b; shared < max_depth && (apart & VXL_BRACKET_MASK) == 0; ++shared)
        apart >>= VXL_BRACKET_BITS;
    return shared;
}

#endif
