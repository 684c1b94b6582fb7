// SPDX-License-Identifier: Apache-2.0
// Where shadow rays may end, given the beams of a light.
#ifndef VXL_LIGHT_BEAMS_H
#define VXL_LIGHT_BEAMS_H

#include "lib/traverse/walk.h"
#include "shared/light_beams.h"

/// The components b and c of a vector, across the grid's axis.
static inline lane_float across_b(const BeamGrid* g, lane_float x, lane_float y) {
    return g->axis == 0 ? y : x;
}

static inline lane_float across_c(const BeamGrid* g, lane_float y, lane_float z) {
    return g->axis == 2 ? y : z;
}

/// The t beyond which nothing lies between rays and the grid's light; +infinity if that is unknown.
/// `ends` are the ends that send_light_beams wrote.
static inline lane_float clear_from(const BeamGrid* g, global const float* restrict ends,
                                    const Walk* w) {
    const lane_float oa = g->axis == 0 ? w->ox : g->axis == 1 ? w->oy : w->oz;
    const lane_float ia = g->axis == 0 ? w->ix : g->axis == 1 ? w->iy : w->iz;
    const lane_float t = (g->far_side - oa) * ia;
    const lane_float at_b = fma(across_b(g, w->dx, w->dy), t, across_b(g, w->ox, w->oy));
    const lane_float at_c = fma(across_c(g, w->dy, w->dz), t, across_c(g, w->oy, w->oz));
    const lane_float per_edge = exact_reciprocal((lane_float)g->edge);
    const lane_float column = (at_b - g->low_b) * per_edge, row = (at_c - g->low_c) * per_edge;
    const lane_int known = LANE_MASK(column >= 0.0f) & LANE_MASK(column < (float)g->columns) &
                           LANE_MASK(row >= 0.0f) & LANE_MASK(row < (float)g->rows) &
                           LANE_MASK(ia * g->sign < 0.0f);
    if (!lanes_any(known)) return (lane_float)INFINITY;
    const lane_int x = LANES_INT(LANES_SELECT(known, column, (lane_float)0.0f));
    const lane_int y = LANES_INT(LANES_SELECT(known, row, (lane_float)0.0f));
    const lane_int tile = (y >> 2) * (g->columns >> 2) + (x >> 2);
    const lane_int beam = (tile << 4) | ((y & 3) << 2) | (x & 3);
    const lane_float s = LANES_GATHER_FLOAT(ends, LANES_AS_UINT(beam));
    const lane_float clear = fmax((g->sign * s - oa) * ia, 0.0f);
    return LANES_SELECT(known, clear, (lane_float)INFINITY);
}

#endif
