// SPDX-License-Identifier: Apache-2.0
// Rays that begin on meshes that are smooth in one part and exact in another.
//
// The field and the triangles of such a mesh overlap, and one lies up to a tenth of a voxel above
// the other. A ray that begins on the lower one, and leaves the body, would end at the back of the
// upper one. The mesh is closed and opaque and is lit and seen from outside, so such a ray passes
// the backs of the other kind of surface of its own object. All other rays meet backs, so rays that
// enter at an edge of the overlap don't leave on the far side of the body.
//
// No other object has both fields and triangles, so what a ray begins on identifies these rays.
#ifndef VXL_MIXED_MESH_H
#define VXL_MIXED_MESH_H

#include "lib/surface/smooth.h"
#include "lib/surface/surface_hit.h"
#include "lib/traverse/world.h"
#include "shared/voxel.h"

/// Finds the objects on whose field or triangles the `sent` rays begin, by their source and
/// instance.
static inline void find_mixed_mesh(const WorldView* world, lane_int sent, RayState* ray_state) {
    const lane_uint source = ray_state->source;
    const lane_int on_field = sent & LANE_MASK((source >> 30) == 1u);
    const lane_int on_triangle = sent & LANE_MASK((source >> 30) == 0u);
    const lane_uint number = source & ~VXL_FIELD_SOURCE;
    const lane_int of_world = LANE_MASK(ray_state->instance == VXL_NO_INSTANCE) | ~sent;
    const lane_int listed = VXL_INSTANCES ? of_world : (lane_int)-1;
    lane_uint object = (lane_uint)world->surface.constant_attribute;
    if (VXL_ATTRIBUTES)
        object =
            LANES_GATHER_UINT(world->surface.attributes, number & LANES_AS_UINT(on_field & listed));
    if (VXL_TRIANGLES)
        object = LANES_SELECT(on_triangle,
                              LANES_GATHER_UINT(world->surface.triangle_attributes,
                                                number & LANES_AS_UINT(on_triangle & listed)),
                              object);
    object &= VXL_OBJECT_MASK;
    if (VXL_INSTANCES && lanes_any(~of_world)) {
        const lane_uint record =
            (ray_state->instance & LANES_AS_UINT(~of_world)) * VXL_INSTANCE_WORDS +
            VXL_INSTANCE_OBJECT;
        const lane_uint shown =
            LANES_GATHER_UINT((global const uint*)world->instances.records, record);
        object = LANES_SELECT(of_world, object, shown);
    }
    ray_state->field_of = LANES_SELECT(on_field, object, (lane_uint)VXL_NO_OBJECT);
    ray_state->triangle_of = LANES_SELECT(on_triangle, object, (lane_uint)VXL_NO_OBJECT);
}

/// Converts the objects to those that surfaces have in the space of instance `number`, which shows
/// `object`: there, all surfaces belong to object 0. In the world they stay as they are.
static inline void enter_mixed_mesh(RayState* ray_state, lane_uint number, uint object) {
    const lane_int of_instance = LANE_MASK(number != VXL_NO_INSTANCE);
    const lane_uint none = (lane_uint)VXL_NO_OBJECT, own = (lane_uint)0;
    const lane_uint field = LANES_SELECT(LANE_MASK(ray_state->field_of == object), own, none);
    const lane_uint triangle = LANES_SELECT(LANE_MASK(ray_state->triangle_of == object), own, none);
    ray_state->field_of = LANES_SELECT(of_instance, field, ray_state->field_of);
    ray_state->triangle_of = LANES_SELECT(of_instance, triangle, ray_state->triangle_of);
}

/// Mask: surfaces of these packed attributes are of `object`.
static inline lane_int is_of_object(lane_uint object, lane_uint packed) {
    return LANE_MASK((packed & VXL_OBJECT_MASK) == object);
}

/// For the fields of objects other than a ray's own mixed mesh, limits the level of rays that began
/// below the field of that mesh to what rounding alone requires. `packed` are the fields'
/// attributes. Returns the mask of the limited lanes, so that the caller can restore their level.
static inline lane_int hide_level(const RayState* ray_state, lane_uint packed, float plane_bound,
                                  lane_float* level) {
    const float bound = rounding_of_origins(plane_bound);
    const lane_int foreign = LANE_MASK(*level > bound) &
                             ~is_of_object(ray_state->field_of, packed) &
                             ~is_of_object(ray_state->triangle_of, packed);
    *level = LANES_SELECT(foreign, (lane_float)bound, *level);
    return foreign;
}

#endif
