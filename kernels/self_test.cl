// SPDX-License-Identifier: Apache-2.0
// questions -> answers that are known: a driver that gives other answers is refused. The questions
// cover what images depend on, in code written for this test
// (runtime/opencl/self_test/self_test.hpp).
#include "lib/lanes/exact_exp.h"
#include "lib/lanes/work_item.h"
#include "lib/traverse/walk.h"
#include "shared/self_test.h"

#define QUESTION(row) ((row)*VXL_KNOWN_COLUMNS + first)
#define ANSWER_FLOAT(value, row) LANES_STORE(LANES_AS_UINT(value), answers, QUESTION(row))
#define ANSWER_INT(value, row) ANSWER_FLOAT(value, row)

static inline void answer_floats(lane_float x, lane_float y, lane_float z, uint first,
                                 global uint* restrict answers) {
    lane_float sine, cosine;
    exact_sincos(y, &sine, &cosine);
    ANSWER_FLOAT(exact_reciprocal(x), VXL_KNOWN_RECIPROCAL);
    ANSWER_FLOAT(exact_divide(y, x), VXL_KNOWN_QUOTIENT);
    ANSWER_FLOAT(exact_sqrt(x), VXL_KNOWN_ROOT);
    ANSWER_FLOAT(exact_exp(y), VXL_KNOWN_EXPONENTIAL);
    ANSWER_FLOAT(exact_log(x), VXL_KNOWN_LOGARITHM);
    ANSWER_FLOAT(sine, VXL_KNOWN_SINE);
    ANSWER_FLOAT(cosine, VXL_KNOWN_COSINE);
    ANSWER_FLOAT(fma(x, y, z), VXL_KNOWN_FUSED);
    ANSWER_FLOAT(x * y + z, VXL_KNOWN_UNFUSED);
    ANSWER_INT(LANES_INT(rint(y * 64.0f)), VXL_KNOWN_WHOLE);
}

static inline void answer_ints(lane_int i, lane_int j, uint first, global uint* restrict answers) {
    const lane_long square = LANES_LONG(i) * LANES_LONG(i);
    const lane_long product = LANES_LONG(i) * LANES_LONG(j);
    ANSWER_FLOAT(LANES_FLOAT(i), VXL_KNOWN_FROM_INT);
    ANSWER_INT(lanes_popcount(LANES_AS_UINT(i)), VXL_KNOWN_BITS);
    ANSWER_INT(LANES_UINT((product >> 16) & 0xFFFFFFFFL), VXL_KNOWN_LONG_PRODUCT);
    ANSWER_INT(LANE_LONG_MASK(product * 3 <= square), VXL_KNOWN_LONG_COMPARISON);
}

/// Walks the rays to the first voxels that they meet, cell by cell. `voxels` has a bit for each
/// cell, x fastest.
static inline void answer_rays(PyramidShape shape, global const uint* restrict voxels,
                               global const float* restrict rays, uint first,
                               global uint* restrict answers) {
    const PyramidView p = grid_view(shape);
    Walk w = load_walk(rays, VXL_KNOWN_COLUMNS, first);
    enter_world(&p, &w, (lane_int)-1);
    lane_int walking = in_grid(&p, &w), hit = (lane_int)0;
    while (lanes_any(walking)) {
        const lane_int cell = ((w.z * p.size_y + w.y) * p.size_x + w.x) & walking;
        const lane_uint word = LANES_GATHER_UINT(voxels, cell >> 5);
        hit |= LANE_MASK(((word >> LANES_AS_UINT(cell & 31)) & 1u) != 0u) & walking;
        walking &= ~hit;
        advance(&p, &w, (lane_int)0, walking);
        walking &= in_grid(&p, &w);
    }
    const lane_uint cell = LANES_AS_UINT(w.x | (w.y << 8) | (w.z << 16) | (w.axis << 24));
    ANSWER_INT(LANES_SELECT(hit, cell, (lane_uint)VXL_NO_VOXEL), VXL_KNOWN_HIT_CELL);
    ANSWER_FLOAT(LANES_SELECT(hit, w.t, (lane_float)0.0f), VXL_KNOWN_HIT_T);
}

