// SPDX-License-Identifier: Apache-2.0
// Rays and hits as stages exchange them: arrays of one component each, `stride` values apart.
#ifndef VXL_SHARED_TRACE_H
#define VXL_SHARED_TRACE_H

// A ray p(t) = o + d t in a grid's voxels. Every o is a multiple of 2^-fraction_bits in [0, size],
// and every d a multiple of 2^-22 with the largest |d| in [1/2, 1]: both are exact floats and exact
// integers (fixed point). t_end < 0 marks an idle slot.
#define VXL_RAY_OX 0
#define VXL_RAY_OY 1
#define VXL_RAY_OZ 2
#define VXL_RAY_DX 3
#define VXL_RAY_DY 4
#define VXL_RAY_DZ 5
#define VXL_RAY_END 6
#define VXL_RAY_COMPONENTS 7

#define VXL_DIRECTION_BITS 22

// Beam n says how far ahead the rays 16 n .. 16 n + 15 may start together, in two arrays of
// VXL_BEAM_SLOTS(stride) words.
//   VXL_BEAM_START  float: all that they meet lies at this coordinate or beyond it ...
//   VXL_BEAM_AXIS   ... along axis 0, 1 or 2 towards larger coordinates; with VXL_BEAM_DOWN towards
//                   smaller ones. VXL_BEAM_NONE: no beam, the rays start at their origins;
//                   VXL_BEAM_CLEAR: the rays meet nothing
#define VXL_BEAM_RAYS 16
#define VXL_BEAM_SLOTS(stride) ((stride) / 256 * 16 + 16)
#define VXL_BEAM_START 0
#define VXL_BEAM_AXIS 1
#define VXL_BEAM_COMPONENTS 2
#define VXL_BEAM_DOWN 4
#define VXL_BEAM_NONE 8
#define VXL_BEAM_CLEAR 16

// The number of packets of incoherent rays that a work-item traces, one after another.
#define VXL_PACKETS(lanes) ((lanes) > 1 ? 16u : 1u)
// 1 if lanes are refilled with further rays when theirs end, which is done in scenes with paths. A
// lane's instances come after its walk in the world, in which other lanes may still be. Where all
// solids are tested at once, there is hardly a walk to wait for.
#define VXL_REFILLS_LANES(paths, instances, solids_ahead) \
    ((paths) && !(instances) && !(solids_ahead))
// 1 if shadow rays' lanes are refilled. This is also done where surface tests take long, since rays
// that pass near a surface meet many voxels.
#define VXL_REFILLS_SHADOW_LANES(paths, smooth, exact, instances, solids_ahead) \
    (((paths) || (smooth) || (exact)) && !(instances) && !(solids_ahead))

// The number of packets whose steps are interleaved in one work-item. Where surfaces are cubes, a
// packet's time is that of its steps, each of which is a long chain of dependent operations.
#define VXL_INTERLEAVED_PACKETS(lanes, smooth, exact, instances) \
    ((lanes) > 1 && !((smooth) || (exact) || (instances)) ? 2u : 1u)

// The hit of a ray:
//   VXL_HIT_T      float: where, as the ray's t
//   VXL_HIT_VOXEL  the voxel's number in the pyramid, VXL_NO_VOXEL for a miss
//   VXL_HIT_CELL   x | y << 16
//   VXL_HIT_FACE   z | axis << 16: the axis (0, 1, 2) across which the ray entered the cell, or
//                  came into the world; 3: it began there. Where it left the object of the cell's
//                  voxel, VXL_FACE_EXIT is set, the axis is that across which it left the cell,
//                  and VXL_FACE_UP says that this was towards larger coordinates.
//                  VXL_FACE_WITHIN says that a smooth surface was met from inside.
//   VXL_HIT_PRIMITIVE  the triangle or solid hit, VXL_NO_PRIMITIVE for other surfaces
//   VXL_HIT_INSTANCE   the instance hit, in whose voxels the cell and the axis are;
//                      VXL_NO_INSTANCE for the world. Only scenes with instances have it.
#define VXL_HIT_T 0
#define VXL_HIT_VOXEL 1
#define VXL_HIT_CELL 2
#define VXL_HIT_FACE 3
#define VXL_HIT_PRIMITIVE 4
#define VXL_HIT_INSTANCE 5
#define VXL_HIT_COMPONENTS 6
#define VXL_FACE_AXIS_SHIFT 16
#define VXL_FACE_AXIS_MASK 3u
#define VXL_FACE_EXIT 0x40000u
#define VXL_FACE_UP 0x80000u
#define VXL_FACE_WITHIN 0x100000u
// A primitive is a triangle's number, or this bit and a solid's.
#define VXL_SOLID_PRIMITIVE 0x80000000u
#define VXL_NO_PRIMITIVE 0xFFFFFFFFu
#define VXL_NO_VOXEL 0xFFFFFFFFu
// This bit marks the number of a field on which a ray begins, where voxels may hold several fields.
#define VXL_FIELD_SOURCE 0x40000000u

