// rays -> hits: the discrete walk of every ray through the world to the first surface it meets.
//
// A packet carries VXL_LANES rays. Lanes that reach an occupied voxel wait for others; then the
// surfaces inside those voxels are tested together, and lanes that missed them walk on.
#include "lib/cube_body.h"
#include "lib/fixed_point.h"
#include "lib/hit_word.h"
#include "lib/interior.h"
#include "lib/smooth.h"
#include "lib/solid_surface.h"
#include "lib/surface_color.h"
#include "lib/triangle.h"
#include "lib/vector.h"
#include "lib/work_item.h"
#include "shared/scene.h"
#include "shared/voxel.h"

// Values of the rays that a packet's lanes hold: side by side, unless they are taken on one by one.
#define VXL_RAY_FLOATS(p, ray) \
    (VXL_PATHS ? LANES_GATHER_FLOAT(p, ray) : LANES_LOAD(p, LANES_FIRST(ray)))
#define VXL_RAY_UINTS(p, ray) \
    (VXL_PATHS ? LANES_GATHER_UINT(p, ray) : LANES_LOAD(p, LANES_FIRST(ray)))

// Idle lanes for which a packet takes on further rays.
#define VXL_REFILL ((VXL_LANES + 3) / 4)

typedef struct {
    global const uint* restrict attributes;
    global const uint* restrict fields;
    global const uint* restrict primitive_first;
    global const uint* restrict primitives;
    global const float* restrict triangles;
    global const uint* restrict triangle_attributes;
    global const SolidShape* restrict solids;
} SurfaceView;

/// How a packet's rays set out.
typedef struct {
    lane_int on_surface;     // mask: begins on a surface
    lane_int goes_on;        // mask: continues an earlier ray, whose surface was met at t_first
    lane_uint source;        // the primitive it begins on
    lane_int within_source;  // mask: it travels on inside of that primitive's object
    lane_float t_first;
    Interior interior;  // of scenes with transmitting objects; empty elsewhere
    lane_uint body;     // the body of cubes in it, VXL_NO_MEMBER for none
    lane_int joined;    // mask: the body's inner faces are no surfaces
    lane_int unsure;    // mask: it may begin inside of the smooth body unbeknown
} Travel;

/// What a packet has found so far.
typedef struct {
    lane_int hit;  // mask
    lane_float t;
    lane_uint leaf, voxel, primitive;
    lane_uint solid;   // the last one tested
    lane_float level;  // shift of smooth surfaces for rays that began on one, see hit_smooth
    lane_int asked;    // mask: it is known on which side of the smooth body the ray began ...
    lane_int within;   // mask: ... inside
    lane_int in_body;  // mask: the walk has been in a cell of the body that the ray is inside of
    lane_int exit;     // mask: the hit is the face across which it left the body
} Found;

/// Takes a hit at `t` on a cube or field in the `accepted` lanes, unless a primitive is hit before.
static inline void take_voxel_hit(Found* found, lane_float t, lane_int accepted) {
    const lane_int closer = accepted & LANE_MASK(t < found->t);
    found->t = LANES_SELECT(closer, t, found->t);
    found->primitive = LANES_SELECT(closer, (lane_uint)VXL_NO_PRIMITIVE, found->primitive);
}

/// Ends walks that leave the body of cubes that their rays are inside of; the voxel is its last.
static inline void leave_body(Found* found, const Walk* w, lane_int leaving) {
    found->exit |= leaving & LANE_MASK(w->t < found->t);
    take_voxel_hit(found, w->t, leaving);
}

/// Tests solid `number` of each lane in `tested`: closer hits in the world than *t replace it.
/// `entering` lanes look from one unit of t before their origin first.
static inline lane_int hit_solids_in_world(const PyramidView* p, const SurfaceView* s,
                                           const Walk* w, lane_uint number, const Travel* travel,
                                           lane_int tested, lane_int from_solid, lane_int entering,
                                           lane_float* t) {
    lane_int closer = (lane_int)0;
    const lane_int nothing = (lane_int)0;
    const lane_int early = tested & entering;
    if (lanes_any(early)) {
        const SolidRay ray = {w->ox - w->dx, w->oy - w->dy, w->oz - w->dz, w->dx, w->dy, w->dz};
        lane_float from_before = (lane_float)INFINITY;
        const lane_int met = hit_solids(s->solids, number, &ray, (lane_float)0.0f, nothing, nothing,
                                        early, &from_before);
        const lane_float at = LANES_SELECT(met, from_before - 1.0f, (lane_float)0.0f);
        closer = met & is_in_world(p, w, at) & LANE_MASK(at < *t);
        *t = LANES_SELECT(closer, at, *t);
    }
    const SolidRay ray = {w->ox, w->oy, w->oz, w->dx, w->dy, w->dz};
    const lane_int left = tested & ~closer;
    lane_float at = *t;
    lane_int met = (lane_int)0;
    if (lanes_any(left)) {
        lane_int inside = from_solid & travel->within_source;
        lane_int known = from_solid;
        if (VXL_TRANSMISSION) {
            const lane_int holds =
                interior_holds(&travel->interior, solid_attributes(s->solids, number), nothing);
            known |= holds;
            inside |= holds & ~from_solid;
        }
        met = hit_solids(s->solids, number, &ray, travel->t_first, known, inside, left, &at);
    }
    met &= is_in_world(p, w, LANES_SELECT(met, at, (lane_float)0.0f));
    *t = LANES_SELECT(met, at, *t);
    return closer | met;
}

