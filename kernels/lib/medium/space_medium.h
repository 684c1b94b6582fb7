// SPDX-License-Identifier: Apache-2.0
// The medium of the space between the observer and surfaces, as kernels of displays take it.
#ifndef VXL_SPACE_MEDIUM_H
#define VXL_SPACE_MEDIUM_H

#include "lib/traverse/density.h"
#include "shared/scene.h"

/// The parameters that runtime/stages/medium/space_medium.hpp binds to a SpaceMedium, in its order.
#define VXL_SPACE_MEDIUM_PARAMETERS \
    Environment environment, VXL_DENSITY_PARAMETERS, global const float *restrict density_colors

typedef struct {
    Environment environment;
    DensityView density;
    global const float* colors;  // of the density's values
} SpaceMedium;

/// The value of a SpaceMedium in a kernel with these parameters.
#define VXL_SPACE_MEDIUM \
    { environment, VXL_DENSITY, density_colors }

#endif
