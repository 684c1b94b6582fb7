// SPDX-License-Identifier: Apache-2.0
// Division and square root that round correctly on every device, so that all give the same bits.
//
// OpenCL lets a device miss x/y by 2.5 units in the last place, and NVIDIA's do. So kernels divide
// by these functions alone, but for constants, and bounds of voxelization that only say which
// voxels are looked at exactly; .ci/kernel_arithmetic holds that. Markstein's correction by fma
// makes the result correctly rounded from any such start, for results and residuals in the normal
// range; VXL_NATIVE_DIVIDE = 1 says that the device's own operations already are (every CPU
// driver's).
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

/// a / b, correctly rounded, for b != 0 and a, b, a/b far from overflow and underflow; or a = 0.
static inline lane_float exact_divide(lane_float a, lane_float b) {
    if (VXL_NATIVE_DIVIDE) return a / b;
    lane_float r = exact_reciprocal(b);
    const lane_float first = a * r;
    lane_float q = fma(fma(-b, first, a), r, first);
    q = fma(fma(-b, q, a), r, q);
    return LANES_SELECT(LANE_MASK(a == 0.0f), first, q);  // the correction would lose the sign of 0
}

/// a / b of single numbers, rounded as exact_divide does.
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
/// A corrected root is within one unit of it; Tuckerman's test, y (y - unit) < x <= y (y + unit),
/// then finds the one. (The correction alone gives 1 for the float below 1.)
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