/// Tests the primitives that the `tested` lanes' voxels list. A primitive may be hit outside of the
/// voxel that lists it: the hit counts once the walk is that far.
///
/// Where a ray comes into the world, a surface on the world's very side may be met just before the
/// ray's rounded origin: there, hits count from behind it as well, as far as the world reaches. A
/// ray that goes on meets what lies at the very t of its last surface in the order of numbers.
static inline lane_int hit_exact(const PyramidView* p, const SurfaceView* s, const Walk* w,
                                 lane_int tested, const Travel* travel, Found* found) {
    const lane_int entering = LANE_MASK(w->t == 0.0f) & LANE_MASK(w->axis != 3);
    const lane_float t_least = LANES_SELECT(entering, (lane_float)-INFINITY, travel->t_first);
    const RayShear shear = ray_shear(w);
    const lane_uint voxel = found->voxel & LANES_AS_UINT(tested);
    lane_uint next = LANES_GATHER_UINT(s->primitive_first, voxel);
    const lane_uint end = LANES_GATHER_UINT(s->primitive_first, voxel + 1u);
    lane_int listing = tested & LANE_MASK(next < end);
    while (lanes_any(listing)) {
        const lane_uint primitive =
            LANES_GATHER_UINT(s->primitives, next & LANES_AS_UINT(listing)) &
            LANES_AS_UINT(listing);
        const lane_int of_source = LANE_MASK(primitive == travel->source);
        const lane_int is_solid = LANE_MASK((primitive & VXL_SOLID_PRIMITIVE) != 0u);
        lane_int closer = (lane_int)0;
        if (VXL_TRIANGLES) {
            const lane_int triangle = listing & ~(is_solid | of_source);
            if (!VXL_SOLIDS || lanes_any(triangle)) {
                const lane_uint number = primitive & LANES_AS_UINT(triangle);
                lane_int within = (lane_int)0, at_least = (lane_int)0;
                if (VXL_TRANSMISSION) {
                    within = interior_holds(&travel->interior,
                                            LANES_GATHER_UINT(s->triangle_attributes, number),
                                            (lane_int)0);
                    at_least = travel->goes_on & LANE_MASK(primitive > travel->source);
                }
                closer |= hit_triangle(p, t_least, at_least, s->triangles, number, w, &shear,
                                       within, triangle, &found->t);
            }
        }
        if (VXL_SOLIDS) {  // a solid is met by the whole ray at once: once is enough
            const lane_int solid = listing & is_solid & LANE_MASK(primitive != found->solid);
            found->solid = LANES_SELECT(solid, primitive, found->solid);
            if (lanes_any(solid))
                closer |= hit_solids_in_world(
                    p, s, w, primitive & ~VXL_SOLID_PRIMITIVE & LANES_AS_UINT(solid), travel, solid,
                    of_source, entering, &found->t);
        }
        found->primitive = LANES_SELECT(closer, primitive, found->primitive);
        next += 1u;
        listing &= LANE_MASK(next < end);
    }
    return tested & LANE_MASK(found->t <= exit_time(w));
}

/// Mask: rays that are inside of the smooth body, as far as their walk has found out.
static inline lane_int within_smooth(const Found* found, const Travel* travel) {
    if (!VXL_TRANSMISSION) return found->within;
    return found->within | LANE_MASK(travel->interior.smooth != VXL_NO_MEMBER);
}

