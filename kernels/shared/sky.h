// SPDX-License-Identifier: Apache-2.0
// The sky around the world, as kernels read it. Radiances are linear Rec. 709.
#ifndef VXL_SHARED_SKY_H
#define VXL_SHARED_SKY_H

#ifdef __cplusplus
#include <kernels/shared/scene.h>
namespace voxelume {
#else
#include "shared/scene.h"
#endif

// Values of the build constant VXL_SKY.
#define VXL_SKY_NONE 0
#define VXL_SKY_GRADIENT 1
#define VXL_SKY_SUN 2

typedef struct SkyRecord {
    float4 zenith, horizon;  // gradient: radiance at both; w unused
    float4 ground;           // radiance from below the horizon; w unused
    float4 sun_direction;    // sun: unit vector towards it; w: cosine of half the disc's angle
    float4 sun_radiance;     // of the disc, over the cube of the cosine with its middle; w unused
    // Preetham's sky: coefficients A, B, C and D of luminance Y and of chromaticities x and y.
    float4 luminance, chromaticity_x, chromaticity_y;
    float4 last;  // E of the three; w unused
    float4 base;  // the three at the zenith, over what the formula gives there; w unused
} SkyRecord;
VXL_SIZE_IS(SkyRecord, 160);

#ifdef __cplusplus
}  // namespace voxelume
#endif

#endif
