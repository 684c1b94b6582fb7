// SPDX-License-Identifier: Apache-2.0
// Media that scatter light: how much, and into which directions.
//
// The phase function is that of Henyey & Greenstein 1941, "Diffuse radiation in the galaxy". With
// the anisotropy g, the mean cosine between the directions of light before and after, it is (1 -
// g^2) / (4 pi (1 + g^2 - 2 g cosine)^1.5).
#ifndef VXL_PHASE_H
#define VXL_PHASE_H

#include "lib/sampling/directions.h"

/// How a medium scatters light.
typedef struct {
    float per_metre[3];  // at density 1
    float anisotropy;
} MediumScattering;

// The parameter that only scenes with such a medium need. A comma ends it.
#if VXL_SCATTERING
#define VXL_SCATTERING_PARAMETER float4 scattering,
#define VXL_MEDIUM_SCATTERING \
    { {scattering.x, scattering.y, scattering.z}, scattering.w }
#else
#define VXL_SCATTERING_PARAMETER
#define VXL_MEDIUM_SCATTERING \
    { {0.0f, 0.0f, 0.0f}, 0.0f }
#endif

/// The density, per solid angle, of directions whose angle with the direction of the light before
/// has this cosine.
static inline lane_float phase_density(float g, lane_float cosine) {
    const lane_float squared = fmax(fma((lane_float)(-2.0f * g), cosine, fma(g, g, 1.0f)),
                                    (1.0f - fabs(g)) * (1.0f - fabs(g)));
    const float scale = fma(-g, g, 1.0f) * 0.0795774715f;  // 1 / (4 pi)
    return exact_divide((lane_float)scale, squared * exact_sqrt(squared));
}

/// A direction around `way` with the density phase_density, chosen by a point of the unit square.
/// The cosine's usual formula is expanded so that nothing is divided by g.
static inline Vector phase_direction(float g, Vector way, SquarePoint p) {
    const lane_float x = fma(p.x, 2.0f, -1.0f), squared = x * x;
    const lane_float below = fma((lane_float)g, x, 1.0f);
    lane_float above = fma((lane_float)(0.5f * g * g * g), squared - 1.0f, x);
    above += fma((lane_float)(0.5f * g), squared + 3.0f, (g * g) * x);
    const lane_float cosine = clamp(exact_divide(above, below * below), -1.0f, 1.0f);
    const lane_float sine = exact_sqrt(fma(-cosine, cosine, 1.0f));
    lane_float turn_sine, turn_cosine;
    exact_sincos(p.y * 6.28318531f, &turn_sine, &turn_cosine);
    return around_normal(way, sine * turn_cosine, sine * turn_sine, cosine);
}

#endif