/// Tests the surface inside each `tested` lane's voxel; the mask of lanes whose ray ends there.
static inline lane_int test_surfaces(const PyramidView* p, const SurfaceView* s, const Walk* w,
                                     lane_int tested, const Travel* travel, Found* found) {
    const lane_uint voxel = voxel_number(p, found->leaf & LANES_AS_UINT(tested), w->x & tested,
                                         w->y & tested, w->z & tested) &
                            LANES_AS_UINT(tested);
    lane_int passed = (lane_int)0, left = (lane_int)0;
    if (VXL_CUBE_BODIES) {
        lane_int own = tested & LANE_MASK(travel->body != VXL_NO_MEMBER);
        if (VXL_ATTRIBUTES) own &= is_member(travel->body, LANES_GATHER_UINT(s->attributes, voxel));
        left = tested & found->in_body & ~own;
        leave_body(found, w, left);
        tested &= ~left;
        found->in_body |= own;
        passed = own & travel->joined;
    }
    found->voxel = LANES_SELECT(tested, voxel, found->voxel);
    lane_int cubes = VXL_CUBES ? tested : (lane_int)0;
    lane_int smooth = VXL_SMOOTH ? tested : (lane_int)0;
    lane_int exact = VXL_EXACT ? tested : (lane_int)0;
    if (VXL_CUBES + VXL_SMOOTH + VXL_EXACT > 1) {
        const lane_uint kind = LANES_GATHER_UINT(s->attributes, voxel) >> VXL_KIND_SHIFT;
        cubes &= LANE_MASK(kind == VXL_KIND_CUBES);
        smooth &= LANE_MASK(kind != VXL_KIND_CUBES);  // an exact voxel may hold both
        exact &= LANE_MASK(kind == VXL_KIND_EXACT);
    }
    const lane_int beginning = travel->on_surface & LANE_MASK(w->axis == 3);
    cubes &= ~(beginning | passed);
    lane_int accepted = cubes | left;
    if (VXL_CUBES) take_voxel_hit(found, w->t, cubes);
    if (VXL_SMOOTH && lanes_any(smooth)) {
        const Field field = read_field(s->fields, voxel);
        lane_float t = (lane_float)INFINITY;
        const lane_int asking = smooth & ~found->asked;
        if (lanes_any(asking)) {
            found->within |= asking & begins_within(&field, w, p->plane_bound);
            found->asked |= asking;
        }
        const lane_float side =
            LANES_SELECT(within_smooth(found, travel), (lane_float)-1.0f, (lane_float)1.0f);
        const lane_int met = hit_smooth(&field, w, side, smooth, beginning, &found->level, &t);
        // A ray that goes straight on has its hits beyond this voxel where any other ray has them.
        if (VXL_TRANSMISSION)
            found->level = LANES_SELECT(travel->goes_on, (lane_float)0.0f, found->level);
        take_voxel_hit(found, t, met);
        accepted |= met;
    }
    if (VXL_EXACT && lanes_any(exact)) accepted |= hit_exact(p, s, w, exact, travel, found);
    return accepted;
}

/// Before a walk.
static inline Found found_nothing(const Travel* travel) {
    Found found;
    found.hit = (lane_int)0;
    found.t = (lane_float)INFINITY;
    found.leaf = found.voxel = (lane_uint)0;
    found.primitive = found.solid = (lane_uint)VXL_NO_PRIMITIVE;
    found.level = (lane_float)0.0f;
    found.asked = ~travel->unsure;
    found.within = (lane_int)0;
    found.in_body = found.exit = (lane_int)0;
    return found;
}

/// Moves the `walking` lanes one step: out of the empty block around them, or, where their cell is
/// occupied, to the `waiting` ones. Lanes that leave the world or come to t_end are in neither.
static inline void walk_on(const PyramidView* p, Walk* w, lane_float t_end, Found* found,
                           lane_int* walking, lane_int* waiting) {
    lane_int moving = *walking;
    const CellState state = look_up(p, w->x, w->y, w->z, moving);
    const lane_int arrived = state.occupied & moving;
    found->leaf = LANES_SELECT(arrived, state.leaf, found->leaf);
    *waiting |= arrived;
    moving &= ~arrived;
    if (VXL_CUBE_BODIES) {
        const lane_int left = moving & found->in_body;
        leave_body(found, w, left);
        found->hit |= left;
        moving &= ~left;
    }
    advance(p, w, state.log2_size, moving);
    moving &= in_grid(p, w) & LANE_MASK(w->t <= t_end);
    if (VXL_EXACT) {  // an earlier voxel's primitive is hit before anything ahead
        const lane_int passed = moving & LANE_MASK(w->t >= found->t);
        found->hit |= passed;
        moving &= ~passed;
    }
    *walking = moving;
}

/// Tests the surfaces in the voxels of the `waiting` lanes; those that miss them walk on.
static inline void meet_surfaces(const PyramidView* p, const SurfaceView* s, Walk* w,
                                 lane_float t_end, const Travel* travel, Found* found,
                                 lane_int* walking, lane_int* waiting) {
    const lane_int accepted = test_surfaces(p, s, w, *waiting, travel, found) & *waiting;
    found->hit |= accepted;
    lane_int moving = *waiting & ~accepted;
    *waiting = (lane_int)0;
    if (!lanes_any(moving)) return;
    advance(p, w, (lane_int)0, moving);
    if (VXL_CUBE_BODIES) {
        const lane_int left = moving & found->in_body & ~in_grid(p, w);
        leave_body(found, w, left);
        found->hit |= left;
    }
    *walking |= moving & in_grid(p, w) & LANE_MASK(w->t <= t_end);
}

/// Mask: lanes whose walks have ended with a hit.
static inline lane_int is_hit(const Found* found, lane_float t_end) {
    lane_int hit = found->hit;
    if (VXL_EXACT) hit |= LANE_MASK(found->t < INFINITY);
    return hit & LANE_MASK(found->t <= t_end);
}

/// Walks the `active` lanes to their first surface before t_end.
static inline Found find_first(const PyramidView* p, const SurfaceView* s, Walk* w,
                               lane_float t_end, lane_int active, const Travel* travel) {
    Found found = found_nothing(travel);
    lane_int walking = active & in_grid(p, w), waiting = (lane_int)0;
    while (lanes_any(walking)) {
        while (lanes_any(walking)) walk_on(p, w, t_end, &found, &walking, &waiting);
        meet_surfaces(p, s, w, t_end, travel, &found, &walking, &waiting);
    }
    found.hit = is_hit(&found, t_end) & active;
    return found;
}

