// SPDX-License-Identifier: Apache-2.0
// The tests of a packet's rays against the surfaces inside voxels.
#ifndef VXL_SURFACES_H
#define VXL_SURFACES_H

#include "lib/surface/coincident.h"
#include "lib/surface/cube_body.h"
#include "lib/surface/field_chain.h"
#include "lib/surface/mixed_mesh.h"
#include "lib/surface/solid_in_world.h"
#include "lib/surface/surface_hit.h"
#include "lib/surface/triangle.h"
#include "lib/traverse/hit_attributes.h"
#include "lib/traverse/voxel_kinds.h"
#include "shared/instance.h"
#include "shared/voxel.h"

/// Ends the walks of the `lanes` whose rays met a cube behind its voxel's surfaces, at that cube.
/// Returns the mask of these lanes.
static inline lane_int take_cube_behind(SurfaceHit* found, Walk* w, lane_int lanes) {
    const lane_int taken = lanes & found->behind.kept;
    if (!lanes_any(taken)) return taken;
    put_back(&found->behind, w, taken);
    found->voxel = LANES_SELECT(taken, found->behind.voxel, found->voxel);
    found->exit &= ~taken;
    take_voxel_hit(found, found->behind.t, taken);
    found->hit |= taken;
    return taken;
}

/// Ends walks that leave the body of cubes that their rays are inside of. The hit voxel is the
/// body's last.
static inline void leave_body(SurfaceHit* found, const Walk* w, lane_int leaving) {
    found->exit |= leaving & LANE_MASK(w->t < found->t);
    take_voxel_hit(found, w->t, leaving);
}

/// Tests the primitives that the `tested` lanes' voxels list. A primitive may be hit outside the
/// voxel that lists it; the hit counts once the walk has come that far. Walks that were brought to
/// their hits by find_solid test nothing.
///
/// Where a ray enters the world, a surface exactly on the world's side may be met just before the
/// ray's rounded origin. There, hits on triangles behind the origin count as well, as long as they
/// lie in the world, and hits on solids as hit_solids_in_world says. A ray that continues meets
/// surfaces at the same t as its last one in the order of their numbers.
static inline lane_int hit_exact(const PyramidView* p, const SurfaceView* s, const Walk* w,
                                 lane_uint voxel, lane_int tested, const RayState* ray_state,
                                 SurfaceHit* found) {
    if (VXL_SOLIDS_AHEAD) return tested & LANE_MASK(found->t <= exit_time(w));
    const lane_int entering = LANE_MASK(w->t == 0.0f) & LANE_MASK(w->axis != 3);
    const lane_float t_min = LANES_SELECT(entering, (lane_float)-INFINITY, ray_state->t_first);
    const RayShear shear = ray_shear(w);
    const RayBeginning from = beginning_of(p, s, w, ray_state);
    voxel &= LANES_AS_UINT(tested);
    lane_uint next = LANES_GATHER_UINT(s->primitive_first, voxel);
    const lane_uint end = LANES_GATHER_UINT(s->primitive_first, voxel + 1u);
    lane_int listing = tested & LANE_MASK(next < end);
    while (lanes_any(listing)) {
        const lane_uint primitive =
            LANES_GATHER_UINT(s->primitives, next & LANES_AS_UINT(listing)) &
            LANES_AS_UINT(listing);
        const lane_int of_source = LANE_MASK(primitive == ray_state->source);
        const lane_int is_solid = LANE_MASK((primitive & VXL_SOLID_PRIMITIVE) != 0u);
        const lane_int counts_at_first = counts_again(ray_state, primitive);
        lane_int closer = (lane_int)0;
        lane_float at = found->t + from.slack;
        if (VXL_TRIANGLES) {
            const lane_int triangle = listing & ~(is_solid | of_source);
            if (!VXL_SOLIDS || lanes_any(triangle)) {
                const lane_uint number = primitive & LANES_AS_UINT(triangle);
                lane_int within = (lane_int)0, outside = (lane_int)0;
                if (VXL_TRANSMISSION || VXL_MIXED) {
                    const lane_uint packed = LANES_GATHER_UINT(s->triangle_attributes, number);
                    if (VXL_TRANSMISSION) within = medium_set_holds(&ray_state->media, packed);
                    if (VXL_MIXED) outside = is_of_object(ray_state->field_of, packed);
                }
                closer |= hit_triangle_ahead(p, s, w, number, &shear, ray_state, &from, t_min,
                                             counts_at_first, within, outside, triangle, &at);
            }
        }
        if (VXL_SOLIDS) {  // one test of a solid covers the whole ray
            const lane_int solid = listing & is_solid & LANE_MASK(primitive != found->solid);
            found->solid = LANES_SELECT(solid, primitive, found->solid);
            if (lanes_any(solid))
                closer |= hit_solids_in_world(
                    p, s, w, primitive & ~VXL_SOLID_PRIMITIVE & LANES_AS_UINT(solid), ray_state,
                    &from, solid, of_source, counts_at_first, entering, &at);
        }
        take_primitive(s, ray_state, primitive, at, from.slack, closer, found);
        next += 1u;
        listing &= LANE_MASK(next < end);
    }
    return tested & LANE_MASK(found->t <= exit_time(w));
}

