// rays -> hits: the discrete walk of every ray through the world to the first surface it meets.
//
// One work-item carries VXL_LANES rays. Lanes that reach an occupied voxel wait until no lane of the
// packet is walking; then the surfaces inside those voxels are tested together, and lanes that missed
// them walk on.
#include "lib/smooth.h"
#include "lib/solid_surface.h"
#include "lib/triangle.h"
#include "lib/work_item.h"
#include "shared/scene.h"
#include "shared/voxel.h"

typedef struct {
    global const uint* restrict attributes;
    global const uint* restrict fields;
    global const uint* restrict primitive_first;
    global const uint* restrict primitives;
    global const float* restrict triangles;
    global const SolidShape* restrict solids;
    float half_curvature;
} SurfaceView;

/// What a packet has found so far.
typedef struct {
    lane_int hit;  // mask
    lane_float t;
    lane_uint leaf, voxel, primitive;
    lane_uint solid;   // the last one tested
    lane_float level;  // shift of smooth surfaces for rays that began on one, see hit_smooth
} Found;

/// Takes a hit at `t` on a cube or field in the `accepted` lanes, unless a primitive is hit before.
static inline void take_voxel_hit(Found* found, lane_float t, lane_int accepted) {
    const lane_int closer = accepted & LANE_MASK(t < found->t);
    found->t = LANES_SELECT(closer, t, found->t);
    found->primitive = LANES_SELECT(closer, (lane_uint)VXL_NO_PRIMITIVE, found->primitive);
}

/// Tests the primitives that the `tested` lanes' voxels list; `source` is the one a ray began on. A
/// primitive may be hit outside of the voxel that lists it: the hit counts once the walk is that far.
static inline lane_int hit_exact(const SurfaceView* s, const Walk* w, lane_int tested,
                                 lane_uint source, Found* found) {
    const RayShear shear = ray_shear(w);
    const SolidRay ray = {w->ox, w->oy, w->oz, w->dx, w->dy, w->dz};
    const lane_uint voxel = found->voxel & LANES_AS_UINT(tested);
    lane_uint next = LANES_GATHER_UINT(s->primitive_first, voxel);
    const lane_uint end = LANES_GATHER_UINT(s->primitive_first, voxel + 1u);
    lane_int listing = tested & LANE_MASK(next < end);
    while (lanes_any(listing)) {
        const lane_uint primitive =
            LANES_GATHER_UINT(s->primitives, next & LANES_AS_UINT(listing)) & LANES_AS_UINT(listing);
        const lane_int of_source = LANE_MASK(primitive == source);
        const lane_int is_solid = LANE_MASK((primitive & VXL_SOLID_PRIMITIVE) != 0u);
        lane_int closer = (lane_int)0;
        if (VXL_TRIANGLES) {
            const lane_int triangle = listing & ~(is_solid | of_source);
            if (!VXL_SOLIDS || lanes_any(triangle))
                closer |= hit_triangle(s->triangles, primitive & LANES_AS_UINT(triangle), w, &shear,
                                       triangle, &found->t);
        }
        if (VXL_SOLIDS) {  // a solid is met by the whole ray at once: once is enough
            const lane_int solid = listing & is_solid & LANE_MASK(primitive != found->solid);
            found->solid = LANES_SELECT(solid, primitive, found->solid);
            if (lanes_any(solid))
                closer |= hit_solids(s->solids, primitive & ~VXL_SOLID_PRIMITIVE, &ray, of_source,
                                     solid, &found->t);
        }
        found->primitive = LANES_SELECT(closer, primitive, found->primitive);
        next += 1u;
        listing &= LANE_MASK(next < end);
    }
    return tested & LANE_MASK(found->t <= exit_time(w));
}

