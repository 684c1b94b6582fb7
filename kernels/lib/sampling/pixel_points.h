// SPDX-License-Identifier: Apache-2.0
// Points of the unit square for the decisions of an image's pixels, whose errors cancel in the
// picture: what one pixel has too much, its neighbours have too little, as in blue noise. Each
// pixel alone has a scrambled sequence of sobol.h, so none is noisier than without.
//
// Any 2^k first samples of all pixels of a square of 2, 4 or 8 pixels fall one each into boxes that
// divide the unit square evenly, whatever their shape. For that, take a sample's number as a
// polynomial N(z) over two elements. The digits of Sobol's x are its coefficients, those of his y
// the coefficients at 1 + z. A pixel whose place in squares of 2^j pixels has the bits u_j and v_j
// adds the sum of (u_j + v_j z) / (1 + z + z^2)^j to it. For m of them the sum times
// (1 + z + z^2)^m is a polynomial of less than k + 2m coefficients, and any k + 2m digits, the
// first of x and the first of y, tell which, as polynomials with so many zeroes at 0 and 1 are
// zero. (The poles are places of a rational function field: Niederreiter & Xing 1996,
// "Low-discrepancy sequences and global function fields with many rational places". That errors of
// neighbours cancel so: Ahmed & Wonka 2020, "Screen-Space Blue-Noise Diffusion of Monte Carlo
// Sampling Error via Hierarchical Ordering of Pixels", whose order needs a number of samples that
// is fixed.)
#ifndef VXL_PIXEL_POINTS_H
#define VXL_PIXEL_POINTS_H

#include "lib/sampling/sobol.h"

/// Pixels are numbered by column + 65536 * row. These bits tell those of a square of 8 x 8 apart.
#define VXL_PIXELS_OF_SQUARE 0x00070007u

/// Two bits of a pixel's place, rearranged.
typedef struct {
    lane_uint u, v;
} PlaceDigit;

/// Which quarter of a square of 2^(j + 1) pixels a pixel lies in, rearranged by a random number of
/// the square: each two quarters become each two others with the same probability. For that, the
/// bits of the place and their sum are turned, any two of which tell the third.
static inline PlaceDigit rearranged_digit(lane_uint pixel, uint j, lane_uint random) {
    const lane_uint u = pixel >> j, v = pixel >> (16 + j), sum = u ^ v;
    const lane_uint turns = (((random >> 8) & 0xFFu) * 3u) >> 8;
    const lane_int stays = LANE_MASK(turns == 0u), turns_once = LANE_MASK(turns == 1u);
    const lane_uint first = LANES_SELECT(stays, u, LANES_SELECT(turns_once, v, sum));
    const lane_uint second = LANES_SELECT(stays, v, LANES_SELECT(turns_once, sum, u));
    const PlaceDigit digit = {(first ^ random) & 1u, (second ^ (random >> 1)) & 1u};
    return digit;
}

/// 16 bits for a decision about what has this number. Numbers are mixed for all decisions at once.
static inline lane_uint random_for(lane_uint number, lane_uint seed) {
    return (mixed_bits(number + 0x9E3779B9u) * (seed | 1u)) >> 16;
}

/// What pixels add to the digits of Sobol's points, the first digit of each coordinate lowest.
static inline SquareBits digits_of_pixel(lane_uint pixel, lane_uint seed) {
    // 1 / (1 + z + z^2)^j as a power series: 1 + z + z^3 + z^4 + z^6 ..., its square and its cube.
    const uint series[3] = {0xDB6DB6DBu, 0x45145145u, 0x77077077u};
    lane_uint of_one = (lane_uint)0, of_z = (lane_uint)0;
    for (uint j = 0; j < 3u; ++j) {
        const uint inside = ((2u << j) - 1u) * 0x00010001u;
        const PlaceDigit digit =
            rearranged_digit(pixel, j, random_for((pixel & ~inside) ^ (j << 30), seed));
        of_one ^= -digit.u & series[j];
        of_z ^= -digit.v & series[j];
    }
    const lane_uint x = of_one ^ (of_z << 1);
    const SquareBits digits = {x, x ^ of_z};  // at 1 + z, u + v z is u + v + v z
    return digits;
}

/// Exchanges samples of 2^k to 2^(k + 1) - 1 with each other, for each k and pixel, so that the
/// pixels of a square pair the points of different decisions differently.
static inline lane_uint exchanged_sample(lane_uint sample, lane_uint random) {
    lane_uint ones = sample | (sample >> 1);
    ones |= ones >> 2;
    ones |= ones >> 4;
    ones |= ones >> 8;
    ones |= ones >> 16;
    return sample ^ (random & (ones >> 1));
}

/// The points of samples of pixels for a decision, as 32-bit fractions.
static inline SquareBits pixel_bits(lane_uint sample, lane_uint pixel, lane_uint decision) {
    const lane_uint seed = decision_seed(pixel & ~VXL_PIXELS_OF_SQUARE, decision);
    const SquareBits added = digits_of_pixel(pixel, seed);
    const lane_uint shuffled =
        shuffled_sample(exchanged_sample(sample, random_for(pixel, ~seed)), seed);
    return scrambled_digits(shuffled ^ added.x, shifted_polynomial(shuffled) ^ added.y, seed);
}

/// The same as numbers from 0 to 1.
static inline SquarePoint pixel_point(lane_uint sample, lane_uint pixel, lane_uint decision) {
    return point_of_bits(pixel_bits(sample, pixel, decision));
}

#endif