static inline PyramidView pyramid_view(PyramidShape shape, global const uint* restrict sectors,
                                       global const uint* restrict bricks,
                                       global const uint* restrict leaves,
                                       global const uint* restrict leaf_voxels) {
    PyramidView p = {sectors,           bricks,           leaves,
                     leaf_voxels,       shape.size_x,     shape.size_y,
                     shape.size_z,      shape.sectors_x,  shape.sectors_y,
                     shape.plane_bound, shape.fixed_point};
    return p;
}

static inline Walk load_walk(global const float* restrict rays, uint stride, lane_uint ray) {
    return begin_walk(VXL_RAY_FLOATS(rays + VXL_RAY_OX * stride, ray),
                      VXL_RAY_FLOATS(rays + VXL_RAY_OY * stride, ray),
                      VXL_RAY_FLOATS(rays + VXL_RAY_OZ * stride, ray),
                      VXL_RAY_FLOATS(rays + VXL_RAY_DX * stride, ray),
                      VXL_RAY_FLOATS(rays + VXL_RAY_DY * stride, ray),
                      VXL_RAY_FLOATS(rays + VXL_RAY_DZ * stride, ray));
}

/// Mask: a coordinate of a ray's origin lies on the side of the world across which it comes in.
static inline lane_int on_entry_side(lane_float o, lane_float d, int size) {
    return (LANE_MASK(o == 0.0f) & LANE_MASK(d > 0.0f)) |
           (LANE_MASK(o == (float)size) & LANE_MASK(d < 0.0f));
}

/// Lets `entering` walks that begin on a side of the world have come in across it.
static inline void enter_world(const PyramidView* p, Walk* w, lane_int entering) {
    const lane_int x = on_entry_side(w->ox, w->dx, p->size_x) & entering;
    const lane_int y = on_entry_side(w->oy, w->dy, p->size_y) & entering;
    const lane_int z = on_entry_side(w->oz, w->dz, p->size_z) & entering;
    w->axis = LANES_SELECT(z, (lane_int)2, w->axis);
    w->axis = LANES_SELECT(y, (lane_int)1, w->axis);
    w->axis = LANES_SELECT(x, (lane_int)0, w->axis);
}

#define VXL_WORLD_ARGUMENTS                                                                      \
    PyramidShape shape, global const uint *restrict sectors, global const uint *restrict bricks, \
        global const uint *restrict leaves, global const uint *restrict leaf_voxels,             \
        global const uint *restrict attributes, global const uint *restrict fields,              \
        global const uint *restrict primitive_first, global const uint *restrict primitives,     \
        global const float *restrict triangles, global const uint *restrict triangle_attributes, \
        global const SolidShape *restrict solids

#define VXL_WORLD_VIEWS                                                                    \
    const PyramidView pyramid = pyramid_view(shape, sectors, bricks, leaves, leaf_voxels); \
    const SurfaceView surface = {                                                          \
        attributes, fields, primitive_first, primitives, triangles, triangle_attributes, solids}

/// Rays from the observer.
static inline Travel sight_travel(void) {
    const Travel travel = {
        (lane_int)0,      (lane_int)0,      (lane_uint)VXL_NO_PRIMITIVE, (lane_int)0,
        (lane_float)0.0f, empty_interior(), (lane_uint)VXL_NO_MEMBER,    (lane_int)0,
        (lane_int)0};
    return travel;
}

static inline lane_int has_flag(lane_uint flags, uint flag) {
    return LANE_MASK((flags & flag) != 0u);
}

static inline Travel load_travel(global const uint* restrict paths,
                                 global const float* restrict starts, uint stride, lane_uint ray) {
    Travel travel = sight_travel();
    const lane_uint flags = VXL_RAY_UINTS(paths + VXL_PATH_FLAGS * stride, ray);
    travel.on_surface = has_flag(flags, VXL_PATH_ON_SURFACE);
    travel.within_source = has_flag(flags, VXL_PATH_WITHIN_SOURCE);
    travel.source = VXL_RAY_UINTS(paths + VXL_PATH_SOURCE * stride, ray);
    if (VXL_TRANSMISSION) {
        travel.goes_on = has_flag(flags, VXL_PATH_GOES_ON);
        travel.t_first = VXL_RAY_FLOATS(starts, ray);
        travel.interior = gather_interior(paths, stride, ray);
    }
    if (VXL_CUBE_BODIES) {
        travel.body = body_inside(&travel.interior);
        travel.joined = has_flag(flags, VXL_PATH_JOINED);
    }
    return travel;
}

