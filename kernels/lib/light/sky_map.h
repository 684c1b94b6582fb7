// SPDX-License-Identifier: Apache-2.0
// A sky that is a picture of all surroundings: its radiance along directions, and directions chosen
// by the light that comes from them.
//
// Positions on the picture are u from left to right and v from the top down, both 0 to 1. The angle
// from the zenith is pi v. The middle column is seen along +Z, and +X lies left of it, as for an
// observer who looks along +Z.
#ifndef VXL_SKY_MAP_H
#define VXL_SKY_MAP_H

#include "lib/lanes/exact_angle.h"
#include "lib/lanes/exact_exp.h"
#include "lib/lanes/vector.h"
#include "lib/sampling/sobol.h"
#include "shared/sky.h"

/// The parameters that `bind` of a SkyMap sets, in its order; there are none for other skies. A
/// comma ends them.
#if VXL_SKY == VXL_SKY_MAP
#define VXL_SKY_MAP_PARAMETERS                                         \
    SkyMapRecord sky_map, global const float *restrict sky_map_texels, \
        global const uint *restrict sky_map_table,
#else
#define VXL_SKY_MAP_PARAMETERS
#endif

/// The picture; its texels are red, green and blue.
typedef struct {
    SkyMapRecord of;
    global const float* restrict texels;
    global const uint* restrict table;
} SkyMap;

/// The value of SkyMap in a kernel with these parameters.
#if VXL_SKY == VXL_SKY_MAP
#define VXL_SKY_MAP_VIEW \
    { sky_map, sky_map_texels, sky_map_table }
#else
#define VXL_SKY_MAP_VIEW \
    { {0, 0, 0, 0, 0, 0, 0, 0}, 0, 0 }
#endif

/// Directions' positions on the picture, and the sine of their angle from the zenith.
typedef struct {
    lane_float u, v, sine;
} SkyPoint;

/// The fractional part, in [0, 1), of a number in [-1, 2).
static inline lane_float turned_into_unit(lane_float x) {
    x = LANES_SELECT(LANE_MASK(x < 0.0f), x + 1.0f, x);
    x = LANES_SELECT(LANE_MASK(x >= 1.0f), x - 1.0f, x);
    return clamp(x, 0.0f, 0.99999994f);
}

/// The positions of unit vectors.
static inline SkyPoint sky_point(const SkyMap* m, Vector way) {
    SkyPoint p;
    p.sine = exact_sqrt(fma(way.x, way.x, way.z * way.z));
    p.u = turned_into_unit(fma(exact_atan2(way.x, way.z), -0.159154943f, 0.5f + m->of.turn));
    p.v = clamp(exact_atan2(p.sine, way.y) * 0.318309886f, 0.0f, 0.99999994f);
    return p;
}

/// The radiance along unit vectors: bilinear between the middles of texels.
static inline void sky_map_light(const SkyMap* m, Vector way, lane_float* light) {
    const SkyPoint p = sky_point(m, way);
    const int width = m->of.width, height = m->of.height;
    const lane_float x = fma(p.u, (lane_float)(float)width, (lane_float)0.5f);
    const lane_float y = fma(p.v, (lane_float)(float)height, (lane_float)0.5f);
    const lane_int right = LANES_INT(x), low = LANES_INT(y);  // texels from 1 on
    const lane_float share_x = x - LANES_FLOAT(right), share_y = y - LANES_FLOAT(low);
    const lane_int columns[2] = {
        LANES_SELECT(LANE_MASK(right == 0), (lane_int)(width - 1), right - 1),
        LANES_SELECT(LANE_MASK(right >= width), (lane_int)0, right)};
    const lane_int rows[2] = {max(low - 1, (lane_int)0), min(low, (lane_int)(height - 1))};
    for (int c = 0; c < 3; ++c) {
        lane_float row[2];
        for (int i = 0; i < 2; ++i) {
            const lane_uint first = LANES_AS_UINT(rows[i] * width) * 3u + (uint)c;
            const lane_float a =
                LANES_GATHER_FLOAT(m->texels, first + LANES_AS_UINT(columns[0]) * 3u);
            const lane_float b =
                LANES_GATHER_FLOAT(m->texels, first + LANES_AS_UINT(columns[1]) * 3u);
            row[i] = fma(share_x, b - a, a);
        }
        light[c] = fma(share_y, row[1] - row[0], row[0]) * m->of.strength;
    }
}

