// rays -> hits: the discrete walk of every ray through the world to the first surface it meets.
#include "lib/begin_inside.h"
#include "lib/ray_queue.h"
#include "lib/shadow_flight.h"
#include "lib/vector.h"
#include "lib/work_item.h"
#include "shared/scene.h"

#define VXL_WORLD_ARGUMENTS                                                                      \
    PyramidShape shape, global const uint *restrict sectors, global const uint *restrict bricks, \
        global const uint *restrict leaves, global const uint *restrict leaf_voxels,             \
        global const uint *restrict attributes, global const uint *restrict fields,              \
        global const uint *restrict primitive_first, global const uint *restrict primitives,     \
        global const float *restrict triangles, global const uint *restrict triangle_attributes, \
        global const SolidShape *restrict solids,                                                \
        global const InstanceRecord *restrict instance_records,                                  \
        global const InstanceNode *restrict instance_nodes,                                      \
        global const uint *restrict group_materials

#define VXL_WORLD_VIEWS                                                                           \
    const PyramidView pyramid = pyramid_view(shape, sectors, bricks, leaves, leaf_voxels);        \
    const SurfaceView surface = {                                                                 \
        attributes, fields, primitive_first, primitives, triangles, triangle_attributes, solids}; \
    const InstanceView instances = {instance_records, instance_nodes, group_materials}

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
    h.values[VXL_HIT_INSTANCE] = f->found.instance;
    return h;
}

#define VXL_STORED_COMPONENTS \
    (VXL_INSTANCES ? VXL_HIT_COMPONENTS : (VXL_EXACT ? VXL_HIT_INSTANCE : VXL_HIT_PRIMITIVE))

/// Stores that a packet has met nothing.
static inline void store_misses(uint stride, uint first, global uint* restrict hits) {
    Hit miss;
    miss.values[VXL_HIT_T] = LANES_AS_UINT((lane_float)INFINITY);
    miss.values[VXL_HIT_VOXEL] = (lane_uint)VXL_NO_VOXEL;
    miss.values[VXL_HIT_CELL] = miss.values[VXL_HIT_FACE] = (lane_uint)0;
    miss.values[VXL_HIT_PRIMITIVE] = (lane_uint)VXL_NO_PRIMITIVE;
    miss.values[VXL_HIT_INSTANCE] = (lane_uint)VXL_NO_INSTANCE;
    for (uint i = 0; i < VXL_STORED_COMPONENTS; ++i)
        LANES_STORE(miss.values[i], hits, i * stride + first);
}

/// The closest hit of rays 0 .. count-1 that run beside each other. Arrays hold a multiple of 16
/// rays. Hits don't depend on whether there are `beams`.
kernel void trace_closest(VXL_WORLD_ARGUMENTS, global const float* restrict rays, uint count,
                          uint stride, global const uint* restrict paths,
                          global const float* restrict starts, global const uint* restrict beams,
                          global uint* restrict hits) {
    const uint first = work_item() * VXL_LANES;
    if (first >= count) return;
    if (beams && beam_is_clear(beams, stride, first)) {
        store_misses(stride, first, hits);
        return;
    }
    VXL_WORLD_VIEWS;
    Flight f;
    f.ray = LANES_AS_UINT(LANES_NUMBERS + (int)first);
    set_out(&pyramid, rays, count, stride, paths, starts, &f);
    if (beams) ride_beam(beams, stride, first, &f.walk);
    const lane_int active = LANE_MASK(f.t_end >= 0.0f) & LANE_MASK(f.ray < count);
    f.found =
        find_nearest(&pyramid, &surface, &instances, &f.walk, f.t_end, active, false, &f.travel);
    const Hit hit = hit_of(&f, f.found.hit);
    for (uint i = 0; i < VXL_STORED_COMPONENTS; ++i)
        LANES_STORE(hit.values[i], hits, i * stride + first);
}

#if VXL_PATHS
/// Stores what the rays of the `landing` lanes have met.
static inline void store_hits(const Flight* f, lane_int landing, uint stride,
                              global uint* restrict hits) {
    const Hit hit = hit_of(f, is_hit(&f->found, f->t_end));
    const Places stored = places_from(0, landing);
    uint rays[VXL_LANES], values[VXL_LANES];
    LANES_STORE(f->ray, rays, 0);
    for (uint i = 0; i < VXL_STORED_COMPONENTS; ++i) {
        LANES_STORE(hit.values[i], values, 0);
        for (uint k = 0; k < stored.count; ++k)
            hits[i * stride + rays[stored.lane[k]]] = values[stored.lane[k]];
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
    (void)instances;
    Flight f;
    f.ray = LANES_AS_UINT(LANES_NUMBERS + (int)next);
    set_out(&pyramid, rays, count, stride, paths, starts, &f);
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
        if (next >= end) break;
        const Progress before = progress_of(&f);
        const lane_int fresh = take_rays(~walking, end, &next, &f.ray);
        set_out(&pyramid, rays, count, stride, paths, starts, &f);
        keep_progress(&before, fresh, &f);
        held |= fresh;
        walking |= fresh & LANE_MASK(f.t_end >= 0.0f) & LANE_MASK(f.ray < count) &
                   in_grid(&pyramid, &f.walk);
    }
}
#endif