/// When the ray came into the walk's present cell, less than 0 where it began.
static inline lane_float entry_time(const Walk* w) {
    const lane_float none = (lane_float)-INFINITY;
    const lane_float tx = (LANES_FLOAT(w->x + w->px + 1) - w->ox) * w->ix;
    const lane_float ty = (LANES_FLOAT(w->y + w->py + 1) - w->oy) * w->iy;
    const lane_float tz = (LANES_FLOAT(w->z + w->pz + 1) - w->oz) * w->iz;
    return fmax(LANES_SELECT(w->mx, tx, none),
                fmax(LANES_SELECT(w->my, ty, none), LANES_SELECT(w->mz, tz, none)));
}

/// Moves the `resuming` walks to the cell where their rays begin or go on.
static inline void resume_walk(Walk* w, const Travel* travel, lane_uint cell_xy, lane_uint cell_z,
                               lane_int resuming) {
    const lane_int on = resuming;
    w->x = LANES_SELECT(on, LANES_AS_INT(cell_xy & 0xFFFFu), w->x);
    w->y = LANES_SELECT(on, LANES_AS_INT(cell_xy >> 16), w->y);
    w->z = LANES_SELECT(on, LANES_AS_INT(cell_z & 0xFFFFu), w->z);
    w->axis = LANES_SELECT(on, (lane_int)3, w->axis);
    if (VXL_CUBE_BODIES) {  // out of a body: what fills the next cell is entered now
        const lane_int out = on & is_exit(cell_z);
        const lane_uint axis = (cell_z >> VXL_FACE_AXIS_SHIFT) & VXL_FACE_AXIS_MASK;
        w->axis = LANES_SELECT(out, LANES_AS_INT(axis), w->axis);
        step_across(w, has_flag(cell_z, VXL_FACE_UP), out);
    }
    w->t = LANES_SELECT(on, fmax(travel->t_first, entry_time(w)), w->t);
}

/// A packet of rays on their way.
typedef struct {
    lane_uint ray;  // the number of each lane's ray
    Walk walk;
    Travel travel;
    Found found;
    lane_float t_end;
} Flight;

/// Gives the `idle` lanes the next of the rays up to `end`; the mask of those that got one.
static inline lane_int take_rays(lane_int idle, uint end, uint* next, lane_uint* ray) {
    uint numbers[VXL_LANES];
    int taken[VXL_LANES];
    LANES_STORE(*ray, numbers, 0);
    LANES_STORE(idle, taken, 0);
    for (int lane = 0; lane < VXL_LANES; ++lane) {
        taken[lane] &= -(int)(*next < end);
        numbers[lane] = taken[lane] ? *next : numbers[lane];
        *next -= (uint)taken[lane];
    }
    *ray = LANES_LOAD(numbers, 0);
    return LANES_LOAD(taken, 0);
}

/// Sets the rays that the lanes hold on their way.
static inline void set_out(const PyramidView* p, global const float* restrict rays, uint stride,
                           global const uint* restrict paths, global const float* restrict starts,
                           Flight* f) {
    f->walk = load_walk(rays, stride, f->ray);
    f->travel = sight_travel();
    if (VXL_PATHS) f->travel = load_travel(paths, starts, stride, f->ray);
    enter_world(p, &f->walk, ~f->travel.on_surface);
    f->travel.unsure = ~f->travel.on_surface & LANE_MASK(f->walk.axis == 3);
    if (VXL_TRANSMISSION)
        resume_walk(&f->walk, &f->travel, VXL_RAY_UINTS(paths + VXL_PATH_CELL * stride, f->ray),
                    VXL_RAY_UINTS(paths + VXL_PATH_CELL_Z * stride, f->ray),
                    has_flag(VXL_RAY_UINTS(paths + VXL_PATH_FLAGS * stride, f->ray),
                             VXL_PATH_GOES_ON | VXL_PATH_FROM_CELL));
    f->t_end = VXL_RAY_FLOATS(rays + VXL_RAY_END * stride, f->ray);
    f->found = found_nothing(&f->travel);
}

/// Puts lanes that are not `fresh` back to where their walks had been.
static inline void keep_progress(const Flight* before, lane_int fresh, Flight* f) {
    f->walk.x = LANES_SELECT(fresh, f->walk.x, before->walk.x);
    f->walk.y = LANES_SELECT(fresh, f->walk.y, before->walk.y);
    f->walk.z = LANES_SELECT(fresh, f->walk.z, before->walk.z);
    f->walk.t = LANES_SELECT(fresh, f->walk.t, before->walk.t);
    f->walk.axis = LANES_SELECT(fresh, f->walk.axis, before->walk.axis);
    f->found.hit = LANES_SELECT(fresh, f->found.hit, before->found.hit);
    f->found.t = LANES_SELECT(fresh, f->found.t, before->found.t);
    f->found.leaf = LANES_SELECT(fresh, f->found.leaf, before->found.leaf);
    f->found.voxel = LANES_SELECT(fresh, f->found.voxel, before->found.voxel);
    f->found.primitive = LANES_SELECT(fresh, f->found.primitive, before->found.primitive);
    f->found.solid = LANES_SELECT(fresh, f->found.solid, before->found.solid);
    f->found.level = LANES_SELECT(fresh, f->found.level, before->found.level);
    f->found.asked = LANES_SELECT(fresh, f->found.asked, before->found.asked);
    f->found.within = LANES_SELECT(fresh, f->found.within, before->found.within);
    f->found.in_body = LANES_SELECT(fresh, f->found.in_body, before->found.in_body);
    f->found.exit = LANES_SELECT(fresh, f->found.exit, before->found.exit);
}