/// One work-item answers as many columns as it has lanes.
kernel void answer_lanes(global const uint* restrict questions, PyramidShape shape,
                         global const uint* restrict voxels, global uint* restrict answers) {
    const uint first = work_item() * VXL_LANES;
    if (first >= VXL_KNOWN_COLUMNS) return;
    global const float* floats = (global const float*)questions;
    answer_floats(LANES_LOAD(floats, QUESTION(VXL_KNOWN_X)),
                  LANES_LOAD(floats, QUESTION(VXL_KNOWN_Y)),
                  LANES_LOAD(floats, QUESTION(VXL_KNOWN_Z)), first, answers);
    answer_ints(LANES_AS_INT(LANES_LOAD(questions, QUESTION(VXL_KNOWN_I))),
                LANES_AS_INT(LANES_LOAD(questions, QUESTION(VXL_KNOWN_J))), first, answers);
    answer_rays(shape, voxels, floats + VXL_KNOWN_RAYS * VXL_KNOWN_COLUMNS, first, answers);
}

static inline uint sum_of_squares(uint digits) {
    uchar count[4] = {0, 0, 0, 0};
    for (int k = 0; k < 16; ++k) ++count[(digits >> (2 * k)) & 3u];
    uint sum = 0;
    for (int k = 0; k < 4; ++k) sum += (uint)count[k] * count[k];
    return sum;
}

static inline int sum_from(short start, short factor) {
    const short16 numbers = (short16)(0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15);
    const short16 v = select((short16)(0), numbers, numbers >= start);
    const short8 eight = v.lo + v.hi;
    const short4 four = eight.lo + eight.hi;
    return (int)(short)(four.x + four.y + four.z + four.w) * factor;
}

/// Rounds of a generator (Marsaglia 2003). Mesa's llvmpipe ends all loops of a kernel after 65,535
/// rounds together, into each of which a compiler may put two of these.
static inline uint shift_often(uint number, int rounds) {
    for (int k = 0; k < rounds; ++k) {
        number ^= number << 13;
        number ^= number >> 17;
        number ^= number << 5;
    }
    return number;
}

/// One work-item answers one column. The atomics' answers are in one row.
kernel void answer_numbers(global const uint* restrict questions, global uint* restrict answers) {
    const uint first = work_item();
    if (first >= VXL_KNOWN_COLUMNS) return;
    const int i = (int)questions[QUESTION(VXL_KNOWN_I)];
    const int j = (int)questions[QUESTION(VXL_KNOWN_J)];
    const long both = ((long)i << 32) | (uint)j, divisor = 2 * (long)j + 1;
    answers[QUESTION(VXL_KNOWN_LONG_QUOTIENT)] = (uint)(both / divisor);
    answers[QUESTION(VXL_KNOWN_LONG_REMAINDER)] = (uint)(both % divisor);
    answers[QUESTION(VXL_KNOWN_LONG_SHIFT)] = (uint)(both >> (j & 63));
    answers[QUESTION(VXL_KNOWN_UPPER_HALF)] = (uint)mul_hi(i, j);
    answers[QUESTION(VXL_KNOWN_LEADING_ZEROS)] = clz((uint)i >> (j & 31));
    answers[QUESTION(VXL_KNOWN_PRIVATE_ARRAY)] = sum_of_squares((uint)i);
    answers[QUESTION(VXL_KNOWN_VECTOR)] = (uint)sum_from((short)(i & 15), (short)j);
    answers[QUESTION(VXL_KNOWN_LONG_LOOP)] = shift_often((uint)j, 140000 + (i & 63));
    global uint* atomics = answers + VXL_KNOWN_ATOMICS * VXL_KNOWN_COLUMNS;
    atomic_inc(&atomics[0]);
    atomic_add(&atomics[1], (uint)j);
    atomic_or(&atomics[2], 1u << (i & 31));
    atomic_min((global int*)&atomics[3], i);
}
