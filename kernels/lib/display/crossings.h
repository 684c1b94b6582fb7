// SPDX-License-Identifier: Apache-2.0
// All crossings of probe lines with the surfaces in one voxel, not only the first ones.
#ifndef VXL_CROSSINGS_H
#define VXL_CROSSINGS_H

#include "lib/display/line_order.h"
#include "lib/solid/solid_surface.h"
#include "lib/surface/field_chain.h"
#include "lib/surface/triangle.h"
#include "lib/traverse/hit_attributes.h"
#include "lib/traverse/transformed_ray.h"
#include "lib/traverse/voxel_kinds.h"
#include "shared/display.h"
#include "shared/voxel.h"

// How far inside its face between two voxels of the display a probe point is put, in such voxels:
// farther than rounding moves it.
#define VXL_INWARD 0.0009765625f

// The maximum number of crossings of one solid in one voxel.
#define VXL_SOLID_CROSSINGS 4

/// The slots of a packet's crossings: slot i of line n is at i * stride + n.
typedef struct {
    float4 row;  // of the lattice coordinate along the lines
    uint first, stride, slots;
    global float* restrict crossings;
    global uint* restrict surfaces;  // of each crossing, where light goes through some surfaces
    uint covers;                     // 1: crossings are looked for as covers count them; see
                                     // scan_lines
    lane_uint count;                 // crossings found, including those without a slot
    Vector origin, way;              // the lines in the world's voxels
    TransformedRay into;  // the lines in the voxels that are scanned, in scenes with instances
    uint instance;        // whose voxels are scanned; VXL_NO_INSTANCE for the world's
    lane_uint surface;    // what is crossed: packed attributes, with VXL_LINE_CUBE for a kind
} ScanResult;

/// The packed attributes of the surface of a voxel, a field or a primitive, as in ScanResult.
static inline lane_uint surface_of(const SurfaceView* s, const InstanceView* instances,
                                   uint instance, lane_uint number, lane_uint primitive,
                                   lane_int tested) {
    const lane_uint in = LANES_AS_UINT(tested);
    lane_uint packed = attributes_of_hit(s, number & in, primitive, tested);
    if (VXL_INSTANCES && instance != VXL_NO_INSTANCE)
        packed = instance_attributes(instances, (lane_uint)instance, packed, tested);
    return packed & ((1u << VXL_KIND_SHIFT) - 1u);
}

/// Keeps the `crossed` lanes' crossings at t. A crossing on a face between two voxels of the
/// display is moved into the voxel that its object is in: the next one where `inward` is 1, the one
/// before where it is -1; it stays where `inward` is 0, which means unknown. `inward` is 2 where
/// lines for covers enter a cube.
static inline void keep_crossings(ScanResult* r, lane_int crossed, lane_float t,
                                  lane_float inward) {
    if (!lanes_any(crossed)) return;
    if (VXL_INSTANCES) t = world_t(&r->into, t);
    const lane_float x = fma(r->way.x, t, r->origin.x), y = fma(r->way.y, t, r->origin.y),
                     z = fma(r->way.z, t, r->origin.z);
    lane_float s = fma(x, r->row.x, fma(y, r->row.y, fma(z, r->row.z, r->row.w)));
    const lane_float side = rint(s);
    const lane_int on_side = LANE_MASK(fabs(s - side) < VXL_INWARD) & LANE_MASK(inward != 0.0f);
    s = LANES_SELECT(on_side, fma(inward, (lane_float)VXL_INWARD, side), s);
    if (r->covers || VXL_TRANSMISSION) {
        const lane_uint sense =
            LANES_SELECT(LANE_MASK(inward > 1.0f), (lane_uint)VXL_CROSSES_CUBE,
                         LANES_SELECT(LANE_MASK(inward > 0.0f), (lane_uint)VXL_CROSSES_IN,
                                      (lane_uint)VXL_CROSSES_OUT));
        s = LANES_AS_FLOAT((LANES_AS_UINT(s) & ~VXL_CROSSES_SENSES) | sense);
    }
    float value[VXL_LANES];
    int kept[VXL_LANES];
    uint slot[VXL_LANES];
    LANES_STORE(s, value, 0);
    LANES_STORE(crossed, kept, 0);
    LANES_STORE(r->count, slot, 0);
    for (uint i = 0; i < VXL_LANES; ++i)
        if (kept[i] && slot[i] < r->slots)
            r->crossings[slot[i] * r->stride + r->first + i] = value[i];
    if (VXL_TRANSMISSION) {
        uint surface[VXL_LANES];
        LANES_STORE(r->surface, surface, 0);
        for (uint i = 0; i < VXL_LANES; ++i)
            if (kept[i] && slot[i] < r->slots)
                r->surfaces[slot[i] * r->stride + r->first + i] = surface[i];
    }
    r->count += LANES_AS_UINT(crossed) & 1u;
}

