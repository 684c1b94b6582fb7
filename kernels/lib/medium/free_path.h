// SPDX-License-Identifier: Apache-2.0
// How far light travels in a medium that scatters it.
//
// The length is sampled exactly: the sum of density times length is inverted voxel by voxel,
// without rejections ("regular tracking"). Where the three colours are scattered differently, one
// of them chooses the length, and all are weighted by the balance heuristic (Veach & Guibas 1995).
#ifndef VXL_FREE_PATH_H
#define VXL_FREE_PATH_H

#include "lib/lanes/exact_exp.h"
#include "lib/light/phase.h"
#include "lib/sampling/sobol.h"
#include "lib/traverse/segment.h"

/// How far paths go before the medium scatters them.
typedef struct {
    lane_float t;
    lane_float depth;  // sum of density times t up to there
    lane_int ends;     // mask: the medium scatters them there
} FreePath;

/// Follows the segments through the voxels until density times t sums up to `sought`.
static inline FreePath travel_through_grid(PyramidShape shape, const DensityView* density,
                                           const Segment* s, lane_float sought, lane_int active) {
    const lane_float zero = (lane_float)0.0f, one = (lane_float)1.0f;
    FreePath f = {s->t_last, zero, (lane_int)0};
    lane_float lost = zero, entered = s->t_first, entered_low = zero;
    const PyramidView p = grid_view(shape);
    Walk walk = walk_along(s);
    lane_int walking = active & in_grid(&p, &walk) & LANE_MASK(s->t_first < s->t_last);
    while (lanes_any(walking)) {
        const DensityCell cell = look_up_density(density, walk.x, walk.y, walk.z, walking);
        const lane_float begins = entered, before = f.depth - lost;
        const Stretch stretch = cross_cell(&p, density, &walk, &cell, s->t_first, s->t_last,
                                           &entered, &entered_low, walking);
        const lane_float left = sought - before;
        const lane_int ends = stretch.counts & LANE_MASK(cell.density > 0.0f) &
                              LANE_MASK(cell.density * stretch.length > left);
        const lane_float part = exact_divide(left, LANES_SELECT(ends, cell.density, one));
        f.t = LANES_SELECT(ends, begins + part, f.t);
        f.ends |= ends;
        add_exactly(&f.depth, &lost, cell.density * stretch.length, stretch.counts & ~ends);
        walking &= ~(ends | stretch.ends) & in_grid(&p, &walk);
    }
    f.depth = LANES_SELECT(f.ends, sought, f.depth - lost);
    return f;
}

/// Follows the segments of the `active` lanes until density times t sums up to `sought`.
static inline FreePath travel_until(PyramidShape shape, const DensityView* density,
                                    const Segment* s, lane_float sought, lane_int active) {
    if (VXL_MEDIUM_GRID) return travel_through_grid(shape, density, s, sought, active);
    const Segment inside = part_in_world(shape, *s);
    const lane_float length = fmax(inside.t_last - inside.t_first, 0.0f);
    FreePath f;
    f.ends = active & LANE_MASK(sought < length);
    f.depth = LANES_SELECT(f.ends, sought, LANES_SELECT(active, length, (lane_float)0.0f));
    f.t = LANES_SELECT(f.ends, inside.t_first + sought, s->t_last);
    return f;
}

/// The optical depth at which light of one of the colours is scattered, divided by its rate: a sum
/// of density times metres. It is infinite for a colour that isn't scattered.
static inline lane_float sought_depth(const MediumScattering* m, SquarePoint p) {
    const lane_float third = p.y * 3.0f;
    const lane_float rate =
        LANES_SELECT(LANE_MASK(third < 1.0f), (lane_float)m->per_metre[0],
                     LANES_SELECT(LANE_MASK(third < 2.0f), (lane_float)m->per_metre[1],
                                  (lane_float)m->per_metre[2]));
    const lane_int some = LANE_MASK(rate > 0.0f);
    const lane_float depth =
        exact_divide(-exact_log(1.0f - p.x), LANES_SELECT(some, rate, (lane_float)1.0f));
    return LANES_SELECT(some, fmax(depth, 0.0f), (lane_float)INFINITY);
}

/// The density of the medium on the segments at `t`; 1 without a lattice. Rounding may move a point
/// on the world's border outside, where there is no voxel.
static inline lane_float density_at(PyramidShape shape, const DensityView* density,
                                    const Segment* s, lane_float t, lane_int active) {
    if (!VXL_MEDIUM_GRID) return (lane_float)1.0f;
    const Vector o = s->origin, d = s->direction;
    const Vector at = {fma(t, d.x, o.x), fma(t, d.y, o.y), fma(t, d.z, o.z)};
    const lane_int x = clamp(LANES_INT(floor(at.x)), (lane_int)0, (lane_int)(shape.size_x - 1));
    const lane_int y = clamp(LANES_INT(floor(at.y)), (lane_int)0, (lane_int)(shape.size_y - 1));
    const lane_int z = clamp(LANES_INT(floor(at.z)), (lane_int)0, (lane_int)(shape.size_z - 1));
    const DensityCell cell = look_up_density(density, x, y, z, active);
    return LANES_SELECT(active, cell.density, (lane_float)0.0f);
}

/// The probability, per metre, that a path is scattered behind `depth` of the medium, at a position
/// where the medium has this `density`.
static inline lane_float chance_density(const MediumScattering* m, lane_float depth,
                                        lane_float density) {
    lane_float sum = (lane_float)0.0f;
    for (int c = 0; c < 3; ++c) sum += m->per_metre[c] * exact_exp(-m->per_metre[c] * depth);
    return sum * density * 0.333333333f;
}

/// Multiplies the throughput of each colour by the probability with which that colour comes through
/// `depth` (and, in the `ends` lanes, is scattered there), divided by the mean of this probability
/// over all colours, by which the length was sampled.
static inline void weigh_colors(const MediumScattering* m, lane_float depth, lane_int ends,
                                lane_int active, lane_float* throughput) {
    const float* rates = m->per_metre;
    if (rates[0] == rates[1] && rates[1] == rates[2]) return;
    lane_float share[3], sum = (lane_float)0.0f;
    for (int c = 0; c < 3; ++c) {
        share[c] = exact_exp(-rates[c] * depth);
        share[c] *= LANES_SELECT(ends, (lane_float)rates[c], (lane_float)1.0f);
        sum += share[c];
    }
    const lane_int some = active & LANE_MASK(sum > 0.0f);
    const lane_float safe = LANES_SELECT(some, sum, (lane_float)1.0f);
    for (int c = 0; c < 3; ++c)
        throughput[c] *= LANES_SELECT(some, exact_divide(3.0f * share[c], safe), (lane_float)1.0f);
}

#endif
