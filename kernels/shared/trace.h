// Rays and hits as the stages hand them on: arrays of one component each, `stride` values apart.
#ifndef VXL_SHARED_TRACE_H
#define VXL_SHARED_TRACE_H

// A ray p(t) = o + d t in a grid's voxels. Every o is a multiple of 2^-fraction_bits in [0, size], every
// d of 2^-22 with the largest |d| in [1/2, 1]: both are exact floats and exact integers (fixed point).
// t_end < 0 marks an idle place.
#define VXL_RAY_OX 0
#define VXL_RAY_OY 1
#define VXL_RAY_OZ 2
#define VXL_RAY_DX 3
#define VXL_RAY_DY 4
#define VXL_RAY_DZ 5
#define VXL_RAY_END 6
#define VXL_RAY_COMPONENTS 7

#define VXL_DIRECTION_BITS 22

// What a ray met.
//   VXL_HIT_T      float: where, as the ray's t
//   VXL_HIT_VOXEL  the voxel's number in the pyramid, VXL_NO_VOXEL for a miss
//   VXL_HIT_CELL   x | y << 16
//   VXL_HIT_FACE   z | axis << 16: the axis (0, 1, 2) across which the ray entered the cell; 3: it began there
//   VXL_HIT_PRIMITIVE  the triangle or solid that was hit, VXL_NO_PRIMITIVE for other surfaces
#define VXL_HIT_T 0
#define VXL_HIT_VOXEL 1
#define VXL_HIT_CELL 2
#define VXL_HIT_FACE 3
#define VXL_HIT_PRIMITIVE 4
#define VXL_HIT_COMPONENTS 5
// A primitive is a triangle's number, or this bit and a solid's.
#define VXL_SOLID_PRIMITIVE 0x80000000u
#define VXL_NO_PRIMITIVE 0xFFFFFFFFu
#define VXL_NO_VOXEL 0xFFFFFFFFu

#endif