/// Keeps the crossing with a smooth voxel between u = a and b, where F changes its sign.
static inline void cross_field(const Field* f, const Walk* w, const LocalRay* ray, lane_int crossed,
                               lane_float a, lane_float b, lane_float fa, lane_float fb,
                               ScanResult* r) {
    const lane_float outside = (lane_float)1.0f;
    for (int step = 0; step < VXL_SECANT_STEPS; ++step) {  // regula falsi, as in hit_smooth
        const lane_float gap = LANES_SELECT(crossed, fa - fb, (lane_float)1.0f);
        const lane_float u = clamp(fma(exact_divide(fa, gap), b - a, a), a, b);
        const lane_float fu = field_along(f, ray, outside, u);
        const lane_int at_b = LANE_MASK(fu < 0.0f) ^ LANE_MASK(fa < 0.0f);
        fb = LANES_SELECT(at_b, fu, 0.5f * fb);
        b = LANES_SELECT(at_b, u, b);
        fa = LANES_SELECT(at_b, 0.5f * fa, fu);
        a = LANES_SELECT(at_b, a, u);
    }
    const lane_float gap = LANES_SELECT(crossed, fa - fb, (lane_float)1.0f);
    const lane_float enters = LANES_SELECT(LANE_MASK(fb < 0.0f), outside, -outside);
    keep_crossings(r, crossed, w->t + clamp(fma(exact_divide(fa, gap), b - a, a), a, b), enters);
}

static inline void scan_field(const SurfaceView* s, const Walk* w, lane_uint number,
                              lane_int tested, ScanResult* r) {
    const Field field = read_field(s->fields, number);
    const LocalRay ray = local_ray(w);
    const lane_float zero = (lane_float)0.0f, outside = (lane_float)1.0f;
    const lane_float end = fmax(exit_time(w) - w->t, 0.0f), middle = 0.5f * end;
    const lane_float at_entry = field_along(&field, &ray, outside, zero);
    const lane_float at_middle = field_along(&field, &ray, outside, middle);
    const lane_float at_exit = field_along(&field, &ray, outside, end);
    const lane_int inside = LANE_MASK(at_middle < 0.0f);
    const lane_int before = tested & (LANE_MASK(at_entry < 0.0f) ^ inside);
    const lane_int after = tested & (LANE_MASK(at_exit < 0.0f) ^ inside);
    const lane_int once = before | after;
    if (lanes_any(once))
        cross_field(&field, w, &ray, once, LANES_SELECT(before, zero, middle),
                    LANES_SELECT(before, middle, end), LANES_SELECT(before, at_entry, at_middle),
                    LANES_SELECT(before, at_middle, at_exit), r);
    const lane_int twice = before & after;
    if (lanes_any(twice)) cross_field(&field, w, &ray, twice, middle, end, at_middle, at_exit, r);
}

