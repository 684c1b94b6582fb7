// SPDX-License-Identifier: Apache-2.0
// Snell's and Fresnel's laws over lanes, without harmful cancellation.
#ifndef VXL_OPTICS_H
#define VXL_OPTICS_H

#include "lib/lanes/vector.h"

/// How light continues behind a surface between two media.
typedef struct {
    lane_int total;        // mask: total internal reflection
    lane_float cosine;     // of the angle of refraction, 0 where total
    lane_float reflected;  // Fresnel's reflectance of unpolarised light, 1 where total
    lane_float refracted;  // 1 - reflected; the smaller of the two is not a difference
} Refraction;

/// cos^2 of the angle of refraction: 1 - eta^2 (1 - c^2) = (eta c)^2 - (eta^2 - 1).
///
/// For eta below 1 this is a sum. For eta above 1, the sign of eta c - sqrt(eta^2 - 1) decides:
/// eta^2 - 1 = (eta - 1) (eta + 1) and its root are held in two floats each, also for indices that
/// are almost equal, so that the sign is right within 1e-7 of the critical angle. Source: accuracy
/// notes on Snell's law; Kahan.
static inline lane_float squared_cosine(lane_float eta, lane_float c) {
    const lane_int denser = LANE_MASK(eta > 1.0f);
    const lane_float less = fabs(eta - 1.0f), more = eta + 1.0f;
    const lane_float excess = less * more;  // and `rest`, for eta > 1
    const lane_float rest = fma(less, 1.0f - (more - eta), fma(less, more, -excess));
    const lane_float high = exact_sqrt(excess);
    const lane_float low = exact_divide(fma(-high, high, excess) + rest,
                                        LANES_SELECT(denser, 2.0f * high, (lane_float)1.0f));
    const lane_float from_denser = (fma(eta, c, -high) - low) * fma(eta, c, high);
    const lane_float from_rarer = fma(eta * c, eta * c, excess);
    return LANES_SELECT(denser, from_denser, from_rarer);
}

/// Refracts at a surface. `eta` is the index before the surface over the one behind it, `c` the
/// cosine of incidence. At c = 0, ratios between equal media and under total reflection would be 0
/// / 0, but are not needed; elsewhere floats differ from 1 by at least 2^-24, so c or the cosine
/// behind is above 3e-4.
static inline Refraction refraction_at(lane_float eta, lane_float c) {
    const lane_float square = squared_cosine(eta, c);
    const lane_int same = LANE_MASK(eta == 1.0f);
    Refraction r;
    r.total = LANE_MASK(square < 0.0f);
    r.cosine = LANES_SELECT(same, c, exact_sqrt(fmax(square, 0.0f)));
    const lane_float ec = eta * c, et = eta * r.cosine;
    const lane_float across = exact_reciprocal(ec + r.cosine), along = exact_reciprocal(c + et);
    const lane_float rs = (ec - r.cosine) * across, rp = (c - et) * along;
    r.reflected = 0.5f * fma(rs, rs, rp * rp);
    r.refracted = 2.0f * ec * r.cosine * fma(across, across, along * along);
    const lane_float one = (lane_float)1.0f, zero = (lane_float)0.0f;
    const lane_int weak = LANE_MASK(r.reflected < 0.5f);
    r.refracted = LANES_SELECT(weak, one - r.reflected, r.refracted);
    r.reflected = LANES_SELECT(weak, r.reflected, one - r.refracted);
    r.reflected = LANES_SELECT(r.total, one, LANES_SELECT(same, zero, r.reflected));
    r.refracted = LANES_SELECT(r.total, zero, LANES_SELECT(same, one, r.refracted));
    return r;
}

/// The unit direction behind a surface of a ray along the unit vector `v`. `n` is the unit normal
/// against the ray, `c` the cosine of incidence; `eta` and `bend` are as in refraction_at, without
/// total reflection.
static inline Vector refracted_direction(Vector v, Vector n, lane_float eta, lane_float c,
                                         const Refraction* bend) {
    const lane_float turn = fma(eta, c, -bend->cosine);
    const Vector bent = {fma(turn, n.x, eta * v.x), fma(turn, n.y, eta * v.y),
                         fma(turn, n.z, eta * v.z)};
    return bent;
}

#endif