/// The density, per solid angle, of a direction in a cell whose density on the picture is
/// `of_cell`.
static inline lane_float density_in_cell(lane_float of_cell, lane_float sine) {
    return exact_divide(of_cell, fmax(sine, 9.5367431640625e-7f));
}

/// The probability, per solid angle, with which `choose_sky_direction` chooses unit vectors.
static inline lane_float sky_map_density(const SkyMap* m, Vector way) {
    const SkyPoint p = sky_point(m, way);
    const uint rows = (uint)m->of.rows, columns = (uint)m->of.columns;
    const lane_uint row = min(LANES_UINT(p.v * (float)rows), (lane_uint)(rows - 1u));
    const lane_uint column = min(LANES_UINT(p.u * (float)columns), (lane_uint)(columns - 1u));
    const lane_uint cell = rows + rows * columns + row * columns + column;
    const lane_float of_cell = LANES_AS_FLOAT(LANES_GATHER_UINT(m->table, cell));
    return density_in_cell(of_cell, p.sine);
}

/// The number of the part, of `count`, that holds a fraction. The table has the parts' first 32-bit
/// fractions from `base` on. Sets `share` to how far into the part the fraction lies, 0 to 1.
static inline lane_uint part_that_holds(global const uint* restrict table, lane_uint base,
                                        uint count, lane_uint fraction, lane_float* share) {
    lane_uint part = (lane_uint)0;
    for (uint step = VXL_SKY_MAX_CELLS / 2; step > 0; step >>= 1) {
        const lane_uint next = part + step;
        const lane_uint safe = min(next, (lane_uint)(count - 1u));
        const lane_int is_past =
            LANE_MASK(next < count) & LANE_MASK(LANES_GATHER_UINT(table, base + safe) <= fraction);
        part = LANES_SELECT(is_past, next, part);
    }
    const lane_uint start = LANES_GATHER_UINT(table, base + part);
    const lane_uint behind = min(part + 1u, (lane_uint)(count - 1u));
    // The last part ends at 2^32, which wraps to 0.
    const lane_uint end = LANES_SELECT(LANE_MASK(part + 1u < count),
                                       LANES_GATHER_UINT(table, base + behind), (lane_uint)0);
    const lane_uint width = end - start;
    const lane_float in_all =
        LANES_SELECT(LANE_MASK(width == 0u), (lane_float)4294967296.0f, LANES_FLOAT(width));
    *share = clamp(exact_divide(LANES_FLOAT(fraction - start), in_all), 0.0f, 0.99999994f);
    return part;
}

/// A unit vector chosen in proportion to the light that comes from around it, and its `density` per
/// solid angle.
static inline Vector choose_sky_direction(const SkyMap* m, SquareBits choice, lane_float* density) {
    const uint rows = (uint)m->of.rows, columns = (uint)m->of.columns;
    lane_float in_row, in_column;
    const lane_uint row = part_that_holds(m->table, (lane_uint)0, rows, choice.y, &in_row);
    const lane_uint column =
        part_that_holds(m->table, rows + row * columns, columns, choice.x, &in_column);
    const lane_float u = exact_divide(LANES_FLOAT(column) + in_column, (lane_float)(float)columns);
    const lane_float v = exact_divide(LANES_FLOAT(row) + in_row, (lane_float)(float)rows);
    const lane_float turned = turned_into_unit(u - m->of.turn);
    lane_float sine, cosine, aside, ahead;
    exact_sincos(v * 3.14159265f, &sine, &cosine);
    exact_sincos((0.5f - turned) * 6.28318531f, &aside, &ahead);
    const Vector way = {sine * aside, cosine, sine * ahead};
    const lane_uint cell = rows + rows * columns + row * columns + column;
    *density = density_in_cell(LANES_AS_FLOAT(LANES_GATHER_UINT(m->table, cell)), fabs(sine));
    return way;
}

#endif