#if VXL_IMMERSED
/// Adds to the objects that rays 0 .. count-1 are inside of, as begin_paths left them, those that
/// only tracing finds; see find_beginnings. `most` is their number in the scene, smooth ones as
/// one.
kernel void begin_inside(VXL_WORLD_ARGUMENTS, uint constant_attribute,
                         global const float* restrict materials, global const uint* restrict ranks,
                         global uint* lost, global const uint* restrict hollow, uint most,
                         global const float* restrict rays, uint count, uint stride,
                         global uint* restrict paths, global const float* restrict starts,
                         global uint* restrict inside) {
    const uint first = work_item() * VXL_LANES;
    if (first >= count) return;
    VXL_WORLD_VIEWS;
    (void)instances;
    Flight f;
    f.ray = LANES_AS_UINT(LANES_NUMBERS + (int)first);
    set_out(&pyramid, rays, count, stride, paths, starts, &f);
    Interior in = f.travel.interior;
    const lane_int active = LANE_MASK(f.t_end >= 0.0f) & LANE_MASK(f.ray < count);
    const Interior began = find_beginnings(&pyramid, &surface, &f.walk, active, &f.travel,
                                           constant_attribute, materials, hollow, most, lost);
    for (int i = 0; i < VXL_INTERIOR_MEMBERS; ++i) {
        lane_int full;
        in = cross_interior_or_lose(in, began.members[i], (lane_int)(i == 0 ? -1 : 0), (lane_int)0,
                                    LANE_MASK(began.members[i] != VXL_NO_MEMBER), &full);
        if (VXL_INTERIOR_CAPPED && lanes_any(full)) atomic_add(lost, (uint)lanes_count(full));
    }
    store_interior(&in, paths, stride, first);
    LANES_STORE(medium_inside(&in, ranks), inside, first);
}
#endif

/// Traces a queue of shadow rays that begin on surfaces; what reaches its light adds its share of
/// light, `shares` (three components `stride` apart), to the radiance of the ray it was sent for.
///
/// Every target stands in the queue at most once, so no two work-items add to the same place. The
/// first work-item alone adds the queue's length to `traced`, low word and high word.
kernel void trace_shadows(VXL_WORLD_ARGUMENTS, uint constant_attribute,
                          global const float* restrict materials,
                          global const uint* restrict colors, global const uint* restrict ranks,
                          global uint* lost, float4 absorption, DensityShape density_shape,
                          global const uint* restrict density_bricks,
                          global const float* restrict density_values,
                          global const float* restrict rays, global const uint* restrict count,
                          uint stride, global const uint* restrict targets,
                          global const uint* restrict sources, global const uint* restrict paths,
                          global const uint* restrict hits, global const float* restrict shares,
                          global uint* restrict traced, global float* restrict radiance) {
    const uint first = work_item() * (VXL_LANES * VXL_SHADOW_PACKETS);
    const uint queued = *count;
    if (first >= queued) return;
    if (first == 0) {
        traced[0] += queued;
        traced[1] += traced[0] < queued;
    }
    VXL_WORLD_VIEWS;
    const MediumView medium = {absorption, {density_shape, density_bricks, density_values}};
    const FilterView filter = {constant_attribute, materials, colors, ranks, lost, medium,
                               instances};
    const ShadowRays queue = {rays, targets, sources, paths, hits, shares, stride};
#if VXL_SHADOWS_FLY
    const uint end = min(first + VXL_LANES * VXL_SHADOW_PACKETS, queued);
    fly_shadows(&pyramid, &surface, &filter, shape, &queue, first, end, radiance);
#else
    ShadowFlight f;
    f.flight.ray = LANES_AS_UINT(LANES_NUMBERS + (int)first);
    const lane_int active = LANE_MASK(f.flight.ray < queued);
    send_shadows(&surface, &filter, shape, &queue, active, &f);
    bring_light(&queue, &f, find_lights(&pyramid, &surface, &filter, active, &f), radiance);
#endif
}
