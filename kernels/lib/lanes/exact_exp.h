// SPDX-License-Identifier: Apache-2.0
// Exponential, logarithm, power, sine and cosine from correctly rounded operations only, so that
// every device gives the same bits. Errors are about one unit in the last place; for `exact_power`,
// about |y| units.
#ifndef VXL_EXACT_EXP_H
#define VXL_EXACT_EXP_H

#include "lib/lanes/exact_float.h"

/// e^x for x <= 88; 0 below -87, where the result would no longer be a normal number.
static inline lane_float exact_exp(lane_float x) {
    const lane_float clamped = fmax(x, -87.0f);
    const lane_float scaled = fma(clamped, 1.44269504f, 0.5f);
    const lane_int truncated = LANES_INT(scaled);
    const lane_int k = truncated + LANE_MASK(LANES_FLOAT(truncated) > scaled);
    const lane_float n = LANES_FLOAT(k);
    const lane_float r = fma(n, -1.42860677e-6f, fma(n, -0.693145752f, clamped));
    lane_float p = fma(r, 1.98412698e-4f, 1.38888889e-3f);
    p = fma(p, r, 8.33333333e-3f);
    p = fma(p, r, 4.16666667e-2f);
    p = fma(p, r, 1.66666667e-1f);
    p = fma(p, r, 0.5f);
    p = fma(p, r, 1.0f);
    p = fma(p, r, 1.0f);
    const lane_float result = p * LANES_AS_FLOAT((k + 127) << 23);
    return LANES_SELECT(LANE_MASK(x < -87.0f), (lane_float)0.0f, result);
}

/// 1 - e^-x for x >= 0, with a small relative error near 0 as well.
static inline lane_float exact_rise(lane_float x) {
    const lane_float clamped = fmin(x, 87.0f);
    const lane_int k = LANES_INT(fma(clamped, 1.44269504f, 0.5f));
    const lane_float n = LANES_FLOAT(k);
    const lane_float r = fma(n, 1.42860677e-6f, fma(n, 0.693145752f, -clamped));
    lane_float p = fma(r, 1.98412698e-4f, 1.38888889e-3f);
    p = fma(p, r, 8.33333333e-3f);
    p = fma(p, r, 4.16666667e-2f);
    p = fma(p, r, 1.66666667e-1f);
    p = fma(p, r, 0.5f);
    p = fma(p * r, r, r);  // e^r - 1
    const lane_float scale = LANES_AS_FLOAT((127 - k) << 23);
    return fma(-p, scale, 1.0f - scale);
}

/// The natural logarithm of a normal x > 0, with a small relative error near 1 as well.
static inline lane_float exact_log(lane_float x) {
    const lane_int bits = LANES_AS_INT(x);
    // The mantissa in [sqrt(1/2), sqrt(2)): 0x3F3504F3 is sqrt(1/2).
    const lane_int k = (bits - 0x3F3504F3) >> 23;
    const lane_float m = LANES_AS_FLOAT(bits - (k << 23));
    const lane_float f = m - 1.0f;
    const lane_float s = exact_divide(f, f + 2.0f);
    const lane_float z = s * s;
    lane_float p = fma(z, 0.222222222f, 0.285714286f);  // ln m = 2 s + 2/3 s³ + 2/5 s⁵ + ...
    p = fma(p, z, 0.4f);
    p = fma(p, z, 0.666666667f);
    p = fma(p * z, s, 2.0f * s);
    return fma(LANES_FLOAT(k), 0.693147181f, p);
}

/// x^y for x in [0, 1] and y > 0.
static inline lane_float exact_power(lane_float x, lane_float y) {
    const lane_int positive = LANE_MASK(x > 1.17549435e-38f);
    const lane_float power = exact_exp(y * exact_log(LANES_SELECT(positive, x, (lane_float)1.0f)));
    return LANES_SELECT(positive, power, (lane_float)0.0f);
}

/// Sine and cosine of an angle in [-2 pi, 2 pi] radians.
static inline void exact_sincos(lane_float angle, lane_float* sine, lane_float* cosine) {
    const lane_float turns = fma(angle, 0.636619772f, 8.5f);  // quarter turns, kept positive
    const lane_int quarter = LANES_INT(turns) - 8;
    const lane_float q = LANES_FLOAT(quarter);
    const lane_float r = fma(q, 4.37113883e-8f, fma(q, -1.57079637f, angle));
    const lane_float z = r * r;
    lane_float s = fma(z, 2.75573192e-6f, -1.98412698e-4f);
    s = fma(s, z, 8.33333333e-3f);
    s = fma(s, z, -1.66666667e-1f);
    s = fma(s * z, r, r);
    lane_float c = fma(z, 2.48015873e-5f, -1.38888889e-3f);
    c = fma(c, z, 4.16666667e-2f);
    c = fma(c, z, -0.5f);
    c = fma(c, z, 1.0f);
    const lane_int swapped = LANE_MASK((quarter & 1) != 0);
    const lane_float base_sine = LANES_SELECT(swapped, c, s);
    const lane_float base_cosine = LANES_SELECT(swapped, s, c);
    *sine = LANES_SELECT(LANE_MASK((quarter & 2) != 0), -base_sine, base_sine);
    *cosine = LANES_SELECT(LANE_MASK(((quarter + 1) & 2) != 0), -base_cosine, base_cosine);
}

#endif
