// SPDX-License-Identifier: Apache-2.0
// A mesh's triangles on the lattice, and the bins of bricks that list them.
#ifndef VXL_MESH_H
#define VXL_MESH_H

/// The parameters that `bind` of DeviceTriangles sets, in its order.
#define VXL_MESH_PARAMETERS                                                        \
    uint first_triangle, uint triangle_count, global const int *restrict vertices, \
        global const uint *restrict triangles

/// The triangles number first .. first + count - 1; see runtime/stages/voxelize/voxelize_bins.hpp.
typedef struct {
    uint first, count;
    global const int* restrict vertices;
    global const uint* restrict triangles;
} LatticeMesh;

/// The value of a LatticeMesh in a kernel with these parameters.
#define VXL_MESH \
    { first_triangle, triangle_count, vertices, triangles }

/// The parameters that `bind` of TriangleBins sets, in its order.
#define VXL_BINS_PARAMETERS                                                                      \
    int4 bin_table, uint bin_count, uint bins_stored, global const uint *restrict bins_occupied, \
        global const uint *restrict number_of_bin, global const uint *restrict coordinates,      \
        global const uint *restrict bin_first, global const uint *restrict bin_lists

/// The buffers are described in runtime/stages/voxelize/voxelize_bins.hpp.
typedef struct {
    int4 size;
    uint count, stored;
    global const uint* restrict occupied;
    global const uint* restrict number_of_bin;
    global const uint* restrict coordinates;
    global const uint* restrict first;
    global const uint* restrict lists;
} TriangleBins;

/// The value of TriangleBins in a kernel with these parameters.
#define VXL_BINS                                                                                 \
    {                                                                                            \
        bin_table, bin_count, bins_stored, bins_occupied, number_of_bin, coordinates, bin_first, \
            bin_lists                                                                            \
    }

#endif
