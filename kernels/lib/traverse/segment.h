// SPDX-License-Identifier: Apache-2.0
// The part of a ray on which the medium counts, and its length.
#ifndef VXL_SEGMENT_H
#define VXL_SEGMENT_H

#include "lib/lanes/fixed_point.h"
#include "lib/lanes/vector.h"
#include "lib/traverse/density.h"
#include "lib/traverse/ray_batch.h"
#include "shared/paths.h"

/// The part of a ray between t_first and t_last.
typedef struct {
    Vector origin, direction;
    lane_float t_first, t_last;
} Segment;

/// The segment's part inside the world. If there is none, the result ends before it begins.
static inline Segment part_in_world(PyramidShape shape, Segment whole) {
    Segment s = whole;
    clip_to_world(s.origin, s.direction, shape.size_x, shape.size_y, shape.size_z, &s.t_first,
                  &s.t_last);
    return s;
}

/// The length in t of the segment's part inside the world.
static inline lane_float length_in_world(PyramidShape shape, const Segment* s) {
    const Segment inside = part_in_world(shape, *s);
    return fmax(inside.t_last - inside.t_first, 0.0f);
}

static inline Walk walk_along(const Segment* s) {
    return begin_walk(s->origin.x, s->origin.y, s->origin.z, s->direction.x, s->direction.y,
                      s->direction.z);
}

/// Mask: paths that the medium scatters before they come to the surfaces that their rays met.
static inline lane_int scatters_before(const RayBatch* batch, uint first) {
    const lane_uint state = LANES_LOAD(batch->paths, VXL_PATH_STATE * batch->stride + first);
    return LANE_MASK((state & VXL_STATE_IN_MEDIUM) != 0u);
}

/// The parts of rays up to what they met. A ray that met nothing continues to the far surface, or
/// to the world's end.
static inline Segment whole_segment(const RayBatch* batch, uint first) {
    global const uint* hits = batch->hits;
    const uint stride = batch->stride;
    const lane_int hit =
        LANE_MASK(LANES_LOAD(hits, VXL_HIT_VOXEL * stride + first) != VXL_NO_VOXEL);
    const lane_float t_hit = LANES_AS_FLOAT(LANES_LOAD(hits, VXL_HIT_T * stride + first));
    const lane_float t_end = LANES_LOAD(batch->rays, VXL_RAY_END * stride + first);
    Segment segment = {load_vector(batch->rays, stride, first),
                       load_vector(batch->rays + VXL_RAY_DX * stride, stride, first),
                       (lane_float)0.0f, LANES_SELECT(hit, t_hit, t_end)};
    if (VXL_TRANSMISSION) segment.t_first = LANES_LOAD(batch->starts, first);
    return segment;
}

/// The parts of whole_segment, except that they end at `transmittance` where the medium scatters a
/// path.
static inline Segment sight_segment(const RayBatch* batch, uint first) {
    Segment segment = whole_segment(batch, first);
    if (VXL_SCATTERING)
        segment.t_last = LANES_SELECT(scatters_before(batch, first),
                                      LANES_LOAD(batch->transmittance, first), segment.t_last);
    return segment;
}

#endif
