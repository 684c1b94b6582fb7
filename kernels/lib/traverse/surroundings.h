// SPDX-License-Identifier: Apache-2.0
// The data on surfaces and the medium that rays need to continue through surfaces.
#ifndef VXL_SURROUNDINGS_H
#define VXL_SURROUNDINGS_H

#include "lib/traverse/density.h"

/// The medium of S.
typedef struct {
    float4 absorption;  // per metre, at density 1
    DensityView density;
} MediumView;

/// The parameters that `bind` of Surroundings sets, in its order.
#define VXL_SURROUNDINGS_PARAMETERS                                            \
    global const float *restrict materials, global const uint *restrict ranks, \
        global uint *medium_overflows, float4 absorption, VXL_DENSITY_PARAMETERS

/// The arrays are described in runtime/stages/trace/trace.hpp.
typedef struct {
    global const float* restrict materials;
    global const uint* restrict ranks;
    global uint* medium_overflows;
    MediumView medium;
} Surroundings;

/// The value of Surroundings in a kernel with these parameters.
#define VXL_SURROUNDINGS                      \
    {                                         \
        materials, ranks, medium_overflows, { \
            absorption, VXL_DENSITY           \
        }                                     \
    }

#endif
