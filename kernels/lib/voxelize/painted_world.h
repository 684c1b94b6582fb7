// SPDX-License-Identifier: Apache-2.0
// The bricks of the world that an object is painted into.
#ifndef VXL_PAINTED_WORLD_H
#define VXL_PAINTED_WORLD_H

#include "lib/traverse/world_bounds.h"

// The parameters that `bind` of a PaintedWorld sets, in its order.
#define VXL_PAINTED_PARAMETERS                                                          \
    int4 world_bricks, WorldBounds bounds, global const uint *restrict painted,         \
        global const uint *restrict coordinates, global short *restrict world_distance, \
        global ulong *restrict world_occupancy, global uint *restrict world_attributes, \
        global uint *restrict world_colors, global uint *restrict world_normals

// Buffers that the world doesn't need are null.
typedef struct {
    int4 bricks;  // the world's brick table
    WorldBounds bounds;
    global const uint* restrict painted;  // slots
    global const uint* restrict coordinates;
    global short* restrict distance;
    global ulong* restrict occupancy;
    global uint* restrict attributes;
    global uint* restrict colors;
    global uint* restrict normals;
} PaintedWorld;

// The value of a PaintedWorld in a kernel with these parameters.
#define VXL_PAINTED                                                                  \
    {                                                                                \
        world_bricks, bounds, painted, coordinates, world_distance, world_occupancy, \
            world_attributes, world_colors, world_normals                            \
    }

#endif