/// What a ray met, as shared/trace.h describes it.
typedef struct {
    lane_uint values[VXL_HIT_COMPONENTS];
} Hit;

static inline Hit hit_of(const Flight* f, lane_int hit) {
    Hit h;
    Walk walk = f->walk;
    lane_uint face = hit_face(&walk, f->found.exit & hit);
    if (VXL_SMOOTH) face |= LANES_AS_UINT(within_smooth(&f->found, &f->travel)) & VXL_FACE_WITHIN;
    h.values[VXL_HIT_T] = LANES_AS_UINT(f->found.t);
    h.values[VXL_HIT_VOXEL] = LANES_SELECT(hit, f->found.voxel, (lane_uint)VXL_NO_VOXEL);
    h.values[VXL_HIT_CELL] = LANES_AS_UINT(walk.x | (walk.y << 16));
    h.values[VXL_HIT_FACE] = face;
    h.values[VXL_HIT_PRIMITIVE] = f->found.primitive;
    return h;
}

#define VXL_STORED_COMPONENTS (VXL_EXACT ? VXL_HIT_COMPONENTS : VXL_HIT_PRIMITIVE)

/// The closest hit of rays 0 .. count-1 that run beside each other. Arrays hold a multiple of 16
/// rays.
kernel void trace_closest(VXL_WORLD_ARGUMENTS, global const float* restrict rays, uint count,
                          uint stride, global const uint* restrict paths,
                          global const float* restrict starts, global uint* restrict hits) {
    const uint first = work_item() * VXL_LANES;
    if (first >= count) return;
    VXL_WORLD_VIEWS;
    Flight f;
    f.ray = LANES_AS_UINT(LANES_NUMBERS + (int)first);
    set_out(&pyramid, rays, stride, paths, starts, &f);
    const lane_int active = LANE_MASK(f.t_end >= 0.0f) & LANE_MASK(f.ray < count);
    f.found = find_first(&pyramid, &surface, &f.walk, f.t_end, active, &f.travel);
    const Hit hit = hit_of(&f, f.found.hit);
    for (uint i = 0; i < VXL_STORED_COMPONENTS; ++i)
        LANES_STORE(hit.values[i], hits, i * stride + first);
}

#if VXL_PATHS
/// Stores what the rays of the `landing` lanes have met.
static inline void store_hits(const Flight* f, lane_int landing, uint stride,
                              global uint* restrict hits) {
    const Hit hit = hit_of(f, is_hit(&f->found, f->t_end));
    uint rays[VXL_LANES], values[VXL_LANES];
    int stored[VXL_LANES];
    LANES_STORE(f->ray, rays, 0);
    LANES_STORE(landing, stored, 0);
    for (uint i = 0; i < VXL_STORED_COMPONENTS; ++i) {
        LANES_STORE(hit.values[i], values, 0);
        for (uint lane = 0; lane < VXL_LANES; ++lane)
            if (stored[lane]) hits[i * stride + rays[lane]] = values[lane];
    }
}

/// The closest hit of rays 0 .. count-1 that run anywhere: reflected and refracted ones.
///
/// A work-item carries VXL_PACKETS(VXL_LANES) packets' rays. Lanes whose rays have ended wait until
/// several have; then their hits are stored, and they go on with the next rays. Lanes walk while
/// more of them can than wait in occupied voxels. The hits' bits are those of trace_closest.
kernel void trace_scattered(VXL_WORLD_ARGUMENTS, global const float* restrict rays, uint count,
                            uint stride, global const uint* restrict paths,
                            global const float* restrict starts, global uint* restrict hits) {
    uint next = work_item() * (VXL_LANES * VXL_PACKETS(VXL_LANES));
    if (next >= count) return;
    const uint end =
        min(next + VXL_LANES * VXL_PACKETS(VXL_LANES), (count + VXL_LANES - 1u) & -VXL_LANES);
    VXL_WORLD_VIEWS;
    Flight f;
    f.ray = LANES_AS_UINT(LANES_NUMBERS + (int)next);
    set_out(&pyramid, rays, stride, paths, starts, &f);
    next += VXL_LANES;
    lane_int held = (lane_int)-1, waiting = (lane_int)0;
    lane_int walking =
        LANE_MASK(f.t_end >= 0.0f) & LANE_MASK(f.ray < count) & in_grid(&pyramid, &f.walk);
    while (true) {
        int steps = lanes_count(walking), tests = 0;
        const int least = next < end ? VXL_LANES - VXL_REFILL : 0;
        while (steps > tests && steps + tests > least) {
            walk_on(&pyramid, &f.walk, f.t_end, &f.found, &walking, &waiting);
            steps = lanes_count(walking), tests = lanes_count(waiting);
        }
        if (tests > 0)
            meet_surfaces(&pyramid, &surface, &f.walk, f.t_end, &f.travel, &f.found, &walking,
                          &waiting);
        steps = lanes_count(walking);
        if (steps > least) continue;
        store_hits(&f, held & ~walking, stride, hits);
        held &= walking;
        if (next >= end) {
            if (steps == 0) break;
            continue;
        }
        const Flight before = f;
        const lane_int fresh = take_rays(~walking, end, &next, &f.ray);
        set_out(&pyramid, rays, stride, paths, starts, &f);
        keep_progress(&before, fresh, &f);
        held |= fresh;
        walking |= fresh & LANE_MASK(f.t_end >= 0.0f) & LANE_MASK(f.ray < count) &
                   in_grid(&pyramid, &f.walk);
    }
}
#endif