/// Tests the field of each lane in `tested`, which consists of records `number` to `end` - 1. Hits
/// closer than found->t replace it.
static inline lane_int hit_field(const PyramidView* p, const SurfaceView* s, const Walk* w,
                                 lane_uint number, lane_uint end, lane_int tested,
                                 lane_int beginning, const RayState* ray_state, SurfaceHit* found) {
    FieldApproach from = {(lane_int)0, ray_state->unsure & tested, beginning, (lane_int)0};
    const int any_unsure = lanes_any(from.unsure);
    if (VXL_FIELD_LISTS) {
        lane_int here = LANE_MASK(ray_state->source == (number | VXL_FIELD_SOURCE));
        if (VXL_FIELD_CHAINS)
            here = LANE_MASK(ray_state->source >= (number | VXL_FIELD_SOURCE)) &
                   LANE_MASK(ray_state->source < (end | VXL_FIELD_SOURCE));
        from.beginning &= here;
        from.here = beginning & ~from.beginning;
    }
    lane_uint packed = (lane_uint)s->constant_attribute;
    if (VXL_ATTRIBUTES && (any_unsure || VXL_TRANSMISSION || VXL_MIXED))
        packed = LANES_GATHER_UINT(s->attributes, number);
    if (VXL_MIXED) {  // the field of the ray's own mesh may lie above its origin
        const lane_int own = is_of_object(ray_state->triangle_of, packed);
        from.here |= own;
        from.unsure &= ~own;
    }
    if (VXL_TRANSMISSION) from.within = medium_set_holds(&ray_state->media, packed);
    if (any_unsure)
        from.within |= from.unsure & (is_medium(found->inside, packed) |
                                      (from.beginning & ray_state->within_source));
    lane_float t = (lane_float)INFINITY, level = found->level;
    lane_int met = (lane_int)0, alone = tested;
    const lane_int unsure = from.unsure;
    const lane_int foreign =
        VXL_MIXED ? hide_level(ray_state, packed, p->plane_bound, &level) : (lane_int)0;
    const Field field = read_field(s->fields, number);
    if (VXL_FIELD_CHAINS) {
        const lane_int chained = tested & LANE_MASK(end - number > 1u);
        const FieldChain chain = {s->fields, number, end};
        if (lanes_any(chained))
            met = hit_chain(&chain, w, p->plane_bound, chained, &from, &level, &t, &number);
        alone &= ~chained;
        from.unsure &= alone;
    }
    if (!VXL_FIELD_CHAINS || lanes_any(alone))
        met |= hit_smooth(&field, w, p->plane_bound, alone, &from, &level, &t);
    found->level = LANES_SELECT(foreign, found->level, level);
    from.unsure = unsure;
    if (any_unsure) found->inside = LANES_SELECT(from.unsure & from.within, packed, found->inside);
    // A ray that continues straight has its hits beyond this voxel where any other ray has them.
    if (VXL_TRANSMISSION)
        found->level = LANES_SELECT(ray_state->goes_on, (lane_float)0.0f, found->level);
    const lane_int closer = met & LANE_MASK(t < found->t);
    found->within = LANES_SELECT(closer, from.within, found->within);
    if (VXL_FIELD_LISTS) found->voxel = LANES_SELECT(closer, number, found->voxel);
    take_voxel_hit(found, t, met);
    return met;
}

