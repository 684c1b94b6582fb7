// Division and square root that round correctly on every device, so that all give the same bits.
//
// OpenCL lets a device miss x/y by 2.5 units in the last place. Markstein's correction by fma makes
// the result correctly rounded from any such start, for results and residuals in the normal range;
// VXL_NATIVE_DIVIDE = 1 says that the device's own operations already are (every CPU driver's).
#ifndef VXL_EXACT_FLOAT_H
#define VXL_EXACT_FLOAT_H

#include "lib/lanes.h"

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

/// a / b, correctly rounded, for b != 0 and a, b, a/b far from overflow and underflow.
static inline lane_float exact_divide(lane_float a, lane_float b) {
    if (VXL_NATIVE_DIVIDE) return a / b;
    lane_float r = exact_reciprocal(b);
    lane_float q = a * r;
    q = fma(fma(-b, q, a), r, q);
    return fma(fma(-b, q, a), r, q);
}

/// The square root of x >= 0, correctly rounded, for x = 0 or far from underflow.
///
/// Correction alone can end beside a root that lies almost halfway between two numbers. Tuckerman's
/// test decides: r is the root exactly when r * (the number below r) < x <= r * (the number above r).
static inline lane_float exact_sqrt(lane_float x) {
    lane_float root = sqrt(x);
    if (!VXL_NATIVE_DIVIDE) {
        const lane_float half_inverse = 0.5f / root;
        const lane_float better = fma(fma(-root, root, x), half_inverse, root);
        const lane_float below = LANES_AS_FLOAT(LANES_AS_INT(better) - 1);
        const lane_float above = LANES_AS_FLOAT(LANES_AS_INT(better) + 1);
        const lane_int too_large = LANE_MASK(fma(-better, below, x) <= 0.0f);
        const lane_int too_small = LANE_MASK(fma(-better, above, x) > 0.0f);
        const lane_float right = LANES_SELECT(too_large, below, LANES_SELECT(too_small, above, better));
        root = LANES_SELECT(LANE_MASK(x > 0.0f), right, x);
    }
    return root;
}

#endif
