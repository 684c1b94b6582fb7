// SPDX-License-Identifier: Apache-2.0
// The questions of a driver's self-test and its answers, in rows of VXL_KNOWN_COLUMNS words each.
#ifndef VXL_SHARED_SELF_TEST_H
#define VXL_SHARED_SELF_TEST_H

#define VXL_KNOWN_COLUMNS 16

// Questions: floats x > 0, y in [-6, 6], z; ints i, j; then the origins and directions of rays as
// in shared/trace.h.
#define VXL_KNOWN_X 0
#define VXL_KNOWN_Y 1
#define VXL_KNOWN_Z 2
#define VXL_KNOWN_I 3
#define VXL_KNOWN_J 4
#define VXL_KNOWN_RAYS 5
#define VXL_KNOWN_QUESTIONS 11

// Answers of `answer_lanes`.
#define VXL_KNOWN_RECIPROCAL 0
#define VXL_KNOWN_QUOTIENT 1
#define VXL_KNOWN_ROOT 2
#define VXL_KNOWN_EXPONENTIAL 3
#define VXL_KNOWN_LOGARITHM 4
#define VXL_KNOWN_SINE 5
#define VXL_KNOWN_COSINE 6
#define VXL_KNOWN_FUSED 7             // fma(x, y, z)
#define VXL_KNOWN_UNFUSED 8           // x y, rounded, + z
#define VXL_KNOWN_WHOLE 9             // rint(64 y)
#define VXL_KNOWN_FROM_INT 10         // i as a float
#define VXL_KNOWN_BITS 11             // number of bits set in i
#define VXL_KNOWN_LONG_PRODUCT 12     // bits 16 .. 47 of i j
#define VXL_KNOWN_LONG_COMPARISON 13  // -1 where 3 i j <= i i, else 0
#define VXL_KNOWN_HIT_CELL 14         // x | y << 8 | z << 16 | axis << 24, or VXL_NO_VOXEL
#define VXL_KNOWN_HIT_T 15            // 0 for a miss
// Answers of `answer_numbers`.
#define VXL_KNOWN_LONG_QUOTIENT 16   // low word of (i << 32 | j) / (2 j + 1), as long
#define VXL_KNOWN_LONG_REMAINDER 17  // low word of its remainder
#define VXL_KNOWN_LONG_SHIFT 18      // low word of (i << 32 | j) >> (j & 63), as long
#define VXL_KNOWN_UPPER_HALF 19      // mul_hi(i, j)
#define VXL_KNOWN_LEADING_ZEROS 20   // clz(i >> (j & 31)), of the unsigned
#define VXL_KNOWN_PRIVATE_ARRAY 21   // the sum of squares of how often each digit is in i, base 4
#define VXL_KNOWN_VECTOR 22          // the sum of k = 0 .. 15 with k >= (i & 15), times (short)j
#define VXL_KNOWN_ATOMICS 23  // over all columns: count, sum of j, bits 1 << (i & 31), minimum of i
#define VXL_KNOWN_LONG_LOOP 24  // j after 140000 + (i & 63) rounds of Marsaglia's xorshift
#define VXL_KNOWN_ANSWERS 25

// The number of voxels along each side of the rays' world, and its fixed point.
#define VXL_KNOWN_WORLD 20
#define VXL_KNOWN_FIXED_POINT 524288.0f

#endif
