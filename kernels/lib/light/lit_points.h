// SPDX-License-Identifier: Apache-2.0
// Surface points that a light may reach, and the light as they see it.
#ifndef VXL_LIT_POINTS_H
#define VXL_LIT_POINTS_H

#include "lib/lanes/vector.h"
#include "lib/surface/surface_color.h"
#include "lib/traverse/hit_attributes.h"
#include "lib/traverse/segment.h"
#include "shared/paths.h"
#include "shared/scene.h"
#include "shared/trace.h"

/// A light, or in each lane another one of the same kind.
typedef struct {
    int kind;
    Vector direction;  // of a spot or an area light sample
    lane_float inner_cosine, outer_cosine, spread;
    lane_float intensity[3];
} Light;

static inline Light light_of(LightRecord r) {
    const Light light = {
        r.kind,
        vector_of(r.direction),
        (lane_float)r.inner_cosine,
        (lane_float)r.outer_cosine,
        (lane_float)r.spread,
        {(lane_float)r.intensity.x, (lane_float)r.intensity.y, (lane_float)r.intensity.z}};
    return light;
}

/// A light as a packet of surface points sees it.
typedef struct {
    lane_int lit;       // mask: the light may contribute to the point
    Vector to_light;    // in voxels: to the light; for a directional light, its direction
    Vector l;           // the unit vector to the light, in metric space
    lane_float cosine;  // between l and the shading normal
    lane_float falloff;
} Incidence;

/// Surface points that light may reach. Their shadow rays begin at `start`.
typedef struct {
    lane_int lit;      // mask
    lane_int leaving;  // mask: met from inside; only in scenes with rough glass
    lane_uint material;
    Colors colors;
    Vector position, normal, shading_normal, start;
} LitPoints;

/// Loads the points of hits. Returns false if none can be lit.
static inline bool load_lit_points(const WorldView* world, const RayBatch* batch, uint first,
                                   LitPoints* p) {
    const uint stride = batch->stride;
    const lane_uint number = LANES_LOAD(batch->hits, VXL_HIT_VOXEL * stride + first);
    p->lit = LANE_MASK(number != VXL_NO_VOXEL);
    if (VXL_TRANSMISSION)
        p->lit &= LANE_MASK((LANES_LOAD(batch->sides, first) & VXL_SIDE_HIDDEN) == 0u);
    if (VXL_SCATTERING) p->lit &= ~scatters_before(batch, first);
    if (VXL_DIRECT_ALONE) {
        const lane_uint state = LANES_LOAD(batch->paths, VXL_PATH_STATE * stride + first);
        p->lit &= LANE_MASK(((state >> VXL_STATE_BOUNCE_SHIFT) & VXL_STATE_BOUNCES) == 0u);
    }
    if (!lanes_any(p->lit)) return false;
    p->leaving = (lane_int)0;
    if (VXL_ROUGH_GLASS)
        p->leaving = LANE_MASK((LANES_LOAD(batch->sides, first) & VXL_SIDE_LEAVING) != 0u);
    p->colors =
        colors_of_hits(world->surface.colors, number & LANES_AS_UINT(p->lit), batch->paint, first);
    p->material = material_offset(LANES_LOAD(batch->hit_attributes, first)) & LANES_AS_UINT(p->lit);
    p->position = load_vector(batch->positions, stride, first);
    p->normal = load_vector(batch->normals, stride, first);
    p->shading_normal = p->normal;
    if (VXL_SHADING_NORMALS) p->shading_normal = load_vector(batch->shading, stride, first);
    p->start = p->position;
    return true;
}

#endif
