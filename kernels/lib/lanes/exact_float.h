// SPDX-License-Identifier: Apache-2.0
// Division and square root that are correctly rounded on every device, so that all give the same
// bits.
//
// OpenCL lets a device miss x/y by 2.5 units in the last place, and NVIDIA's devices do. So kernels
// divide only by these functions, except for constants and for bounds of voxelization that merely
// select the voxels to be tested exactly; .ci/kernel_rules checks this. From any such start,
// Markstein's correction by fma gives the correctly rounded result, if results and residuals are in
// the normal range. VXL_NATIVE_DIVIDE = 1 says that the device's own operations are already
// correctly rounded, as with every CPU driver.
#ifndef VXL_EXACT_FLOAT_H
#define VXL_EXACT_FLOAT_H

#include "lib/lanes/lanes.h"

#ifndef VXL_NATIVE_DIVIDE
#define VXL_NATIVE_DIVIDE 0
#endif

/// 1 / x, correctly rounded, for |x| in [2^-24, 2^24]; infinity for x = 0.
static inline lane_float exact_reciprocal(lane_float x) {
    lane_float r = 1.0f / x;
    if (!VXL_NATIVE_DIVIDE) {
        lane_float better = fma(fma(-x, r, 1.0f), r, r);
        better = fma(fma(-x, better, 1.0f), better, better);
        r = LANES_SELECT(LANE_MASK(x == 0.0f), r, better);
    }
    return r;
}

/// a / b, correctly rounded, for b != 0 and a, b, a/b far from overflow and underflow; or for a =
/// 0.
static inline lane_float exact_divide(lane_float a, lane_float b) {
    if (VXL_NATIVE_DIVIDE) return a / b;
    lane_float r = exact_reciprocal(b);
    const lane_float first = a * r;
    lane_float q = fma(fma(-b, first, a), r, first);
    q = fma(fma(-b, q, a), r, q);
    return LANES_SELECT(LANE_MASK(a == 0.0f), first, q);  // the correction would lose the sign of 0
}

/// a / b for single numbers, rounded as by exact_divide.
static inline float exact_quotient(float a, float b) {
    float all[VXL_LANES];
    LANES_STORE(exact_divide((lane_float)a, (lane_float)b), all, 0);
    return all[0];
}

/// 1 / power, for a power of two.
static inline float inverse_of_power(float power) {
    return as_float(0x7F000000 - as_int(power));
}

/// The square root of x >= 0, correctly rounded, for x = 0 or far from underflow.
///
/// A corrected root is within one unit of the true one. Then Tuckerman's test, y (y - unit) < x <=
/// y (y + unit), finds the right one. (The correction alone gives 1 for the float below 1.)
static inline lane_float exact_sqrt(lane_float x) {
    lane_float root = sqrt(x);
    if (!VXL_NATIVE_DIVIDE) {
        const lane_float y = fma(fma(-root, root, x), 0.5f / root, root);
        const lane_float below = LANES_AS_FLOAT(LANES_AS_INT(y) - 1);
        const lane_float above = LANES_AS_FLOAT(LANES_AS_INT(y) + 1);
        root = LANES_SELECT(LANE_MASK(fma(-y, below, x) <= 0.0f), below, y);
        root = LANES_SELECT(LANE_MASK(fma(-y, above, x) > 0.0f), above, root);
        root = LANES_SELECT(LANE_MASK(x > 0.0f), root, x);
    }
    return root;
}

#endif
