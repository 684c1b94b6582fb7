// SPDX-License-Identifier: Apache-2.0
// The density of the medium for kernels: a number for every voxel of S, in bricks of 16³ cells.
//
// A cell holds 2^shift voxels of the world along each axis, so that a density that changes along
// one axis only has one cell along the others. The bricks, x fastest, then y, then z, have a word
// each:
//   0 | slot
//       its cells' values are values[slot * 4096 ...], x fastest, then y, then z
//   1 << 31 | log2_size << 26 | place
//       all its cells have values[place], and so has the aligned cube of 2^log2_size cells around
//       it, which is the brick at least
#ifndef VXL_SHARED_MEDIUM_H
#define VXL_SHARED_MEDIUM_H

#define VXL_DENSITY_CONSTANT 0x80000000u
#define VXL_DENSITY_SIZE_SHIFT 26
#define VXL_DENSITY_SLOT 0x03FFFFFFu

typedef struct DensityShape {
    int bricks_x, bricks_y;
    int shift_x, shift_y, shift_z;
    int unused[3];
} DensityShape;

// Compilation fails, in both languages, if the struct's size differs from what the text above says.
typedef char DensityShapeHas8Words[sizeof(DensityShape) == 32 ? 1 : -1];

#endif