/// Tests the surface inside each `tested` lane's voxel; the mask of lanes whose ray ends there.
static inline lane_int test_surfaces(const PyramidView* p, const SurfaceView* s, const Walk* w,
                                     lane_int tested, lane_int from_surface, lane_uint source,
                                     Found* found) {
    const lane_uint voxel =
        voxel_number(p, found->leaf & LANES_AS_UINT(tested), w->x & tested, w->y & tested,
                     w->z & tested) & LANES_AS_UINT(tested);
    found->voxel = LANES_SELECT(tested, voxel, found->voxel);
    lane_int cubes = VXL_CUBES ? tested : (lane_int)0;
    lane_int smooth = VXL_SMOOTH ? tested : (lane_int)0;
    lane_int exact = VXL_EXACT ? tested : (lane_int)0;
    if (VXL_CUBES + VXL_SMOOTH + VXL_EXACT > 1) {
        const lane_uint kind = LANES_GATHER_UINT(s->attributes, voxel) >> VXL_KIND_SHIFT;
        cubes &= LANE_MASK(kind == VXL_KIND_CUBES);
        smooth &= LANE_MASK(kind == VXL_KIND_SMOOTH);
        exact &= LANE_MASK(kind == VXL_KIND_EXACT);
    }
    const lane_int beginning = from_surface & LANE_MASK(w->axis == 3);
    cubes &= ~beginning;
    lane_int accepted = cubes;
    if (VXL_CUBES) take_voxel_hit(found, w->t, cubes);
    if (VXL_SMOOTH && lanes_any(smooth)) {
        const Field field = read_field(s->fields, voxel, s->half_curvature);
        lane_float t = (lane_float)INFINITY;
        const lane_int met = hit_smooth(&field, w, smooth, beginning, &found->level, &t);
        take_voxel_hit(found, t, met);
        accepted |= met;
    }
    if (VXL_EXACT && lanes_any(exact)) accepted |= hit_exact(s, w, exact, source, found);
    return accepted;
}

/// Walks the `active` lanes to their first surface before t_end.
static inline Found find_first(const PyramidView* p, const SurfaceView* s, Walk* w,
                               lane_float t_end, lane_int active, lane_int from_surface,
                               lane_uint source) {
    Found found;
    found.hit = (lane_int)0;
    found.t = (lane_float)INFINITY;
    found.leaf = found.voxel = (lane_uint)0;
    found.primitive = found.solid = (lane_uint)VXL_NO_PRIMITIVE;
    found.level = (lane_float)0.0f;
    lane_int walking = active & in_grid(p, w);
    while (lanes_any(walking)) {
        lane_int waiting = (lane_int)0;
        while (lanes_any(walking)) {
            const CellState state = look_up(p, w->x, w->y, w->z, walking);
            const lane_int arrived = state.occupied & walking;
            found.leaf = LANES_SELECT(arrived, state.leaf, found.leaf);
            waiting |= arrived;
            walking &= ~arrived;
            advance(p, w, state.log2_size, walking);
            walking &= in_grid(p, w) & LANE_MASK(w->t <= t_end);
            if (VXL_EXACT) {  // an earlier voxel's primitive is hit before anything ahead
                const lane_int passed = walking & LANE_MASK(w->t >= found.t);
                found.hit |= passed;
                walking &= ~passed;
            }
        }
        const lane_int accepted =
            test_surfaces(p, s, w, waiting, from_surface, source, &found) & waiting;
        found.hit |= accepted;
        walking = waiting & ~accepted;
        if (!lanes_any(walking)) break;
        advance(p, w, (lane_int)0, walking);
        walking &= in_grid(p, w) & LANE_MASK(w->t <= t_end);
    }
    if (VXL_EXACT) found.hit |= active & LANE_MASK(found.t < INFINITY);
    found.hit &= LANE_MASK(found.t <= t_end);
    return found;
}

static inline PyramidView pyramid_view(PyramidShape shape, global const uint* restrict sectors,
                                       global const uint* restrict bricks,
                                       global const uint* restrict leaves,
                                       global const uint* restrict leaf_voxels) {
    PyramidView p = {sectors,         bricks,          leaves,
                     leaf_voxels,     shape.size_x,    shape.size_y,
                     shape.size_z,    shape.sectors_x, shape.sectors_y,
                     shape.plane_bound, shape.fixed_point};
    return p;
}

static inline Walk load_walk(global const float* restrict rays, uint stride, uint first) {
    return begin_walk(LANES_LOAD(rays, VXL_RAY_OX * stride + first),
                      LANES_LOAD(rays, VXL_RAY_OY * stride + first),
                      LANES_LOAD(rays, VXL_RAY_OZ * stride + first),
                      LANES_LOAD(rays, VXL_RAY_DX * stride + first),
                      LANES_LOAD(rays, VXL_RAY_DY * stride + first),
                      LANES_LOAD(rays, VXL_RAY_DZ * stride + first));
}

