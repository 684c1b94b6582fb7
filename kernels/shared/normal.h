// SPDX-License-Identifier: Apache-2.0
// The packed normals of triangles' corners and of cubes, for kernels and host alike.
#ifndef VXL_SHARED_NORMAL_H
#define VXL_SHARED_NORMAL_H

// A normal of unit length in 32 bits (octahedral map; Meyer, Suessmuth, Sussner and Stamminger
// 2010, "On Floating-Point Normal Vectors"):
//   31 ........ 16 | 15 ......... 0
//   v, int16       | u, int16        both in 1/32767
// With z = 1 - |u| - |v|, the normal is along (u, v, z) where z >= 0, and along
// ((1 - |v|) sign u, (1 - |u|) sign v, z) where z < 0. The angle to what was packed is at most
// 0.004 degrees.
//
// Normals belong to planes in the voxels of their grid: they are gradients, scaled to unit length,
// which a map transforms by its inverse transpose.
#define VXL_NORMAL_UNITS 32767
#define VXL_NO_NORMAL \
    0x80008000u                 // no code of a normal: the triangle's corners, or the cube, have
                                // none
#define VXL_TRIANGLE_NORMALS 3  // words per triangle

#endif
