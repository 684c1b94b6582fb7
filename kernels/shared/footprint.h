// SPDX-License-Identifier: Apache-2.0
// How much of the world a sight ray stands for; textures are blurred accordingly.
#ifndef VXL_SHARED_FOOTPRINT_H
#define VXL_SHARED_FOOTPRINT_H

#ifdef __cplusplus
#include <kernels/shared/scene.h>
namespace voxelume {
#else
#include "shared/scene.h"
#endif

// Values of Footprint::shape.
#define VXL_FOOTPRINT_PYRAMID 0  // the footprint grows with the depth
#define VXL_FOOTPRINT_BOX 1      // the footprint is constant
#define VXL_FOOTPRINT_CONE 2     // the footprint is a square across the ray and grows along it

// A sight ray of a pyramid or box stands for the cell that it lies in: a pixel, or a part of one
// where pixels have many samples. All samples in a cell therefore see the same mean of a texture,
// and their sum doesn't depend on how evenly they are spread.
typedef struct Footprint {
    float4 middle;  // E, in the world's voxels; w unused
    float4 across;  // metres from cell to cell along X_E, at a depth of one metre (pyramid) or at
                    // any depth (box); w: 1 over its square
    float4 down;    // the same along Y_E
    float4 ahead;   // Z_E, a unit vector in metres; w unused
    float half_columns, half_rows;  // cells from the middle to the image's border; 0: rays stand
                                    // for what lies around them, whatever the cell
    float spread;                   // metres by which a ray widens per metre of its way
    float width;                    // in boxes, the width of a ray at its start, metres
    int shape;
    int unused[3];
} Footprint;
VXL_SIZE_IS(Footprint, 96);

#ifdef __cplusplus
}  // namespace voxelume
#endif

#endif
