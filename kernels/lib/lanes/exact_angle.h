// SPDX-License-Identifier: Apache-2.0
// Angles from correctly rounded operations only, so that every device gives the same bits.
#ifndef VXL_EXACT_ANGLE_H
#define VXL_EXACT_ANGLE_H

#include "lib/lanes/exact_float.h"

/// The angle of the point (x, y) of the plane, in [-pi, pi], within 3e-7; 0 for the origin. The
/// series is that of Abramowitz & Stegun 1964, 4.4.49.
static inline lane_float exact_atan2(lane_float y, lane_float x) {
    const lane_float across = fabs(x), up = fabs(y);
    const lane_float longer = fmax(across, up), shorter = fmin(across, up);
    const lane_int some = LANE_MASK(longer > 0.0f);
    const lane_float t = exact_divide(shorter, LANES_SELECT(some, longer, (lane_float)1.0f));
    const lane_float z = t * t;
    lane_float p = fma(z, 0.0028662257f, -0.0161657367f);
    p = fma(p, z, 0.0429096138f);
    p = fma(p, z, -0.0752896400f);
    p = fma(p, z, 0.1065626393f);
    p = fma(p, z, -0.1420889944f);
    p = fma(p, z, 0.1999355085f);
    p = fma(p, z, -0.3333314528f);
    lane_float angle = fma(p * z, t, t);
    angle = LANES_SELECT(LANE_MASK(up > across), 1.57079633f - angle, angle);
    angle = LANES_SELECT(LANE_MASK(x < 0.0f), 3.14159265f - angle, angle);
    return LANES_SELECT(LANE_MASK(y < 0.0f), -angle, angle);
}

#endif
