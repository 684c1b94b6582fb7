// SPDX-License-Identifier: Apache-2.0
// Reads eight words that follow each other, from a place of its own for each lane.
//
// Eight gathers would touch every place eight times. Instead each lane's words are one load, and
// the square of words is transposed in three rounds: round s exchanges, between vectors i and i +
// s, the words k with k & s (i without that bit) in each group of eight.
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

static inline void exchange_words_1(uint16* restrict a, uint16* restrict b) {
    const uint16 x = *a, y = *b;
    *a = (uint16)(x.s0, y.s0, x.s2, y.s2, x.s4, y.s4, x.s6, y.s6, x.s8, y.s8, x.sa, y.sa, x.sc,
                  y.sc, x.se, y.se);
    *b = (uint16)(x.s1, y.s1, x.s3, y.s3, x.s5, y.s5, x.s7, y.s7, x.s9, y.s9, x.sb, y.sb, x.sd,
                  y.sd, x.sf, y.sf);
}
static inline void exchange_words_2(uint16* restrict a, uint16* restrict b) {
    const uint16 x = *a, y = *b;
    *a = (uint16)(x.s01, y.s01, x.s45, y.s45, x.s89, y.s89, x.scd, y.scd);
    *b = (uint16)(x.s23, y.s23, x.s67, y.s67, x.sab, y.sab, x.sef, y.sef);
}
static inline void exchange_words_4(uint16* restrict a, uint16* restrict b) {
    const uint16 x = *a, y = *b;
    *a = (uint16)(x.s0123, y.s0123, x.s89ab, y.s89ab);
    *b = (uint16)(x.s4567, y.s4567, x.scdef, y.scdef);
}

/// Reads eight words of the array at p, from word `n` * unit on.
static inline Records read_words(global const uint* restrict p, uint unit, lane_uint n) {
    uint16 v0 = VXL_WORDS_PAIR(p, unit, n.s0, n.s8), v1 = VXL_WORDS_PAIR(p, unit, n.s1, n.s9);
    uint16 v2 = VXL_WORDS_PAIR(p, unit, n.s2, n.sa), v3 = VXL_WORDS_PAIR(p, unit, n.s3, n.sb);
    uint16 v4 = VXL_WORDS_PAIR(p, unit, n.s4, n.sc), v5 = VXL_WORDS_PAIR(p, unit, n.s5, n.sd);
    uint16 v6 = VXL_WORDS_PAIR(p, unit, n.s6, n.se), v7 = VXL_WORDS_PAIR(p, unit, n.s7, n.sf);
    exchange_words_1(&v0, &v1), exchange_words_1(&v2, &v3);
    exchange_words_1(&v4, &v5), exchange_words_1(&v6, &v7);
    exchange_words_2(&v0, &v2), exchange_words_2(&v1, &v3);
    exchange_words_2(&v4, &v6), exchange_words_2(&v5, &v7);
    exchange_words_4(&v0, &v4), exchange_words_4(&v1, &v5);
    exchange_words_4(&v2, &v6), exchange_words_4(&v3, &v7);
    const Records r = {{v0, v1, v2, v3, v4, v5, v6, v7}};
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