/// Finds the body of cubes that the rays are inside of.
static inline void find_body(Travel* travel, global const float* restrict materials) {
    travel->body = body_inside(&travel->interior);
    travel->joined = is_joined(travel->body, materials);
}

/// What surfaces and objects on the way leave of a shadow ray's light.
typedef struct {
    lane_float passed[3];  // by surfaces
    lane_float depth[3];   // optical depth of objects
} Filter;

/// Lets a packet of shadow rays go on through transmitting surfaces; the mask of those that reach
/// their light. Rays that meet more than VXL_MOST_LAYERS surfaces don't.
static inline lane_int pass_through(const PyramidView* p, const SurfaceView* s, Walk* w,
                                    lane_float t_end, lane_int active, Travel* travel,
                                    uint constant_attribute, global const float* restrict materials,
                                    global const uint* restrict colors,
                                    global const uint* restrict ranks, lane_float metres,
                                    Filter* filter) {
    lane_float t_last = (lane_float)0.0f;
    // Objects end where the world does.
    lane_float t_in = t_last, t_out = t_end;
    clip_axis(w->ox, w->dx, (float)p->size_x, &t_in, &t_out);
    clip_axis(w->oy, w->dy, (float)p->size_y, &t_in, &t_out);
    clip_axis(w->oz, w->dz, (float)p->size_z, &t_in, &t_out);
    lane_int passing = active, arrived = (lane_int)0;
    for (int layer = 0; layer < VXL_MOST_LAYERS && lanes_any(passing); ++layer) {
        const Found found = find_first(p, s, w, t_end, passing, travel);
        const lane_int hit = found.hit & passing;
        // The way up to here, to the light or out of the world, inside of the object that counts.
        const lane_uint before = effective_member(&travel->interior, ranks);
        const lane_uint medium =
            material_place(before) & LANES_AS_UINT(LANE_MASK(before != VXL_NO_MEMBER));
        const lane_float t_now = LANES_SELECT(hit, found.t, fmax(t_out, t_last));
        const lane_int absorbs = passing & LANE_MASK(before != VXL_NO_MEMBER);
        const lane_float way = LANES_SELECT(absorbs, (t_now - t_last) * metres, (lane_float)0.0f);
        for (int channel = 0; channel < 3; ++channel)
            filter->depth[channel] = fma(
                LANES_GATHER_FLOAT(materials, medium + (uint)(VXL_MATERIAL_ABSORPTION + channel)),
                way, filter->depth[channel]);
        arrived |= passing & ~hit;
        passing = hit;
        if (!lanes_any(passing)) break;

        const lane_uint voxel = found.voxel & LANES_AS_UINT(hit);
        const lane_uint word = hit_word(s->attributes, constant_attribute, s->triangle_attributes,
                                        s->solids, voxel, found.primitive, hit);
        const lane_int smooth = is_smooth(word, found.primitive);
        const lane_uint material = material_place(word) & LANES_AS_UINT(hit);
        const lane_float opacity = surface_opacity(materials, material, colors, voxel);
        const lane_float refraction =
            LANES_GATHER_FLOAT(materials, material + VXL_MATERIAL_REFRACTION);
        passing &= LANE_MASK(opacity < 1.0f) | LANE_MASK(refraction > 0.0f) | found.exit;
        lane_int leaving = interior_holds(&travel->interior, word, smooth);
        lane_int inner = (lane_int)0;
        if (VXL_CUBE_BODIES) {
            const lane_int cube = is_cube(word, found.primitive);
            inner = cube & leaving & ~found.exit;
            leaving = LANES_SELECT(cube, found.exit, leaving);
        }
        travel->interior = cross_interior(travel->interior, word, smooth, leaving, passing);
        lane_int hidden = same_member(before, effective_member(&travel->interior, ranks)) & passing;
        if (VXL_CUBE_BODIES) {
            hidden |= found.exit & LANE_MASK(refraction == 0.0f);
            hidden = LANES_SELECT(inner, ~same_member(before, word), hidden);
            find_body(travel, materials);
        }
        const lane_uint color = color_place(materials, material, fma(w->dx, found.t, w->ox),
                                            fma(w->dy, found.t, w->oy), fma(w->dz, found.t, w->oz));
        const lane_float clear = 1.0f - opacity;
        for (int channel = 0; channel < 3; ++channel) {
            const lane_float tint =
                fma(opacity, surface_color(materials, color, colors, voxel, channel), clear);
            lane_float part = clear * tint;
            if (VXL_FILTERED) part = fma(opacity, refraction, part);
            filter->passed[channel] *= LANES_SELECT(passing & ~hidden, part, (lane_float)1.0f);
        }
        if (!VXL_FILTERED) passing &= hidden | LANE_MASK(clear > 0.0f);
        travel->goes_on = travel->on_surface = (lane_int)-1;
        travel->source = found.primitive;
        travel->within_source = ~leaving;
        travel->t_first = t_last = LANES_SELECT(passing, found.t, t_last);
        w->t = LANES_SELECT(passing, fmax(found.t, w->t), w->t);
        w->axis = LANES_SELECT(found.exit, w->axis, (lane_int)3);
    }
    return arrived;
}

