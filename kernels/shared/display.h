// SPDX-License-Identifier: Apache-2.0
// The display as the kernels see it: where its voxels lie in the world.
#ifndef VXL_SHARED_DISPLAY_H
#define VXL_SHARED_DISPLAY_H

#ifdef __cplusplus
#include <kernels/shared/scene.h>
namespace voxelume {
#else
#include "shared/scene.h"
#endif

// A display of layout `rays`: the map from depth to steps.
typedef struct DisplaySteps {
    float step;          // metres
    float inverse_step;  // 1 / step
    int count;           // steps of a ray
    float absorption;    // of the least absorbed channel, per metre; decides space's opacity
} DisplaySteps;
VXL_SIZE_IS(DisplaySteps, 16);

// The record of a ray's way through one layer of surfaces, up to the surface that it meets or to
// its end. Words:
#define VXL_LAYER_RAY 0        // uint: number of the sight ray
#define VXL_LAYER_OBJECT 1     // uint: number of the object met plus 1, 0 for none
#define VXL_LAYER_STEP 2       // uint: of the surface
#define VXL_LAYER_IN_MEDIUM 3  // uint: 1 where the way lies in the medium of S, not in an object
#define VXL_LAYER_OPACITY 4    // float: of the surface
#define VXL_LAYER_DEPTH 5      // float: of the surface, metres
#define VXL_LAYER_BEGIN 6      // float: of the way's start, depth in metres beyond the near surface
#define VXL_LAYER_END 7
#define VXL_LAYER_RATIO 8  // float: metres of the way per metre of depth
#define VXL_LAYER_LIGHT 9  // 3 floats: what the layer adds to the light at E
#define VXL_LAYER_THROUGHPUT \
    12  // 3 floats: the part of the light at the way's start that comes to E
#define VXL_LAYER_WORDS 15

// How a line along a lattice's axis crosses a surface: the lowest two bits of its coordinate.
#define VXL_CROSSES_OUT 0u
#define VXL_CROSSES_IN 1u
#define VXL_CROSSES_CUBE 2u
#define VXL_CROSSES_SENSES 3u

// What lines along one axis sum up in a voxel; see cover_lines.
#define VXL_COVER_SUMS (1 + VXL_CROSSES_SENSES)
#define VXL_COVER_UNITS 262144.0f
#define VXL_LOG_UNITS 4096.0f
#define VXL_OPAQUE_LOG 0xFFFFFFFFu

// Parallel lines along `axis` (0, 1, 2) of a lattice, in the order of sight.cl: those of column c
// and row r lie at (last_a - c + offset_a) / parts_a along the next axis and (last_b - r +
// offset_b) / parts_b along the one after it.
typedef struct LineGrid {
    int axis;
    uint columns;
    int last_a, last_b;
    float parts_a, parts_b;
    float offset_a, offset_b;
} LineGrid;
VXL_SIZE_IS(LineGrid, 32);

// The samples of display voxels that rays are aimed at: `count` from number `sample` on, of
// `samples` on planes of 4^log2 places that face `axis` most. Without `samples` rays are aimed at
// the probe points. The rays of sixteen voxels come sample by sample.
typedef struct SampleAim {
    int axis;
    uint sample, samples;
    uint count;
    uint number;  // of the first sample among all samples of the voxels
    int log2;
} SampleAim;
VXL_SIZE_IS(SampleAim, 24);

// A display of layout `lattice`. A coordinate (x,y,z) in lattice voxels is origin + x axis_x + y
// axis_y + z axis_z in voxels of the world.
typedef struct DisplayLattice {
    float4 origin;
    float4 axis_x;
    float4 axis_y;
    float4 axis_z;
    float4 row_x;  // lattice coordinate x of a point p in voxels of the world is row_x.xyz . p +
    float4 row_y;  // row_x.w; row_y and row_z give y and z in the same way
    float4 row_z;
    float4 corner;               // xyz: of voxel (0,0,0), metres in the observer's coordinates
    float4 edge;                 // xyz: of a voxel, metres
    int size_x, size_y, size_z;  // voxels
    int shape;                   // VXL_SHAPE_*
    float slope_x, slope_y;      // pyramid: tangents of the half angles; sector: cosine of the half
                                 // angle in slope_x
    float near_depth, far_depth;  // metres, see Display
    int cylinder;                 // 1: clipped by the upright cylinder in the lattice
    float unused[3];
} DisplayLattice;
VXL_SIZE_IS(DisplayLattice, 192);

#ifdef __cplusplus
}  // namespace voxelume
#endif

#endif