/// Keeps the crossings with a chain of fields.
static inline void scan_chain(const FieldChain* c, const Walk* w, lane_int tested, ScanResult* r) {
    const LocalRay ray = local_ray(w);
    const lane_float zero = (lane_float)0.0f;
    const lane_float end = fmax(exit_time(w) - w->t, 0.0f);
    ChainWay way = chain_way();
    lane_int inside = LANE_MASK(chain_behind(c, &ray, &way, zero, tested).value < 0.0f);
    for (int i = 0; i < VXL_CHAIN_ZEROS && lanes_any(tested); ++i) {
        tested &= next_zero(c, &ray, zero, end, tested, &way);
        if (!lanes_any(tested)) return;
        const lane_int behind = LANE_MASK(chain_behind(c, &ray, &way, zero, tested).value < 0.0f);
        const lane_int crossed = tested & (inside ^ behind);
        const lane_float enters = LANES_SELECT(behind, (lane_float)1.0f, (lane_float)-1.0f);
        if (lanes_any(crossed)) keep_crossings(r, crossed, w->t + way.u, enters);
        inside = behind;
    }
}

/// Keeps the crossings with the fields of the `tested` lanes' voxels: one field, or those that the
/// record lists.
static inline void scan_smooth(const WorldView* world, const Walk* w, lane_uint voxel,
                               lane_int tested, lane_int lists, ScanResult* r) {
    const SurfaceView* s = &world->surface;
    lane_uint number = voxel & LANES_AS_UINT(tested), end = number + 1u;
    if (VXL_FIELD_LISTS && lanes_any(lists)) {
        const lane_uint record = (voxel & LANES_AS_UINT(lists)) * VXL_FIELD_WORDS;
        number = LANES_SELECT(lists, LANES_GATHER_UINT(s->fields, record), number);
        end = LANES_SELECT(lists, number + LANES_GATHER_UINT(s->fields, record + 1u), end);
        tested &= LANE_MASK(number < end);
    }
    while (lanes_any(tested)) {
        if (VXL_TRANSMISSION)
            r->surface = surface_of(s, &world->instances, r->instance, number,
                                    (lane_uint)VXL_NO_PRIMITIVE, tested);
        number &= LANES_AS_UINT(tested);
        lane_int alone = tested;
        lane_uint next = number + 1u;
        if (VXL_FIELD_CHAINS) {
            const FieldChain chain = chain_from(s->fields, number, end, lists & tested);
            next = chain.end;
            const lane_int chained = tested & LANE_MASK(next - number > 1u);
            if (lanes_any(chained)) scan_chain(&chain, w, chained, r);
            alone &= ~chained;
        }
        if (!VXL_FIELD_CHAINS || lanes_any(alone)) scan_field(s, w, number, alone, r);
        if (!VXL_FIELD_LISTS) return;
        number = next;
        tested &= LANE_MASK(number < end);
    }
}

/// Keeps the crossings with solid `number` between t and t_exit.
static INLINED void scan_solid(const PyramidView* p, const SurfaceView* s, const Walk* w,
                               lane_uint number, lane_int tested, lane_float t, lane_float t_exit,
                               ScanResult* r) {
    const SolidRay ray = {w->ox, w->oy, w->oz, w->dx, w->dy, w->dz};
    for (int i = 0; i < VXL_SOLID_CROSSINGS && lanes_any(tested); ++i) {
        lane_float at = t_exit;
        tested &= hit_solids(s->solids, number, &ray, t, t, (lane_int)0, (lane_int)0, tested, &at);
        const lane_int crossed = tested & is_in_world(p, w, at);
        if (lanes_any(crossed)) {
            const SolidRay from = {fma(w->dx, at, w->ox),
                                   fma(w->dy, at, w->oy),
                                   fma(w->dz, at, w->oz),
                                   w->dx,
                                   w->dy,
                                   w->dz};
            const lane_int enters = go_inside(s->solids, number, &from, crossed);
            keep_crossings(r, crossed, at,
                           LANES_SELECT(enters, (lane_float)1.0f, (lane_float)-1.0f));
        }
        t = LANES_SELECT(tested, at, t);
    }
}

