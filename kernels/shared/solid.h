// SPDX-License-Identifier: Apache-2.0
// An analytic solid for rays and voxelizers: a list of shapes and the operations between them.
//
// A solid is a run of `shape_count` records. Evaluating it goes through them in order with a stack:
// each shape pushes its signed distance, positive outside and negated for a complement, and then
// `operations` combines the two on top, two bits at a time from the low end until they are 0:
//   1 union         the smaller of the two
//   2 intersection  the larger of the two
// A difference is an intersection with complements. The operations leave one value.
//
//   (box without cylinder) united with sphere:
//   record   kind                     operations
//   0        box                      0
//   1        cylinder | complement    10         intersection
//   2        sphere                   01         union
//
// A solid's number is the index of its first record in the buffer, so two buffers are joined by
// appending one and adding its offset to the numbers.
//
// Shape space. A point x of the grid (in voxels) is transformed to the shape's own space by
//   p = shape_from_grid * ((x - cell) - fraction)
// where x - cell is exact for x on the lattice. The origin is the shape's centre, and Y is its
// axis. Distances there are distances to the shape, in units of the grid's shortest voxel edge;
// where the map has stretched the shape out of its kind, they are scaled so that they never exceed
// the true distance.
#ifndef VXL_SHARED_SOLID_H
#define VXL_SHARED_SOLID_H

#define VXL_SOLID_SPHERE 0u
#define VXL_SOLID_ELLIPSOID 1u
#define VXL_SOLID_BOX 2u
#define VXL_SOLID_CYLINDER 3u
#define VXL_SOLID_CONE 4u
#define VXL_SOLID_TORUS 5u
#define VXL_SOLID_CAPSULE 6u
#define VXL_SOLID_SLAB 7u
#define VXL_SOLID_KIND_MASK 0xFFu
#define VXL_SOLID_COMPLEMENT 0x100u  // set in `kind`: everything outside the shape

#define VXL_SOLID_UNION 1u
#define VXL_SOLID_INTERSECTION 2u
#define VXL_SOLID_OPERATION_BITS 2
#define VXL_SOLID_OPERATION_MASK 3u
#define VXL_SOLID_STACK 16  // the maximum number of values that evaluation holds
#define VXL_SOLID_WORDS 32  // 32-bit words of a record

// One shape. `size` holds, in shape space:
//   sphere     radius
//   ellipsoid  half axes x, y, z, the shortest of them
//   box        half edges x, y, z
//   cylinder   radius, half height
//   cone       radius at y = -half height, half height, radius at y = +half height
//   torus      radius of the ring, radius of the tube
//   capsule    radius, half height of the part between the caps
//   slab       half thickness
typedef struct SolidShape {
    unsigned int kind;         // VXL_SOLID_*, and VXL_SOLID_COMPLEMENT
    unsigned int operations;   // applied after this shape is pushed
    unsigned int shape_count;  // records of the solid, in its first record; 0 in the others
    unsigned int attribute;    // its packed attributes (shared/voxel.h), in its first record
    int cell[3];               // the centre's voxel, at most 2^24 from the grid's origin
    float fraction[3];         // the centre in that voxel, 0..1
    float shape_from_grid[9];  // by rows
    float size[4];
    float rounding[2];  // |error of the distance at q| <= rounding[0] * (|q.x|+|q.y|+|q.z|) +
                        // rounding[1], with q = x - centre in voxels
    float derived[5];   // cone: the unit normal of its side (outwards, along Y), then its side's
                        // direction from the lower rim divided by its squared length (both as
                        // outwards, along Y), then the growth of its radius along Y;
                        // ellipsoid: half axes divided by the shortest, and 1 / the shortest
    float reach;   // in its first record, voxels: all of the solid's surface in the grid is nearer
                   // to this record's centre, with room for rounding; infinity for what lies
                   // outside of a solid
    float unused;  // 0
} SolidShape;

// Compilation fails, in both languages, if the record's size differs from what the text above says.
typedef char SolidShapeHas32Words[sizeof(SolidShape) == VXL_SOLID_WORDS * 4 ? 1 : -1];

#endif
