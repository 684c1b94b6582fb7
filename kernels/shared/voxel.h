// SPDX-License-Identifier: Apache-2.0
// The packed data of a surface voxel, for kernels and host alike.
#ifndef VXL_SHARED_VOXEL_H
#define VXL_SHARED_VOXEL_H

#ifdef __cplusplus
#include <kernels/shared/field_place.h>
#else
#include "shared/field_place.h"
#endif

// The packed attributes of a voxel:
//   31 30 | 29 ........ 16 | 15 ......... 0
//   kind  | material       | object
// kind: 0 cubes, 1 smooth, 2 exact (the numbers of voxelume::Surface), 3 exact in a cube. An exact
// voxel lists primitives, which have attributes of their own, and fields, below. A voxel of kind 3
// is exact and also a cube, whose object, material and colour are the voxel's own: rays that meet
// nothing that it lists meet the cube.
// `material` and `object` index the scene's lists. In an object's own grid, before placement,
// `material` is the mesh's face group.
#define VXL_KIND_SHIFT 30
#define VXL_MATERIAL_SHIFT 16
#define VXL_MATERIAL_MASK 0x3FFFu
#define VXL_OBJECT_MASK 0xFFFFu
#define VXL_KIND_CUBES 0u
#define VXL_KIND_SMOOTH 1u
#define VXL_KIND_EXACT 2u
#define VXL_KIND_EXACT_IN_CUBE 3u

// The colour word of a voxel is 0xTTBBGGRR: sRGB and the voxel's transparency, 0 opaque .. 255
// clear. Both multiply the material's values.
#define VXL_TRANSPARENCY_SHIFT 24

// Field record of a smooth voxel, 8 words (32 bytes, aligned). The distance inside the voxel at
// s = (x,y,z) in [0,1]³ is half-Taylor interpolation (Kraaijpoel & van Leeuwen 2010), which with
// gradients from central differences becomes
//   F(s) = Σ w_i f_i + ½ x(1-x) Σ w_yz D_x + ½ y(1-y) Σ w_xz D_y + ½ z(1-z) Σ w_xy D_z
// where D_a of an edge along axis a from node 0 to node 1 is (f(1) - f(-1) - f(2) + f(0)) / 2.
//   words 0..3: two f each, low half x=0, high half x=1, int16 in 1/8192 voxel; word = y | z<<1
//   words 4..7: edge e of each axis, ten bits each:
//     bits 0-9 D_x of the edge at y=e&1, z=e>>1;  10-19 D_y at x=e&1, z=e>>1;  20-29 D_z at x=e&1,
//     y=e>>1
//   The ten bits are a sign and 64 e + m: |D| = 2^e (64 + m) - 64, in 1/8192 voxel, up to 16192.
//   D of flat surfaces is kept to the unit of f, whatever edges the world has besides. An edge's
//   bits depend on its own four nodes only, so the voxels around it agree.
//   bits 30-31 of word 4: 0, or how the field is joined to those of the records before, below;
//   of words 5 and 6: how many brackets open and close in front of it
//
// Where surfaces of several smooth objects pass through one voxel, or one passes through an exact
// voxel, each keeps a record of its own. These records are numbered after all voxels, with one
// number for attributes, colours and fields alike. The voxel's kind is exact, and its own record's
// first two words are the number of the first of these records and their count.
//
// Where surfaces of several parts of one solid pass through a voxel, each keeps a record, too. The
// records of one object follow each other and form a chain: its field is that of the first record,
// joined to the next by the smaller (VXL_LINK_UNION) or the larger (VXL_LINK_INTERSECTION) of the
// two, joined to the one after that, and so on. A pair of brackets encloses a chain of its own,
// which the link of its first record joins to what stands before; if several brackets open at once,
// this is the outermost.
#define VXL_FIELD_WORDS 8
#define VXL_LINK_WORD 4
#define VXL_OPENS_WORD 5
#define VXL_CLOSES_WORD 6
#define VXL_LINK_SHIFT 30
#define VXL_DISTANCE_UNITS 8192

// Values in a brick table for bricks that are not stored.
#define VXL_BRICK_OUTSIDE 0xFFFFFFFFu
#define VXL_BRICK_INSIDE 0xFFFFFFFEu

#endif
