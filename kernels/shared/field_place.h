// SPDX-License-Identifier: Apache-2.0
// The position of a part's field in the formula of its solid, for kernels and host alike.
#ifndef VXL_SHARED_FIELD_PLACE_H
#define VXL_SHARED_FIELD_PLACE_H

// How a field is joined to what stands before it: 0 for not at all, else by the smaller or the
// larger of the two (the numbers of voxelume::FieldLink).
#define VXL_LINK_UNION 1u
#define VXL_LINK_INTERSECTION 2u
#define VXL_LINK_BITS 2

// The numbers of the brackets that a field stands in, the outermost first; 0 for none:
//   31 30 | 29 .... 20 | 19 .... 10 | 9 ..... 0
//   0     | third      | second     | first
#define VXL_MAX_BRACKETS 3
#define VXL_BRACKET_BITS 10
#define VXL_BRACKET_MASK 0x3FFu

#endif