// The origin of a ray, for scenes whose rays are reflected, refracted or continue through surfaces.
//   VXL_PATH_SOURCE  the primitive that the ray begins on, VXL_FIELD_SOURCE with a field's number,
//                    or VXL_NO_PRIMITIVE for other surfaces
//   VXL_PATH_FLAGS   VXL_PATH_* bits
//   VXL_PATH_WEIGHT  float: the share of a pixel that the ray's node may add
//                    (in global light VXL_PATH_STATE, see shared/paths.h)
// The next ones exist only in scenes with transmitting objects; the target and the throughput also
// exist in global light:
//   VXL_PATH_CELL    the cell in which the ray goes on: x | y << 16
//   VXL_PATH_CELL_Z  z; or with VXL_FACE_EXIT all of VXL_HIT_FACE: it goes on in the next cell
//   VXL_PATH_TARGET  the node that the ray's light goes to
//   VXL_PATH_CLEAR   float: what the surfaces passed leave uncovered
//   VXL_PATH_THROUGHPUT  3 floats: what is left of the light on its way to the node
//   VXL_PATH_INSIDE  VXL_MEDIUM_SET_SIZE packed attributes: the objects that the ray is inside of
// The last ones exist where paths look for emitters or the sky, see shared/paths.h; they lie behind
// all others:
//   VXL_PATH_EMITTER
//   VXL_PATH_TRAVELLED  in scenes with instances and transmitting objects only
// This one exists where physically based surfaces see lights with an area, in which case
// VXL_PATH_TRAVELLED exists, too; it lies behind those:
//   VXL_PATH_DENSITY
// This one exists where surfaces wear textures; it lies behind those:
//   VXL_PATH_WIDTH  float: how wide the ray is at its origin, in metres; 0 from an observer
// This one exists only in scenes with instances:
//   VXL_PATH_INSTANCE  the instance that the ray begins on, VXL_NO_INSTANCE for the world
#define VXL_PATH_SOURCE 0
#define VXL_PATH_FLAGS 1
#define VXL_PATH_WEIGHT 2
#define VXL_PATH_CELL 3
#define VXL_PATH_CELL_Z 4
#define VXL_PATH_TARGET 5
#define VXL_PATH_CLEAR 6
#define VXL_PATH_THROUGHPUT 7
#define VXL_PATH_INSTANCE 10
#define VXL_PATH_INSIDE 11

#define VXL_LOOKS ((VXL_EMITTERS | VXL_SKY_RAYS) != 0)

#define VXL_PATH_ON_SURFACE 1u     // begins on a surface
#define VXL_PATH_WITHIN_SOURCE 2u  // continues inside that surface
#define VXL_PATH_GOES_ON 4u        // continues an earlier ray, from t = `starts` on
#define VXL_PATH_FROM_CELL 8u      // begins in the named cell
#define VXL_PATH_JOINED 16u        // inside cubes whose inner faces are no surfaces
#define VXL_PATH_REFRACTED 32u     // refracted by the surface that it begins on

// The maximum number of surfaces that one ray continues through. It exceeds the number of cells on
// a ray's way through the largest world, 3 * 65536.
#define VXL_MAX_LAYERS 0x40000

// A free slot in the set of objects that a ray is inside of; Features::media is its size.
#define VXL_NO_MEDIUM 0xFFFFFFFFu

// How a ray meets a surface: bits of RayBatch::sides.
#define VXL_SIDE_LEAVING 1u  // from inside the object
#define VXL_SIDE_HIDDEN 2u   // another object is what counts before and behind it
// The bits of RayBatch::sides from here on hold a value like RayBatch::inside: the glass of other
// cubes behind the face of glass cubes, or 0 for none.
#define VXL_SIDE_BEYOND_SHIFT 2

#endif
