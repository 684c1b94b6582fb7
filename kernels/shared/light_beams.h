// SPDX-License-Identifier: Apache-2.0
// Beams from a light through the world; see light_beams.cl. Read by kernels and host code.
#ifndef VXL_SHARED_LIGHT_BEAMS_H
#define VXL_SHARED_LIGHT_BEAMS_H

#ifdef __cplusplus
#include <kernels/shared/scene.h>
namespace voxelume {
#else
#include "shared/scene.h"
#endif

// The number of beams in a tile of 4 x 4.
#define VXL_BEAM_TILE 16

// The grid in which a light's beams end if nothing blocks them, in the middles of its squares on
// the world's far side. Positions are in the world's voxels; b and c are the other two axes, in
// order. The array of ends is ordered tile by tile along b, then along c; it holds -infinity where
// no beam was sent.
typedef struct BeamGrid {
    int axis;            // the axis that the beams mostly follow ...
    float sign;          // ... towards larger coordinates (1) or smaller ones (-1)
    float far_side;      // coordinate of the world's far side on the axis
    int columns, rows;   // squares along b and c, multiples of 4; no columns: there are no beams
    float low_b, low_c;  // the minimum corner of the grid
    float edge;          // the edge of a square
    // From (b, c) on the grid towards the light, b changes by slope_b - b * converging, and c by
    // slope_c - c * converging, for each voxel along the axis towards larger coordinates.
    float slope_b, slope_c, converging;
    float scale;  // dilated occupancy coordinates per world coordinate
} BeamGrid;
VXL_SIZE_IS(BeamGrid, 48);

#ifdef __cplusplus
}  // namespace voxelume
#endif

#endif
