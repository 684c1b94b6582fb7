// SPDX-License-Identifier: Apache-2.0
// The objects without a formula inside which rays begin: smooth ones and meshes.
#ifndef VXL_BEGIN_INSIDE_H
#define VXL_BEGIN_INSIDE_H

#include "lib/lanes/vector.h"
#include "lib/packets/instances.h"
#include "lib/packets/packet.h"
#include "lib/surface/surface_color.h"
#include "lib/traverse/instance_hit.h"
#include "lib/traverse/surroundings.h"

/// Mask: rays that have met their surfaces from behind, judged by the kind of each surface.
static inline lane_int meets_from_behind(const WorldView* world, const Walk* w,
                                         const SurfaceHit* found, lane_int smooth, lane_int hit) {
    const SurfaceView* s = &world->surface;
    lane_int behind = smooth & found->within;
    if (!VXL_EXACT) return behind;
    HitRay in;
    in.origin.x = w->ox, in.origin.y = w->oy, in.origin.z = w->oz;
    in.direction.x = w->dx, in.direction.y = w->dy, in.direction.z = w->dz;
    in.t = LANES_SELECT(hit, found->t, (lane_float)0.0f);
    if (VXL_INSTANCES)
        in = transform_hits(world->instances.records, found->instance,
                            hit & LANE_MASK(found->instance != VXL_NO_INSTANCE), in);
    const Vector o = in.origin, d = in.direction;
    const lane_int exact = hit & LANE_MASK(found->primitive != VXL_NO_PRIMITIVE);
    const lane_int solid = exact & LANE_MASK((found->primitive & VXL_SOLID_PRIMITIVE) != 0u);
    if (VXL_TRIANGLES) {
        const lane_int triangle = exact & ~solid;
        const Vector n = triangle_normal(s->triangles, found->primitive & LANES_AS_UINT(triangle),
                                         (float4)(1.0f));
        behind |= triangle & LANE_MASK(dot_product(n, d) > 0.0f);
    }
    if (VXL_SOLIDS && lanes_any(solid)) {
        const SolidRay ray = {o.x, o.y, o.z, d.x, d.y, d.z};
        const SolidPoint n =
            solid_normals(s->solids, found->primitive & ~VXL_SOLID_PRIMITIVE & LANES_AS_UINT(solid),
                          &ray, in.t, solid);
        behind |= solid & LANE_MASK(fma(n.x, ray.dx, fma(n.y, ray.dy, n.z * ray.dz)) > 0.0f);
    }
    return behind;
}

/// The packed attributes of those objects of `hollow` inside which the `active` rays of a packet
/// begin. A ray begins inside an object if the first surface of that object on its way is met from
/// behind, whatever else the ray meets. Surfaces of `hollow` objects that don't transmit light are
/// ignored.
static inline MediumSet find_beginnings(const WorldView* world, const Surroundings* around, Walk* w,
                                        lane_int active, RayState* ray_state,
                                        global const uint* restrict hollow, uint maximum) {
    const SurfaceView* s = &world->surface;
    global const float* materials = around->materials;
    MediumSet began = empty_medium_set(), met = empty_medium_set();
    ray_state->media = empty_medium_set();
    lane_int searching = active, count = (lane_int)0;
    for (int layer = 0; layer < VXL_MAX_LAYERS && lanes_any(searching); ++layer) {
        const SurfaceHit found =
            find_nearest(world, w, (lane_float)INFINITY, searching, false, ray_state);
        searching &= found.hit;
        if (!lanes_any(searching)) break;
        const lane_uint voxel = found.voxel & LANES_AS_UINT(searching);
        const lane_int of_instance =
            VXL_INSTANCES ? searching & LANE_MASK(found.instance != VXL_NO_INSTANCE) : (lane_int)0;
        lane_uint packed = attributes_of_hit(s, voxel, found.primitive, searching);
        if (VXL_INSTANCES)
            packed = instance_attributes(&world->instances, found.instance, packed, of_instance);
        packed &= LANES_AS_UINT(searching);
        const lane_int smooth = is_smooth(packed, found.primitive) & searching;
        const lane_int leaving = meets_from_behind(world, w, &found, smooth, searching);
        const lane_int first = searching & ~medium_set_holds(&met, packed) &
                               LANE_MASK(LANES_GATHER_UINT(hollow, packed & VXL_OBJECT_MASK) != 0u);
        const lane_uint material = material_offset(packed);
        const lane_int inside =
            first & leaving &
            transmits(materials, material,
                      LANES_GATHER_FLOAT(materials, material + VXL_MATERIAL_OPACITY));
        lane_int full;
        began = cross_medium_or_overflow(began, packed, (lane_int)0, inside, &full);
        if (VXL_MEDIUM_SET_CAPPED && lanes_any(full))
            atomic_add(around->medium_overflows, (uint)lanes_count(full));
        met = cross_medium(met, packed, (lane_int)0, first);
        count -= first;
        searching &= LANE_MASK(count < (int)maximum);

        // A field's own sign tells on which side the ray is, because sets have room only for
        // transmitting objects.
        ray_state->unsure = ray_state->guesses = (lane_int)-1;
        ray_state->goes_on = ray_state->on_surface = (lane_int)-1;
        ray_state->source = source_of_hit(found.primitive, found.voxel, packed);
        ray_state->within_source = ~leaving;
        ray_state->t_first = LANES_SELECT(searching, found.t, ray_state->t_first);
        w->t = LANES_SELECT(searching, fmax(found.t, w->t), w->t);
        w->axis = LANES_SELECT(searching, (lane_int)3, w->axis);
        if (!VXL_INSTANCES) continue;
        const lane_int restarted = searching & of_instance;
        ray_state->instance = LANES_SELECT(searching, found.instance, ray_state->instance);
        restart_walks(&world->pyramid, w, found.t, restarted);
        ray_state->goes_on &= ~restarted;
        ray_state->t_first = LANES_SELECT(restarted, (lane_float)0.0f, ray_state->t_first);
    }
    return began;
}

#endif