/// Tests the fields of the `tested` lanes' voxels: one field or, in the lanes of `lists`, those
/// that the voxel's record lists.
static inline lane_int hit_fields(const PyramidView* p, const SurfaceView* s, const Walk* w,
                                  lane_uint voxel, lane_int tested, lane_int lists,
                                  lane_int beginning, const RayState* ray_state,
                                  SurfaceHit* found) {
    if (!VXL_FIELD_LISTS || !lanes_any(lists & tested)) {
        const lane_uint only = voxel & LANES_AS_UINT(tested);
        return hit_field(p, s, w, only, only + 1u, tested, beginning, ray_state, found);
    }
    lists &= tested;
    const lane_uint record = (voxel & LANES_AS_UINT(lists)) * VXL_FIELD_WORDS;
    lane_uint number = LANES_SELECT(lists, LANES_GATHER_UINT(s->fields, record), voxel);
    const lane_uint end =
        number + LANES_SELECT(lists, LANES_GATHER_UINT(s->fields, record + 1u), (lane_uint)1u);
    lane_int met = (lane_int)0;
    tested &= LANE_MASK(number < end);
    while (lanes_any(tested)) {
        number &= LANES_AS_UINT(tested);
        const lane_uint next =
            VXL_FIELD_CHAINS ? chain_from(s->fields, number, end, lists & tested).end : number + 1u;
        met |= hit_field(p, s, w, number, next, tested, beginning, ray_state, found);
        number = next;
        tested &= LANE_MASK(number < end);
    }
    return met;
}

/// Tests the surface inside each `tested` lane's voxel. Returns the mask of lanes whose ray ends
/// there.
static INLINED lane_int test_surfaces(const PyramidView* p, const SurfaceView* s, Walk* w,
                                      lane_int tested, const RayState* ray_state,
                                      SurfaceHit* found) {
    const lane_int all = tested;
    const lane_uint voxel = voxel_number(p, found->leaf & LANES_AS_UINT(tested), w->x & tested,
                                         w->y & tested, w->z & tested) &
                            LANES_AS_UINT(tested);
    lane_int passed = (lane_int)0, left = (lane_int)0;
    if (VXL_CUBE_BODIES) {
        lane_int own = tested & LANE_MASK(ray_state->body != VXL_NO_MEDIUM);
        if (VXL_ATTRIBUTES)
            own &= is_of_body(ray_state->body,
                              attributes_of_cubes(LANES_GATHER_UINT(s->attributes, voxel)),
                              ray_state->joined);
        left = tested & found->in_body & ~own;
        leave_body(found, w, left);
        tested &= ~left;
        found->in_body |= own;
        passed = own & ray_state->joined;
    }
    found->voxel = LANES_SELECT(tested, voxel, found->voxel);
    const VoxelKinds kinds = kinds_of(s->attributes, voxel, tested);
    const lane_int smooth = kinds.smooth, exact = kinds.exact;
    const lane_int beginning = ray_state->on_surface & LANE_MASK(w->axis == 3);
    const lane_int on_cube =
        VXL_INSTANCES ? ray_state->on_cube & LANE_MASK(w->axis == 3) : beginning;
    const lane_int cubes = kinds.cubes & ~(on_cube | passed);
    lane_int accepted = cubes | left;
    if (VXL_CUBES) take_voxel_hit(found, w->t, cubes);
    if (VXL_SMOOTH && lanes_any(smooth))
        accepted |= hit_fields(p, s, w, voxel, smooth, kinds.lists, beginning, ray_state, found);
    if (VXL_EXACT && lanes_any(exact))
        accepted |= hit_exact(p, s, w, voxel, exact, ray_state, found);
    if (VXL_SHARED_CUBES) {
        const lane_int listed = LANE_MASK(ray_state->source != VXL_NO_PRIMITIVE);
        const lane_int through = on_cube & listed & (ray_state->goes_on | ray_state->refracted);
        pass_cubes(&found->behind, all, kinds.behind, on_cube & listed & ~through);
        const lane_int met = kinds.behind & ~((on_cube & ~through) | passed | accepted);
        keep_cube(&found->behind, w, voxel, met, through);
        accepted |= take_cube_behind(found, w, all & ~kinds.behind);
    }
    return accepted;
}

#endif
