// SPDX-License-Identifier: Apache-2.0
// The pieces of emissive surface that kernels list for the host.
#ifndef VXL_SHARED_LIGHT_SAMPLES_H
#define VXL_SHARED_LIGHT_SAMPLES_H

// A piece is four words: x | y << 16 of its voxel, z | form << 16, number, packed attributes.
//   form 0..5: the open face of a cube towards -x, +x, -y, +y, -z, +z; number: the voxel's
//   VXL_PIECE_FIELD: the surface in a smooth voxel; number: the voxel's
//   VXL_PIECE_SOLID: an exact solid's surface there; number: the solid's
// Voxels with emissive surfaces are listed in the same words. Instead of the form they have a bit
// for each side, 0..5, through which surfaces are met, and VXL_EMITTER_OF_CUBES for those of cubes.
#define VXL_EMITTER_OF_CUBES 0x40u
#define VXL_EMITTER_SIDES_ALL 0x3Fu
#define VXL_PIECE_FIELD 6u
#define VXL_PIECE_SOLID 7u

#endif