/// 1 where the line meets the triangle's front, -1 where it meets its back.
static inline lane_float triangle_inward(global const float* restrict triangles, lane_uint number,
                                         const Walk* w) {
    const float4 edge = (float4)(1.0f, 1.0f, 1.0f, 0.0f);
    const Vector n = triangle_normal(triangles, number, edge);
    const lane_float along = fma(n.x, w->dx, fma(n.y, w->dy, n.z * w->dz));
    return LANES_SELECT(LANE_MASK(along < 0.0f), (lane_float)1.0f, (lane_float)-1.0f);
}

/// Keeps the crossings with the primitives that the voxel lists. A crossing on a voxel's side may
/// be kept for both voxels.
static inline void scan_primitives(const WorldView* world, const PyramidView* p, const Walk* w,
                                   lane_uint voxel, lane_int tested, ScanResult* r) {
    const SurfaceView* s = &world->surface;
    const lane_float t_first = w->t - p->plane_bound, t_exit = exit_time(w) + p->plane_bound;
    const RayShear shear = ray_shear(w);
    lane_uint next = LANES_GATHER_UINT(s->primitive_first, voxel);
    const lane_uint end = LANES_GATHER_UINT(s->primitive_first, voxel + 1u);
    lane_int listing = tested & LANE_MASK(next < end);
    while (lanes_any(listing)) {
        const lane_uint primitive =
            LANES_GATHER_UINT(s->primitives, next & LANES_AS_UINT(listing)) &
            LANES_AS_UINT(listing);
        const lane_int is_solid = LANE_MASK((primitive & VXL_SOLID_PRIMITIVE) != 0u);
        if (VXL_TRANSMISSION)
            r->surface = surface_of(s, &world->instances, r->instance, voxel, primitive, listing);
        if (VXL_TRIANGLES) {
            const lane_int triangle = listing & ~is_solid;
            lane_float t = t_exit;
            lane_int front;
            const lane_int crossed = hit_triangle(p, t_first, (lane_int)-1, s->triangles,
                                                  primitive & LANES_AS_UINT(triangle), w, &shear,
                                                  (lane_int)0, (lane_int)0, triangle, &t, &front);
            lane_float inward = (lane_float)0.0f;
            if (r->covers || VXL_TRANSMISSION)
                inward = triangle_inward(s->triangles, primitive & LANES_AS_UINT(triangle), w);
            keep_crossings(r, crossed, t, inward);
        }
        if (VXL_SOLIDS)
            scan_solid(p, s, w, primitive & ~VXL_SOLID_PRIMITIVE, listing & is_solid, t_first,
                       t_exit, r);
        next += 1u;
        listing &= LANE_MASK(next < end);
    }
}

/// Crosses the surfaces in the `tested` lanes' voxels, except cubes. Returns the mask of lanes in
/// cubes. If other surfaces come before a cube, its lane is in the mask only where the line crosses
/// none of them in the voxel.
static INLINED lane_int scan_voxels(const WorldView* world, const PyramidView* p, const Walk* w,
                                    lane_uint leaf, lane_int tested, ScanResult* r) {
    const SurfaceView* s = &world->surface;
    const lane_uint voxel =
        voxel_number(p, leaf & LANES_AS_UINT(tested), w->x & tested, w->y & tested, w->z & tested) &
        LANES_AS_UINT(tested);
    const VoxelKinds kinds = kinds_of(s->attributes, voxel, tested);
    const lane_uint before = r->count;
    if (VXL_SMOOTH && lanes_any(kinds.smooth))
        scan_smooth(world, w, voxel, kinds.smooth, kinds.lists, r);
    if (VXL_EXACT && lanes_any(kinds.exact)) scan_primitives(world, p, w, voxel, kinds.exact, r);
    lane_int cubes = kinds.cubes;
    if (VXL_SHARED_CUBES) cubes |= kinds.behind & LANE_MASK(r->count == before);
    if (VXL_TRANSMISSION && VXL_CUBES)
        r->surface = VXL_LINE_CUBE | surface_of(s, &world->instances, r->instance, voxel,
                                                (lane_uint)VXL_NO_PRIMITIVE, cubes);
    return cubes;
}

#endif
