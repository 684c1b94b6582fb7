// SPDX-License-Identifier: Apache-2.0
// A sparse grid of bricks as kernels take it.
#ifndef VXL_BRICK_GRID_H
#define VXL_BRICK_GRID_H

/// The parameters that runtime/grid/grid_arguments.hpp binds to a BrickGrid, in its order.
#define VXL_BRICK_GRID_PARAMETERS                                                                  \
    int4 grid_size, int4 grid_bricks, global const uint *restrict grid_slots,                      \
        global const uint *restrict grid_coordinates, global const ulong *restrict grid_occupancy, \
        global const short *restrict grid_distance, global const uint *restrict grid_attributes,   \
        uint grid_attribute, global const uint *restrict grid_colors,                              \
        global const uint *restrict grid_normals,                                                  \
        global const uint *restrict grid_primitive_first,                                          \
        global const uint *restrict grid_primitives

/// The buffers are described in runtime/grid/grid.hpp; those that a grid doesn't need are null.
typedef struct {
    int4 size, bricks;  // voxels, and bricks of the table
    global const uint* restrict slots;
    global const uint* restrict coordinates;
    global const ulong* restrict occupancy;
    global const short* restrict distance;
    global const uint* restrict attributes;
    uint attribute;
    global const uint* restrict colors;
    global const uint* restrict normals;
    global const uint* restrict primitive_first;
    global const uint* restrict primitives;
} BrickGrid;

/// The value of a BrickGrid in a kernel with these parameters.
#define VXL_BRICK_GRID                                                                        \
    {                                                                                         \
        grid_size, grid_bricks, grid_slots, grid_coordinates, grid_occupancy, grid_distance,  \
            grid_attributes, grid_attribute, grid_colors, grid_normals, grid_primitive_first, \
            grid_primitives                                                                   \
    }

#endif
