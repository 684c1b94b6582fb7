// SPDX-License-Identifier: Apache-2.0
// Points of the unit square for the decisions of paths: Sobol's sequence, scrambled and shuffled as
// Owen 1995 describes, by hashes (Burley 2020, "Practical Hash-based Owen Scrambling", JCGT 9(4)).
//
// 2^k successive samples fall one each into 2^k boxes that divide the square evenly, whatever their
// shape: the points are a (0,2)-sequence. Points of different seeds are independent. Everything is
// computed in integers, so all devices have the same points.
#ifndef VXL_SOBOL_H
#define VXL_SOBOL_H

#include "lib/lanes/lanes.h"

/// A point of the square [0, 1) x [0, 1).
typedef struct {
    lane_float x, y;
} SquarePoint;

/// A point of the square, each coordinate times 2^32.
typedef struct {
    lane_uint x, y;
} SquareBits;

static inline lane_uint reversed_bits(lane_uint v) {
    v = (v >> 16) | (v << 16);
    v = ((v >> 8) & 0x00FF00FFu) | ((v & 0x00FF00FFu) << 8);
    v = ((v >> 4) & 0x0F0F0F0Fu) | ((v & 0x0F0F0F0Fu) << 4);
    v = ((v >> 2) & 0x33333333u) | ((v & 0x33333333u) << 2);
    return ((v >> 1) & 0x55555555u) | ((v & 0x55555555u) << 1);
}

/// A bijection of 32-bit numbers in which every output bit depends on every input bit: the
/// finalizer of MurmurHash3 (Appleby 2011).
static inline lane_uint mixed_bits(lane_uint v) {
    v = (v ^ (v >> 16)) * 0x85EBCA6Bu;
    v = (v ^ (v >> 13)) * 0xC2B2AE35u;
    return v ^ (v >> 16);
}

/// Flips each bit by a hash of the seed and of the bits below it. Laine & Karras 2011, with
/// Burley's constants: an even factor carries bits upwards only.
static inline lane_uint flipped_from_below(lane_uint v, lane_uint seed) {
    v += seed;
    v ^= v * 0x6C50B47Cu;
    v ^= v * 0xB82F1E52u;
    v ^= v * 0xC7AFE638u;
    return v ^ (v * 0x8D22F6E6u);
}

/// The second Sobol coordinate of a number, its bits in reverse order.
///
/// The number is read as a polynomial over two elements and evaluated at 1 + x, because the
/// direction numbers are the rows of Pascal's triangle: (1 + x)^(2^j) = 1 + x^(2^j) adds, for each
/// j, the terms with bit j in their exponent to those without.
static inline lane_uint shifted_polynomial(lane_uint v) {
    v ^= (v & 0xAAAAAAAAu) >> 1;
    v ^= (v & 0xCCCCCCCCu) >> 2;
    v ^= (v & 0xF0F0F0F0u) >> 4;
    v ^= (v & 0xFF00FF00u) >> 8;
    return v ^ (v >> 16);
}

/// The upper 24 bits as a number in [0, 1).
static inline lane_float unit_interval(lane_uint v) {
    return LANES_FLOAT(v >> 8) * (1.0f / 16777216.0f);
}

/// A hash of a number; neighbouring numbers have unrelated hashes. Unlike in mixed_bits, 0 is not
/// mapped to itself.
static inline lane_uint mixed_number(lane_uint number) {
    return mixed_bits(number + 0x9E3779B9u);
}

/// The seed of one decision about whatever has this mixed number.
static inline lane_uint decision_seed(lane_uint mixed, lane_uint decision) {
    return mixed_bits(mixed + decision);
}

/// The number of the sample that replaces `sample`. The first 2^k samples, and each further block
/// of 2^k, are replaced by such a block.
static inline lane_uint shuffled_sample(lane_uint sample, lane_uint seed) {
    return reversed_bits(flipped_from_below(reversed_bits(sample), seed));
}

/// Scrambles coordinates whose first digits are their lowest bits. The results are 32-bit
/// fractions.
static inline SquareBits scrambled_digits(lane_uint x, lane_uint y, lane_uint seed) {
    const lane_uint seed_x = mixed_bits(seed ^ 0xA511E9B3u);
    // The first 16 digits of each coordinate depend on other bits.
    const lane_uint seed_y = (seed_x >> 16) | (seed_x << 16);
    const SquareBits p = {reversed_bits(flipped_from_below(x, seed_x)),
                          reversed_bits(flipped_from_below(y, seed_y))};
    return p;
}

/// The point of sample number `sample` in the sequence of a seed, as 32-bit fractions.
static inline SquareBits sobol_bits(lane_uint sample, lane_uint seed) {
    const lane_uint shuffled = shuffled_sample(sample, seed);
    return scrambled_digits(shuffled, shifted_polynomial(shuffled), seed);
}

/// Fractions as numbers from 0 to 1.
static inline SquarePoint point_of_bits(SquareBits bits) {
    const SquarePoint p = {unit_interval(bits.x), unit_interval(bits.y)};
    return p;
}

/// Point number `sample` of the scrambled sequence, as numbers from 0 to 1.
static inline SquarePoint sobol_point(lane_uint sample, lane_uint seed) {
    return point_of_bits(sobol_bits(sample, seed));
}

/// The number of the part, of `count` equal parts of [0, 1), in which a 32-bit fraction lies. With
/// 2^20 parts, their sizes differ by at most 1 in 4096 fractions; the 24 bits of a float would make
/// some of them a sixteenth larger.
static inline lane_uint part_of(lane_uint fraction, uint count) {
    return mul_hi(fraction, (lane_uint)count);
}

#endif
