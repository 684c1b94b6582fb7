// SPDX-License-Identifier: Apache-2.0
// What rays have met, loaded from where it was stored, ready to be shaded.
#ifndef VXL_SHADED_HIT_H
#define VXL_SHADED_HIT_H

#include "lib/traverse/hit_attributes.h"
#include "lib/traverse/instance_hit.h"
#include "lib/traverse/ray_batch.h"
#include "shared/trace.h"
#include "shared/voxel.h"

/// The surfaces that a packet of rays has met. Lanes that met nothing hold harmless numbers.
typedef struct {
    lane_int hit, of_instance;  // masks
    lane_int exact, smooth;     // masks: triangles and solids; fields
    lane_uint voxel, primitive, packed, face;
    Vector cell;                     // the minimum corner of the voxel
    Vector world_origin, world_way;  // the ray in the world's voxels
    lane_float world_t;
    HitRay ray;  // the ray in the voxels of the instance that was met, or in the world's
} ShadedHit;

static inline ShadedHit load_hits(const WorldView* world, const RayBatch* batch, uint first) {
    global const uint* hits = batch->hits;
    const uint stride = batch->stride;
    ShadedHit h;
    const lane_float t = LANES_AS_FLOAT(LANES_LOAD(hits, VXL_HIT_T * stride + first));
    const lane_uint number = LANES_LOAD(hits, VXL_HIT_VOXEL * stride + first);
    const lane_uint cell_xy = LANES_LOAD(hits, VXL_HIT_CELL * stride + first);
    h.face = LANES_LOAD(hits, VXL_HIT_FACE * stride + first);
    h.hit = LANE_MASK(number != VXL_NO_VOXEL);
    h.voxel = number & LANES_AS_UINT(h.hit);
    h.cell.x = LANES_FLOAT(cell_xy & 0xFFFFu), h.cell.y = LANES_FLOAT(cell_xy >> 16);
    h.cell.z = LANES_FLOAT(h.face & 0xFFFFu);
    h.world_origin = load_vector(batch->rays, stride, first);
    h.world_way = load_vector(batch->rays + VXL_RAY_DX * stride, stride, first);
    h.world_t = LANES_SELECT(h.hit, t, (lane_float)0.0f);
    h.ray.origin = h.world_origin, h.ray.direction = h.world_way, h.ray.t = h.world_t;
    h.primitive = (lane_uint)VXL_NO_PRIMITIVE;
    if (VXL_EXACT) h.primitive = LANES_LOAD(hits, VXL_HIT_PRIMITIVE * stride + first);
    h.packed = attributes_of_hit(&world->surface, h.voxel, h.primitive, h.hit);
    h.of_instance = (lane_int)0;
    if (VXL_INSTANCES) {
        const lane_uint instance = LANES_LOAD(hits, VXL_HIT_INSTANCE * stride + first);
        h.of_instance = h.hit & LANE_MASK(instance != VXL_NO_INSTANCE);
        h.ray = transform_hits(world->instances.records, instance, h.of_instance, h.ray);
        h.packed = instance_attributes(&world->instances, instance, h.packed, h.of_instance);
    }
    h.exact = LANE_MASK(h.primitive != VXL_NO_PRIMITIVE) & h.hit;
    h.smooth = LANE_MASK((h.packed >> VXL_KIND_SHIFT) != VXL_KIND_CUBES) & h.hit & ~h.exact;
    return h;
}

#endif