#define VXL_WORLD_ARGUMENTS                                                                       \
    PyramidShape shape, global const uint *restrict sectors, global const uint *restrict bricks,  \
        global const uint *restrict leaves, global const uint *restrict leaf_voxels,              \
        global const uint *restrict attributes, global const uint *restrict fields,               \
        global const uint *restrict primitive_first, global const uint *restrict primitives,      \
        global const float *restrict triangles, global const SolidShape *restrict solids

#define VXL_WORLD_VIEWS                                                                           \
    const PyramidView pyramid = pyramid_view(shape, sectors, bricks, leaves, leaf_voxels);        \
    const SurfaceView surface = {attributes, fields, primitive_first, primitives, triangles,      \
                                 solids, shape.half_curvature}

/// The closest hit of rays 0 .. count-1. Arrays hold a multiple of 16 rays.
kernel void trace_closest(VXL_WORLD_ARGUMENTS, global const float* restrict rays, uint count,
                          uint stride, global uint* restrict hits) {
    const uint first = work_item() * VXL_LANES;
    if (first >= count) return;
    VXL_WORLD_VIEWS;
    Walk walk = load_walk(rays, stride, first);
    const lane_float t_end = LANES_LOAD(rays, VXL_RAY_END * stride + first);
    const Found found = find_first(&pyramid, &surface, &walk, t_end, LANE_MASK(t_end >= 0.0f),
                                   (lane_int)0, (lane_uint)VXL_NO_PRIMITIVE);
    const lane_uint voxel = LANES_SELECT(found.hit, found.voxel, (lane_uint)VXL_NO_VOXEL);
    LANES_STORE(LANES_AS_UINT(found.t), hits, VXL_HIT_T * stride + first);
    LANES_STORE(voxel, hits, VXL_HIT_VOXEL * stride + first);
    LANES_STORE(LANES_AS_UINT(walk.x | (walk.y << 16)), hits, VXL_HIT_CELL * stride + first);
    LANES_STORE(LANES_AS_UINT(walk.z | (walk.axis << 16)), hits, VXL_HIT_FACE * stride + first);
    if (VXL_EXACT) LANES_STORE(found.primitive, hits, VXL_HIT_PRIMITIVE * stride + first);
}

/// Traces a queue of shadow rays that begin on surfaces; what reaches its light adds its share of
/// light, `shares` (three components `stride` apart), to the radiance of the ray it was sent for.
///
/// Every target stands in the queue at most once, so no two work-items add to the same place.
kernel void trace_shadows(VXL_WORLD_ARGUMENTS, global const float* restrict rays,
                          global const uint* restrict count, uint stride,
                          global const uint* restrict targets, global const uint* restrict sources,
                          global const float* restrict shares, global float* restrict radiance) {
    const uint first = work_item() * VXL_LANES;
    const uint queued = *count;
    if (first >= queued) return;
    VXL_WORLD_VIEWS;
    Walk walk = load_walk(rays, stride, first);
    const lane_float t_end = LANES_LOAD(rays, VXL_RAY_END * stride + first);
    const lane_int active = LANE_MASK(LANES_AS_INT(LANES_NUMBERS + (int)first) < (int)queued);
    const lane_uint source =
        VXL_EXACT ? LANES_LOAD(sources, first) : (lane_uint)VXL_NO_PRIMITIVE;
    const Found found =
        find_first(&pyramid, &surface, &walk, t_end, active, (lane_int)-1, source);
    uint target[VXL_LANES];
    float share[3 * VXL_LANES];
    int lit[VXL_LANES];
    LANES_STORE(LANES_LOAD(targets, first), target, 0);
    LANES_STORE(active & ~found.hit, lit, 0);
    for (int channel = 0; channel < 3; ++channel)
        LANES_STORE(LANES_LOAD(shares, channel * stride + first), share, channel * VXL_LANES);
    for (int lane = 0; lane < VXL_LANES; ++lane)
        for (int channel = 0; channel < 3; ++channel)
            if (lit[lane])
                radiance[channel * stride + target[lane]] += share[channel * VXL_LANES + lane];
}