/// Traces a queue of shadow rays that begin on surfaces; what reaches its light adds its share of
/// light, `shares` (three components `stride` apart), to the radiance of the ray it was sent for.
///
/// Every target stands in the queue at most once, so no two work-items add to the same place. The
/// first work-item alone adds the queue's length to `traced`, low word and high word.
kernel void trace_shadows(VXL_WORLD_ARGUMENTS, uint constant_attribute,
                          global const float* restrict materials,
                          global const uint* restrict colors, global const uint* restrict ranks,
                          global const float* restrict rays, global const uint* restrict count,
                          uint stride, global const uint* restrict targets,
                          global const uint* restrict sources, global const uint* restrict paths,
                          global const float* restrict shares, global uint* restrict traced,
                          global float* restrict radiance) {
    const uint first = work_item() * VXL_LANES;
    const uint queued = *count;
    if (first >= queued) return;
    if (first == 0) {
        traced[0] += queued;
        traced[1] += traced[0] < queued;
    }
    VXL_WORLD_VIEWS;
    Walk walk = load_walk(rays, stride, LANES_AS_UINT(LANES_NUMBERS + (int)first));
    const lane_float t_end = LANES_LOAD(rays, VXL_RAY_END * stride + first);
    const lane_int active = LANE_MASK(LANES_AS_INT(LANES_NUMBERS + (int)first) < (int)queued);
    Travel travel = sight_travel();
    travel.on_surface = (lane_int)-1;
    if (VXL_EXACT) travel.source = LANES_LOAD(sources, first);
    if (VXL_SOLIDS) {
        const SolidRay ray = {walk.ox, walk.oy, walk.oz, walk.dx, walk.dy, walk.dz};
        const lane_int solid = LANE_MASK((travel.source & VXL_SOLID_PRIMITIVE) != 0u) &
                               LANE_MASK(travel.source != VXL_NO_PRIMITIVE) & active;
        if (lanes_any(solid))
            travel.within_source = go_inside(
                solids, travel.source & ~VXL_SOLID_PRIMITIVE & LANES_AS_UINT(solid), &ray, solid);
    }
    lane_float share[3];
    for (int channel = 0; channel < 3; ++channel)
        share[channel] = LANES_LOAD(shares, channel * stride + first);
    lane_int arrived;
    if (VXL_FILTER) {
        // `paths` are those of the rays that met the surface: on its same side light arrives.
        const lane_uint target = LANES_LOAD(targets, first) & LANES_AS_UINT(active);
        const lane_uint inside = VXL_PATH_INSIDE * stride + target;
        travel.interior.smooth = LANES_GATHER_UINT(paths, inside);
        travel.interior.a = LANES_GATHER_UINT(paths, inside + stride);
        travel.interior.b = LANES_GATHER_UINT(paths, inside + 2u * stride);
        travel.interior.c = LANES_GATHER_UINT(paths, inside + 3u * stride);
        if (VXL_CUBE_BODIES) find_body(&travel, materials);
        const Vector along = {walk.dx * shape.edge.x, walk.dy * shape.edge.y,
                              walk.dz * shape.edge.z};
        const lane_float zero = (lane_float)0.0f, one = (lane_float)1.0f;
        Filter filter = {{one, one, one}, {zero, zero, zero}};
        arrived =
            pass_through(&pyramid, &surface, &walk, t_end, active, &travel, constant_attribute,
                         materials, colors, ranks, exact_sqrt(dot_product(along, along)), &filter);
        for (int channel = 0; channel < 3; ++channel)
            share[channel] *= filter.passed[channel] * exact_exp(-filter.depth[channel]);
    } else {
        arrived = active & ~find_first(&pyramid, &surface, &walk, t_end, active, &travel).hit;
    }
    uint target[VXL_LANES];
    float sent[3 * VXL_LANES];
    int lit[VXL_LANES];
    LANES_STORE(LANES_LOAD(targets, first), target, 0);
    LANES_STORE(arrived, lit, 0);
    for (int channel = 0; channel < 3; ++channel)
        LANES_STORE(share[channel], sent, channel * VXL_LANES);
    for (int lane = 0; lane < VXL_LANES; ++lane)
        for (int channel = 0; channel < 3; ++channel)
            if (lit[lane])
                radiance[channel * stride + target[lane]] += sent[channel * VXL_LANES + lane];
}
