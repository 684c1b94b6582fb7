// SPDX-License-Identifier: Apache-2.0
// Points of the unit square for the decisions of an image's pixels. Their errors cancel in the
// picture: where one pixel has too much, its neighbours have too little, as in blue noise. Each
// pixel alone has a scrambled sequence of sobol.h, so none is noisier than without this.
//
// The first 2^k samples of all pixels of a square of 2 x 2 or 4 x 4 fall one each into boxes that
// divide the unit square evenly, whatever their shape. To see this, read a sample's number as a
// polynomial N(z) over two elements. The digits of Sobol's x are its coefficients, those of his y
// the coefficients at 1 + z. A pixel whose position in squares of 2^j x 2^j has the bits u_j and
// v_j adds the sum of (u_j + v_j z) / (1 + z + z^2)^j to it. For the m sizes up to a square's own,
// the sum times (1 + z + z^2)^m is a polynomial of less than k + 2m coefficients, and any k + 2m
// digits, the first of x and the first of y, tell which, as polynomials with so many zeroes at 0
// and 1 are zero. (The poles are places of a rational function field: Niederreiter & Xing 1996,
// "Low-discrepancy sequences and global function fields with many rational places". That errors of
// neighbours cancel so: Ahmed & Wonka 2020, "Screen-Space Blue-Noise Diffusion of Monte Carlo
// Sampling Error via Hierarchical Ordering of Pixels", whose order needs a number of samples that
// is fixed.)
#ifndef VXL_PIXEL_POINTS_H
#define VXL_PIXEL_POINTS_H

#include "lib/sampling/sobol.h"

/// Pixels are numbered by column + 65536 * row. The first of these masks selects the bits that
/// distinguish the pixels of a square of 4 x 4, the second those of a square of 2 x 2.
#define VXL_PIXELS_OF_SQUARE 0x00030003u
#define VXL_PIXELS_OF_QUARTER 0x00010001u

/// Two bits of a pixel's position, rearranged.
typedef struct {
    lane_uint u, v;
} PositionDigit;

/// The quarter of a square of 2^(j + 1) x 2^(j + 1) that a pixel lies in, rearranged by 16 random
/// bits of the square: any two quarters become any two others with almost the same probability. To
/// this end, the bits of the position and their sum are rotated; any two of these determine the
/// third.
static inline PositionDigit rearranged_digit(lane_uint pixel, uint j, lane_uint random) {
    const lane_uint u = pixel >> j, v = pixel >> (16 + j), sum = u ^ v;
    const lane_uint turns = (((random >> 8) & 0xFFu) * 3u) >> 8;
    const lane_int stays = LANE_MASK(turns == 0u), turns_once = LANE_MASK(turns == 1u);
    const lane_uint first = LANES_SELECT(stays, u, LANES_SELECT(turns_once, v, sum));
    const lane_uint second = LANES_SELECT(stays, v, LANES_SELECT(turns_once, sum, u));
    const PositionDigit digit = {(first ^ random) & 1u, (second ^ (random >> 1)) & 1u};
    return digit;
}

/// Samples of pixels, and values of theirs that all decisions share.
typedef struct {
    lane_uint pixel, sample;
    lane_uint before;                // all bits below the sample's highest set bit
    lane_uint own, quarter, square;  // mixed numbers of the pixel and of its squares
} SampledPixels;

static inline SampledPixels sampled_pixels(lane_uint pixel, lane_uint sample) {
    lane_uint ones = sample | (sample >> 1);
    ones |= ones >> 2;
    ones |= ones >> 4;
    ones |= ones >> 8;
    ones |= ones >> 16;
    const SampledPixels s = {pixel,
                             sample,
                             ones >> 1,
                             mixed_number(pixel),
                             mixed_number((pixel & ~VXL_PIXELS_OF_QUARTER) ^ 0x80000000u),
                             mixed_number(pixel & ~VXL_PIXELS_OF_SQUARE)};
    return s;
}

/// 16 random bits for a decision about whatever has this mixed number.
static inline lane_uint random_for(lane_uint mixed, lane_uint seed) {
    return (mixed * (seed | 1u)) >> 16;
}

/// The values that pixels add to the digits of Sobol's points. The first digit of each coordinate
/// is the lowest bit.
static inline SquareBits digits_of_pixel(const SampledPixels* s, lane_uint seed) {
    const PositionDigit fine = rearranged_digit(s->pixel, 0u, random_for(s->quarter, seed));
    const PositionDigit coarse = rearranged_digit(s->pixel, 1u, seed >> 16);
    // 1 / (1 + z + z^2) as a power series, 1 + z + z^3 + z^4 + z^6 ..., and its square.
    const uint series = 0xDB6DB6DBu, squared = 0x45145145u;
    const lane_uint of_one = (-fine.u & series) ^ (-coarse.u & squared);
    const lane_uint of_z = (-fine.v & series) ^ (-coarse.v & squared);
    const lane_uint x = of_one ^ (of_z << 1);
    const SquareBits digits = {x, x ^ of_z};  // at 1 + z, u + v z is u + v + v z
    return digits;
}

/// The points for a decision, as 32-bit fractions.
///
/// For each k, each pixel permutes samples 2^k to 2^(k + 1) - 1 in its own way, so that the pixels
/// of a square pair the points of different decisions differently.
static inline SquareBits pixel_bits(const SampledPixels* s, lane_uint decision) {
    const lane_uint seed = decision_seed(s->square, decision);
    const SquareBits added = digits_of_pixel(s, seed);
    const lane_uint exchanged = s->sample ^ (random_for(s->own, ~seed) & s->before);
    const lane_uint shuffled = shuffled_sample(exchanged, seed);
    return scrambled_digits(shuffled ^ added.x, shifted_polynomial(shuffled) ^ added.y, seed);
}

/// Returns the points for a decision as numbers from 0 to 1.
static inline SquarePoint pixel_point(const SampledPixels* s, lane_uint decision) {
    return point_of_bits(pixel_bits(s, decision));
}

#endif
