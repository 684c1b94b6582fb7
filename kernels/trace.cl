// rays -> hits: the discrete walk of every ray through the world to the first surface it meets.
//
// One work-item carries VXL_LANES rays. Lanes that reach an occupied voxel wait until no lane of the
// packet is walking; then the surfaces inside those voxels are tested together, and lanes that missed
// them walk on.
#include "lib/smooth.h"
#include "lib/triangle.h"
#include "lib/work_item.h"
#include "shared/voxel.h"

typedef struct {
    global const uint* restrict attributes;
    global const uint* restrict fields;
    global const uint* restrict primitive_first;
    global const uint* restrict primitives;
    global const float* restrict triangles;
    float half_curvature;
} SurfaceView;

/// What a packet has found so far.
typedef struct {
    lane_int hit;  // mask
    lane_float t;
    lane_uint leaf, voxel, primitive;
    lane_float level;  // shift of smooth surfaces for rays that began on one, see hit_smooth
} Found;

/// Tests the primitives of the `tested` lanes' voxels. A hit counts once the walk can't find a closer one:
/// within the voxel at once, else when the walk gets there.
static inline lane_int hit_exact(const SurfaceView* s, const Walk* w, lane_int tested,
                                 lane_uint source, Found* found) {
    const RayShear shear = ray_shear(w);
    lane_uint next = LANES_GATHER_UINT(s->primitive_first, found->voxel & LANES_AS_UINT(tested));
    const lane_uint end =
        LANES_GATHER_UINT(s->primitive_first, (found->voxel & LANES_AS_UINT(tested)) + 1u);
    lane_int listing = tested & LANE_MASK(next < end);
    while (lanes_any(listing)) {
        const lane_uint primitive =
            LANES_GATHER_UINT(s->primitives, next & LANES_AS_UINT(listing)) & LANES_AS_UINT(listing);
        const lane_int other = listing & LANE_MASK(primitive != source);
        const lane_int closer = hit_triangle(s->triangles, primitive, w, &shear, other, &found->t);
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
    if (VXL_CUBES) found->t = LANES_SELECT(cubes, w->t, found->t);
    if (VXL_SMOOTH && lanes_any(smooth)) {
        const Field field = read_field(s->fields, voxel, s->half_curvature);
        accepted |= hit_smooth(&field, w, smooth, beginning, &found->level, &found->t);
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
    found.leaf = found.voxel = found.primitive = (lane_uint)0;
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
        if (!VXL_SMOOTH && !VXL_EXACT && !VXL_FROM_SURFACE) break;
        walking = waiting & ~accepted;
        advance(p, w, (lane_int)0, walking);
        walking &= in_grid(p, w) & LANE_MASK(w->t <= t_end);
    }
    if (VXL_EXACT) found.hit |= active & LANE_MASK(found.t < INFINITY);
    found.hit &= LANE_MASK(found.t <= t_end);
    return found;
}

#define VXL_PYRAMID_ARGUMENTS                                                                     \
    global const uint *restrict sectors, global const uint *restrict bricks,                      \
        global const uint *restrict leaves, global const uint *restrict leaf_voxels,              \
        global const uint *restrict attributes, global const uint *restrict fields,               \
        global const uint *restrict primitive_first, global const uint *restrict primitives,      \
        global const float *restrict triangles, PyramidShape shape
