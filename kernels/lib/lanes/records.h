// SPDX-License-Identifier: Apache-2.0
// Reads eight words that follow each other, from a place of its own for each lane.
//
// Eight gathers would touch every place eight times. Instead each lane's words are one load, and
// the square of words is transposed in three rounds, each of whose steps is one instruction of a
// processor with vectors of 512 bits. The words of a step are named one by one, because LLVM makes
// three or four instructions of a step that names them by twos or fours.
#ifndef VXL_RECORDS_H
#define VXL_RECORDS_H

#include "lib/lanes/lanes.h"

#define VXL_RECORD_WORDS 8

/// `word[k]` holds word k of every lane's record.
typedef struct {
    lane_uint word[VXL_RECORD_WORDS];
} Records;

#if VXL_LANES == 16

#define VXL_WORDS_PAIR(p, unit, a, b)                            \
    ((uint16)(vload8(0, p + (size_t)(uint)(a) * (size_t)(unit)), \
              vload8(0, p + (size_t)(uint)(b) * (size_t)(unit))))

/// In each group of four words: x0 y0 x1 y1 and x2 y2 x3 y3.
static inline void mix_words(uint16* restrict a, uint16* restrict b) {
    const uint16 x = *a, y = *b;
    *a = (uint16)(x.s0, y.s0, x.s1, y.s1, x.s4, y.s4, x.s5, y.s5, x.s8, y.s8, x.s9, y.s9, x.sc,
                  y.sc, x.sd, y.sd);
    *b = (uint16)(x.s2, y.s2, x.s3, y.s3, x.s6, y.s6, x.s7, y.s7, x.sa, y.sa, x.sb, y.sb, x.se,
                  y.se, x.sf, y.sf);
}
/// In each group of four words: x0 x1 y0 y1 and x2 x3 y2 y3.
static inline void mix_pairs(uint16* restrict a, uint16* restrict b) {
    const uint16 x = *a, y = *b;
    *a = (uint16)(x.s0, x.s1, y.s0, y.s1, x.s4, x.s5, y.s4, y.s5, x.s8, x.s9, y.s8, y.s9, x.sc,
                  x.sd, y.sc, y.sd);
    *b = (uint16)(x.s2, x.s3, y.s2, y.s3, x.s6, x.s7, y.s6, y.s7, x.sa, x.sb, y.sa, y.sb, x.se,
                  x.sf, y.se, y.sf);
}
/// The groups of four words 0 and 2 of x and y, and their groups 1 and 3.
static inline void mix_groups(uint16* restrict a, uint16* restrict b) {
    const uint16 x = *a, y = *b;
    *a = (uint16)(x.s0, x.s1, x.s2, x.s3, x.s8, x.s9, x.sa, x.sb, y.s0, y.s1, y.s2, y.s3, y.s8,
                  y.s9, y.sa, y.sb);
    *b = (uint16)(x.s4, x.s5, x.s6, x.s7, x.sc, x.sd, x.se, x.sf, y.s4, y.s5, y.s6, y.s7, y.sc,
                  y.sd, y.se, y.sf);
}

/// Reads eight words of the array at p, from word `n` * unit on.
static inline Records read_words(global const uint* restrict p, uint unit, lane_uint n) {
    uint16 v0 = VXL_WORDS_PAIR(p, unit, n.s0, n.s4), v1 = VXL_WORDS_PAIR(p, unit, n.s1, n.s5);
    uint16 v2 = VXL_WORDS_PAIR(p, unit, n.s2, n.s6), v3 = VXL_WORDS_PAIR(p, unit, n.s3, n.s7);
    uint16 v4 = VXL_WORDS_PAIR(p, unit, n.s8, n.sc), v5 = VXL_WORDS_PAIR(p, unit, n.s9, n.sd);
    uint16 v6 = VXL_WORDS_PAIR(p, unit, n.sa, n.se), v7 = VXL_WORDS_PAIR(p, unit, n.sb, n.sf);
    mix_words(&v0, &v1), mix_words(&v2, &v3), mix_words(&v4, &v5), mix_words(&v6, &v7);
    mix_pairs(&v0, &v2), mix_pairs(&v1, &v3), mix_pairs(&v4, &v6), mix_pairs(&v5, &v7);
    mix_groups(&v0, &v4), mix_groups(&v2, &v6), mix_groups(&v1, &v5), mix_groups(&v3, &v7);
    const Records r = {{v0, v2, v1, v3, v4, v6, v5, v7}};
    return r;
}

#else

/// Reads eight words of the array at p, from word `n` * unit on.
static inline Records read_words(global const uint* restrict p, uint unit, lane_uint n) {
    Records r;
    for (uint i = 0; i < VXL_RECORD_WORDS; ++i) r.word[i] = LANES_GATHER_UINT(p, n * unit + i);
    return r;
}

#endif

/// Reads the records numbered `number`, of eight words each, of the array at p.
static inline Records read_records(global const uint* restrict p, lane_uint number) {
    return read_words(p, VXL_RECORD_WORDS, number);
}

#endif
