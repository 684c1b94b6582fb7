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
#define VXL_SKY_MAP 3

// The build constant VXL_SKY_RAYS says how paths find the light of a map; its values are those of
// VXL_EMITTERS.

typedef struct SkyRecord {
    float4 zenith, horizon;  // gradient: radiance at both; w unused
    float4 ground;           // radiance from below the horizon; w unused
    float4 sun_direction;    // sun: unit vector towards it; w: cosine of half the disc's angle
    float4 sun_radiance;     // of the disc, divided by the cube of the cosine with its middle; w
                             // unused
    // Preetham's sky: coefficients A, B, C and D of luminance Y and of chromaticities x and y.
    float4 luminance, chromaticity_x, chromaticity_y;
    float4 last;  // E of all three; w unused
    float4 base;  // the three at the zenith, divided by what the formula gives there; w unused
} SkyRecord;
VXL_SIZE_IS(SkyRecord, 160);

// The picture of a map, and the cells that directions are chosen from by their light. All cells are
// equally large on the picture. Their table holds, one after another: for each row, as a 32-bit
// fraction, where the part of [0, 1) begins that chooses it; for each row, likewise, where the
// parts of its cells begin; and for each cell, as a float, the density of its directions per solid
// angle, times the sine of their angle from the zenith.
typedef struct SkyMapRecord {
    int width, height;    // texels
    int columns, rows;    // cells
    float turn;           // rotation as a part of the full circle, counterclockwise seen from
                          // above; in [0, 1)
    float strength;       // multiplies the radiance
    float chance;         // probability that a ray that paths send to light goes to the sky
    unsigned int unused;  // 0
} SkyMapRecord;
VXL_SIZE_IS(SkyMapRecord, 32);
#define VXL_SKY_MAX_CELLS 2048  // along each side; a power of two

#ifdef __cplusplus
}  // namespace voxelume
#endif

#endif
