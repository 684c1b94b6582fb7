// surface points -> the rays that go on from them: straight, reflected, refracted; and back: their
// light.
//
// Every ray is an entry of a batch and belongs to a node, the light along one ray of the tree that
// Whitted 1980 describes. Surfaces that transmit light straight on make further entries of the same
// node, layer by layer; reflection and refraction make nodes of the next depth. Light is gathered
// by each entry from its own children, so that no sum depends on the order of the queues.
#include "lib/lanes/fixed_point.h"
#include "lib/lanes/vector.h"
#include "lib/lanes/work_item.h"
#include "lib/light/medium_set.h"
#include "lib/light/optics.h"
#include "lib/solid/solid_hit.h"
#include "lib/surface/cube_body.h"
#include "lib/surface/surface_color.h"
#include "lib/traverse/hit_attributes.h"
#include "lib/traverse/offset_origin.h"
#include "lib/traverse/ray_queue.h"
#include "shared/scene.h"

#define VXL_NO_CHILD 0xFFFFFFFFu

/// Numbers in `counters`.
#define VXL_COUNT_LAYER 0u     // entries of the next layer
#define VXL_COUNT_CHILDREN 1u  // nodes of the next depth
#define VXL_COUNT_ENDED 2u     // paths that ended for their small weight

static inline lane_float path_float(global const uint* paths, uint component, uint stride,
                                    uint first) {
    return LANES_AS_FLOAT(LANES_LOAD(paths, component * stride + first));
}

static inline lane_float largest(const lane_float* value) {
    return fmax(value[0], fmax(value[1], value[2]));
}

static inline lane_int below(uint first, uint count) {
    return LANE_MASK(LANES_AS_INT(LANES_NUMBERS + (int)first) < (int)count);
}

/// VXL_PATH_JOINED of rays inside of a set of objects.
static inline lane_uint joined_flag(const MediumSet* in, global const float* restrict materials) {
    return LANES_AS_UINT(is_joined(body_inside(in), materials)) & VXL_PATH_JOINED;
}

/// The index of refraction of a RayBatch::inside.
static inline lane_float medium_ior(global const float* restrict materials, lane_uint medium) {
    const lane_int some = LANE_MASK(medium != 0u);
    const lane_uint material = ((medium - 1u) & LANES_AS_UINT(some)) * VXL_MATERIAL_FLOATS;
    return LANES_SELECT(some, LANES_GATHER_FLOAT(materials, material + VXL_MATERIAL_IOR),
                        (lane_float)1.0f);
}

static inline void count_lanes(lane_int mask, global uint* counter) {
    if (lanes_any(mask)) atomic_add(counter, (uint)lanes_count(mask));
}

/// cross_medium; sets that have no room are counted in `medium_overflows`.
static inline MediumSet cross_counted(MediumSet in, lane_uint packed, lane_int smooth,
                                      lane_int leaving, lane_int crossing,
                                      global uint* medium_overflows) {
    lane_int full;
    in = cross_medium_or_overflow(in, packed, smooth, leaving, crossing, &full);
    if (VXL_MEDIUM_SET_CAPPED) count_lanes(full, medium_overflows);
    return in;
}

/// Makes rays from an observer entries of their own nodes. `bodies` are the solids that transmit
/// light: a ray may begin inside of them.
kernel void begin_paths(global const SolidShape* restrict solids, uint body_count,
                        global const uint* restrict bodies, global const uint* restrict ranks,
                        global uint* medium_overflows, global const float* restrict rays,
                        uint count, uint stride, global uint* restrict paths,
                        global float* restrict starts, global uint* restrict inside) {
    const uint first = work_item() * VXL_LANES;
    if (first >= count) return;
    const lane_uint one = LANES_AS_UINT((lane_float)1.0f);
    LANES_STORE((lane_uint)VXL_NO_PRIMITIVE, paths, VXL_PATH_SOURCE * stride + first);
    LANES_STORE((lane_uint)0, paths, VXL_PATH_FLAGS * stride + first);
    LANES_STORE(one, paths, VXL_PATH_WEIGHT * stride + first);
    if (VXL_INSTANCES)
        LANES_STORE((lane_uint)VXL_NO_INSTANCE, paths, VXL_PATH_INSTANCE * stride + first);
    if (!VXL_TRANSMISSION) return;
    LANES_STORE((lane_uint)0, paths, VXL_PATH_CELL * stride + first);
    LANES_STORE((lane_uint)0, paths, VXL_PATH_CELL_Z * stride + first);
    LANES_STORE(LANES_AS_UINT(LANES_NUMBERS + (int)first), paths, VXL_PATH_TARGET * stride + first);
    LANES_STORE(one, paths, VXL_PATH_CLEAR * stride + first);
    for (uint c = 0; c < 3; ++c)
        LANES_STORE(one, paths, (VXL_PATH_THROUGHPUT + c) * stride + first);
    LANES_STORE((lane_float)0.0f, starts, first);
    MediumSet in = empty_medium_set();
    if (VXL_SOLIDS) {
        const Vector o = load_vector(rays, stride, first);
        const Vector d = load_vector(rays + VXL_RAY_DX * stride, stride, first);
        const SolidRay ray = {o.x, o.y, o.z, d.x, d.y, d.z};
        const lane_int valid =
            below(first, count) & LANE_MASK(LANES_LOAD(rays, VXL_RAY_END * stride + first) >= 0.0f);
        for (uint i = 0; i < body_count; ++i) {
            const SolidEvent event = event_at(solids, bodies[i], &ray, (lane_float)0.0f);
            in = cross_counted(in, (lane_uint)solids[bodies[i]].attribute, (lane_int)0, (lane_int)0,
                               event.after & valid, medium_overflows);
        }
    }
    store_medium_set(&in, paths, stride, first);
    LANES_STORE(medium_inside(&in, ranks), inside, first);
}

/// Adds a layer's light to its nodes (in the first layer: begins their sums), and sends the rays on
/// that surfaces leave uncovered. `node_weights` is what an entry's reflected and refracted light
/// counts in its node; `coverage` of a node may be null.
kernel void pass_layer(global const float* restrict materials, global const uint* restrict ranks,
                       global uint* medium_overflows, global const uint* restrict colors,
                       float min_weight, uint first_layer, global const float* restrict rays,
                       global const uint* restrict hits, global const uint* restrict hit_attributes,
                       global const uint* restrict sides, global const float* restrict radiance,
                       global const float* restrict transmittance,
                       global const uint* restrict paths, uint count, uint stride,
                       global float* restrict node_weights, global float* restrict nodes,
                       global float* restrict coverage, uint node_stride,
                       global uint* restrict counters, global float* restrict next_rays,
                       global uint* restrict next_paths, global float* restrict next_starts,
                       global uint* restrict next_inside, uint next_stride) {
    const uint first = work_item() * VXL_LANES;
    if (first >= count) return;
    const lane_int valid = below(first, count);
    const lane_uint number = LANES_LOAD(hits, VXL_HIT_VOXEL * stride + first);
    const lane_int hit = LANE_MASK(number != VXL_NO_VOXEL) & valid;
    const lane_uint packed = LANES_LOAD(hit_attributes, first);
    const lane_uint side = LANES_LOAD(sides, first);
    const lane_int hidden = LANE_MASK((side & VXL_SIDE_HIDDEN) != 0u) & hit;
    const lane_int leaving = LANE_MASK((side & VXL_SIDE_LEAVING) != 0u);
    const lane_uint material = material_offset(packed) & LANES_AS_UINT(hit);
    const lane_float zero = (lane_float)0.0f, one = (lane_float)1.0f;
    const lane_uint voxel = number & LANES_AS_UINT(hit);
    lane_float opacity =
        LANES_SELECT(hit, surface_opacity(materials, material, colors, voxel), one);
    opacity = LANES_SELECT(hidden, zero, opacity);
    const lane_float left = 1.0f - opacity;
    const lane_float clear = path_float(paths, VXL_PATH_CLEAR, stride, first);
    const lane_uint target = LANES_LOAD(paths, VXL_PATH_TARGET * stride + first);

    int add[VXL_LANES];
    uint node[VXL_LANES];
    LANES_STORE(valid, add, 0);
    LANES_STORE(target, node, 0);
    NewRays on;
    for (uint c = 0; c < 3; ++c) {
        const lane_float before = path_float(paths, VXL_PATH_THROUGHPUT + c, stride, first);
        float light[VXL_LANES];
        LANES_STORE(before * LANES_LOAD(radiance, c * stride + first), light, 0);
        for (int lane = 0; lane < VXL_LANES; ++lane) {
            if (!add[lane]) continue;
            const uint place = c * node_stride + node[lane];
            nodes[place] = first_layer ? light[lane] : nodes[place] + light[lane];
        }
        lane_float behind = before;
        if (VXL_ABSORBS) behind *= LANES_LOAD(transmittance, c * stride + first);
        LANES_STORE(behind * opacity, node_weights, c * stride + first);
        on.throughput[c] = behind * left;
    }
    on.clear = LANES_SELECT(hit, clear * left, clear);
    if (coverage != 0) {
        float covered[VXL_LANES];
        LANES_STORE(1.0f - on.clear, covered, 0);
        for (int lane = 0; lane < VXL_LANES; ++lane)
            if (add[lane]) coverage[node[lane]] = covered[lane];
    }
    const lane_int through = hit & LANE_MASK(left > 0.0f);
    on.weight = path_float(paths, VXL_PATH_WEIGHT, stride, first);
    const lane_int goes_on = through & LANE_MASK(on.weight * largest(on.throughput) >= min_weight);
    count_lanes(through & ~goes_on, counters + VXL_COUNT_ENDED);
    if (!lanes_any(goes_on)) return;

    on.origin = load_vector(rays, stride, first);
    on.direction = load_vector(rays + VXL_RAY_DX * stride, stride, first);
    on.t_end = LANES_LOAD(rays, VXL_RAY_END * stride + first);
    on.start = LANES_AS_FLOAT(LANES_LOAD(hits, VXL_HIT_T * stride + first));
    on.source = (lane_uint)VXL_NO_PRIMITIVE;
    if (VXL_EXACT) on.source = LANES_LOAD(hits, VXL_HIT_PRIMITIVE * stride + first);
    if (VXL_INSTANCES) on.instance = LANES_LOAD(hits, VXL_HIT_INSTANCE * stride + first);
    on.flags = LANES_SELECT(leaving, (lane_uint)0, (lane_uint)VXL_PATH_WITHIN_SOURCE) |
               (VXL_PATH_ON_SURFACE | VXL_PATH_GOES_ON);
    on.cell_xy = LANES_LOAD(hits, VXL_HIT_CELL * stride + first);
    on.cell_z = LANES_LOAD(hits, VXL_HIT_FACE * stride + first);
    on.target = target;
    on.media = cross_counted(load_medium_set(paths, stride, first, valid), packed,
                             is_smooth(packed, on.source), leaving, goes_on, medium_overflows);
    if (VXL_CUBE_BODIES) on.flags |= joined_flag(&on.media, materials);
    on.medium = medium_inside(&on.media, ranks);
    const RayQueue queue = {next_rays, next_paths, next_starts, next_inside, next_stride};
    const Slots slots = reserve_slots(goes_on, counters + VXL_COUNT_LAYER);
    put_rays(&queue, &on, &slots);
}

/// The rays of one sort that leave a packet of surface points, and where they are put.
typedef struct {
    lane_float returned;  // of their light that the surface returns
    lane_int wanted;
} Scattered;

/// A ray from a surface point along `direction` in metres, on the `side` that a vector points to.
static inline void set_out_child(NewRays* r, PyramidShape shape, Vector position, Vector side,
                                 Vector direction) {
    const lane_float x = direction.x * shape.inverse_edge.x;
    const lane_float y = direction.y * shape.inverse_edge.y;
    const lane_float z = direction.z * shape.inverse_edge.z;
    const lane_float scale = power_of_two_scale(x, y, z);
    r->direction.x = snap_direction(x * scale);
    r->direction.y = snap_direction(y * scale);
    r->direction.z = snap_direction(z * scale);
    const float one = shape.fixed_point;
    r->origin.x = clamp(snap_position(position.x, side.x, one), 0.0f, (float)shape.size_x);
    r->origin.y = clamp(snap_position(position.y, side.y, one), 0.0f, (float)shape.size_y);
    r->origin.z = clamp(snap_position(position.z, side.z, one), 0.0f, (float)shape.size_z);
    r->t_end = (lane_float)INFINITY;
}

/// Puts the wanted lanes of `r` into the queue of children and notes where, for gather_light.
/// Without compaction every entry has its place, and those not wanted hold idle rays.
static inline void put_children(const RayQueue* queue, NewRays* r, Scattered s, lane_int valid,
                                uint compact, uint place, global uint* counters,
                                global uint* restrict children,
                                global float* restrict child_weights) {
    Slots slots;
    lane_uint at;
    if (compact) {
        slots = reserve_slots(s.wanted, counters + VXL_COUNT_CHILDREN);
        at = slots.first + lanes_ranks(s.wanted);
    } else {
        slots = slots_from(place, valid);
        at = place + LANES_AS_UINT(LANES_NUMBERS);
        r->t_end = LANES_SELECT(s.wanted, r->t_end, (lane_float)-1.0f);
    }
    if (VXL_TRANSMISSION) r->target = at;
    if (slots.count > 0) put_rays(queue, r, &slots);
    LANES_STORE(LANES_SELECT(s.wanted, at, (lane_uint)VXL_NO_CHILD), children, 0);
    LANES_STORE(s.returned, child_weights, 0);
}

/// Sends reflected and refracted rays from entries begin .. end-1. `children` and `child_weights`
/// hold, for each entry, the node and share of its reflected light, then (`stride` later) of its
/// refracted.
kernel void scatter_rays(PyramidShape shape, global const float* restrict materials,
                         global const uint* restrict ranks, global uint* medium_overflows,
                         float min_weight, uint compact, global const float* restrict rays,
                         global const uint* restrict hits, global const float* restrict positions,
                         global const float* restrict normals,
                         global const uint* restrict hit_attributes,
                         global const uint* restrict sides,
                         global const float* restrict transmittance,
                         global const float* restrict node_weights,
                         global const uint* restrict paths, uint begin, uint end, uint stride,
                         global uint* restrict children, global float* restrict child_weights,
                         global uint* restrict counters, global float* restrict child_rays,
                         global uint* restrict child_paths, global float* restrict child_starts,
                         global uint* restrict child_inside, uint child_stride) {
    const uint first = begin + work_item() * VXL_LANES;
    if (first >= end) return;
    const lane_int valid = below(first, end);
    const lane_uint number = LANES_LOAD(hits, VXL_HIT_VOXEL * stride + first);
    const lane_uint side = LANES_LOAD(sides, first);
    const lane_int hit =
        LANE_MASK(number != VXL_NO_VOXEL) & valid & LANE_MASK((side & VXL_SIDE_HIDDEN) == 0u);
    const lane_int leaving = LANE_MASK((side & VXL_SIDE_LEAVING) != 0u);
    const lane_uint packed = LANES_LOAD(hit_attributes, first);
    const lane_uint material = material_offset(packed) & LANES_AS_UINT(hit);
    const lane_float zero = (lane_float)0.0f, one = (lane_float)1.0f;
    Scattered reflected, refracted;
    reflected.returned =
        LANES_SELECT(hit, LANES_GATHER_FLOAT(materials, material + VXL_MATERIAL_REFLECTION), zero);
    refracted.returned = zero;
    if (VXL_TRANSMISSION)
        refracted.returned = LANES_SELECT(
            hit, LANES_GATHER_FLOAT(materials, material + VXL_MATERIAL_REFRACTION), zero);

    NewRays ray;
    ray.source = (lane_uint)VXL_NO_PRIMITIVE;
    if (VXL_EXACT) ray.source = LANES_LOAD(hits, VXL_HIT_PRIMITIVE * stride + first);
    if (VXL_INSTANCES) ray.instance = LANES_LOAD(hits, VXL_HIT_INSTANCE * stride + first);
    ray.clear = ray.throughput[0] = ray.throughput[1] = ray.throughput[2] = one;
    ray.start = zero;
    ray.cell_xy = ray.cell_z = (lane_uint)0;
    ray.media = empty_medium_set();
    if (VXL_TRANSMISSION) ray.media = load_medium_set(paths, stride, first, valid);

    // Directions in metres' space: v along the ray, n against it.
    const float4 edge = shape.edge;
    const Vector d = load_vector(rays + VXL_RAY_DX * stride, stride, first);
    const Vector metric = {d.x * edge.x, d.y * edge.y, d.z * edge.z};
    const Vector v = unit(metric);
    const Vector n = load_vector(normals, stride, first);
    const Vector position = load_vector(positions, stride, first);
    const lane_float cosine = clamp(-dot_product(v, n), 0.0f, 1.0f);

    // Who leaves a transmitting object that the set doesn't hold began inside of it.
    MediumSet behind = ray.media;
    lane_int open = (lane_int)0;
    if (VXL_TRANSMISSION) {
        const lane_int body = is_smooth(packed, ray.source);
        open = hit & transmits(materials, material,
                               LANES_GATHER_FLOAT(materials, material + VXL_MATERIAL_OPACITY));
        const lane_int began = open & leaving & ~medium_set_holds(&ray.media, packed, body);
        ray.media = cross_counted(ray.media, packed, body, (lane_int)0, began, medium_overflows);
        behind = cross_counted(ray.media, packed, body, leaving, open, medium_overflows);
    }
    lane_float eta = one;
    Refraction bend = {(lane_int)0, cosine, zero, one};
    if (VXL_REFRACTS) {
        const lane_uint from = medium_inside(&ray.media, ranks);
        lane_uint to = medium_inside(&behind, ranks);
        to = LANES_SELECT(open, to, ((packed >> VXL_MATERIAL_SHIFT) & VXL_MATERIAL_MASK) + 1u);
        eta = exact_divide(medium_ior(materials, from),
                           medium_ior(materials, to & LANES_AS_UINT(hit)));
        bend = refraction_at(eta, cosine);
        const lane_int fresnel =
            LANE_MASK(LANES_GATHER_FLOAT(materials, material + VXL_MATERIAL_FRESNEL) != 0.0f);
        const lane_int total = bend.total & LANE_MASK(refracted.returned > 0.0f);
        const lane_float all = reflected.returned + refracted.returned;
        reflected.returned = LANES_SELECT(fresnel, reflected.returned * bend.reflected,
                                          LANES_SELECT(total, all, reflected.returned));
        refracted.returned = LANES_SELECT(
            bend.total, zero,
            LANES_SELECT(fresnel, refracted.returned * bend.refracted, refracted.returned));
    }

    lane_float node_weight[3] = {one, one, one};
    for (uint c = 0; c < 3; ++c) {
        if (VXL_TRANSMISSION)
            node_weight[c] = LANES_LOAD(node_weights, c * stride + first);
        else if (VXL_ABSORBS)
            node_weight[c] = LANES_LOAD(transmittance, c * stride + first);
    }
    const lane_float weight =
        path_float(paths, VXL_PATH_WEIGHT, stride, first) * largest(node_weight);
    const lane_int mirror = LANE_MASK(reflected.returned > 0.0f) & hit;
    const lane_int glass = LANE_MASK(refracted.returned > 0.0f) & hit;
    reflected.wanted = mirror & LANE_MASK(weight * reflected.returned >= min_weight);
    refracted.wanted = glass & LANE_MASK(weight * refracted.returned >= min_weight);
    count_lanes(mirror & ~reflected.wanted, counters + VXL_COUNT_ENDED);
    if (VXL_REFRACTS) count_lanes(glass & ~refracted.wanted, counters + VXL_COUNT_ENDED);

    const RayQueue queue = {child_rays, child_paths, child_starts, child_inside, child_stride};
    ray.weight = weight * reflected.returned;
    ray.flags = LANES_SELECT(leaving, (lane_uint)VXL_PATH_WITHIN_SOURCE, (lane_uint)0) |
                VXL_PATH_ON_SURFACE;
    ray.medium = (lane_uint)0;
    if (VXL_TRANSMISSION) ray.medium = medium_inside(&ray.media, ranks);
    lane_int cube = (lane_int)0;  // a cube's side towards its inside: rays begin in a known cell
    const lane_uint face = LANES_LOAD(hits, VXL_HIT_FACE * stride + first);
    if (VXL_CUBE_BODIES) {
        cube = is_cube(packed, ray.source);
        ray.flags |= joined_flag(&ray.media, materials) |
                     (LANES_AS_UINT(cube & leaving) & VXL_PATH_FROM_CELL);
        ray.cell_xy = LANES_LOAD(hits, VXL_HIT_CELL * stride + first);
        ray.cell_z = face & 0xFFFFu;
    }
    const lane_float twice = 2.0f * cosine;
    const Vector mirrored = {fma(twice, n.x, v.x), fma(twice, n.y, v.y), fma(twice, n.z, v.z)};
    set_out_child(&ray, shape, offset_origin(shape, position, n, hits, stride, first), n, mirrored);
    put_children(&queue, &ray, reflected, valid, compact, first - begin, counters, children + first,
                 child_weights + first);
    if (!VXL_REFRACTS) return;

    ray.weight = weight * refracted.returned;
    ray.flags = LANES_SELECT(leaving, (lane_uint)0, (lane_uint)VXL_PATH_WITHIN_SOURCE) |
                VXL_PATH_ON_SURFACE;
    ray.media = behind;
    ray.medium = medium_inside(&behind, ranks);
    const Vector bent = refracted_direction(v, n, eta, cosine, &bend);
    const Vector into = {-n.x, -n.y, -n.z};
    set_out_child(&ray, shape, offset_origin(shape, position, into, hits, stride, first), into,
                  bent);
    // Between equal media the very same ray goes on.
    const lane_int same = LANE_MASK(eta == 1.0f);
    ray.origin = select_vector(same, load_vector(rays, stride, first), ray.origin);
    ray.direction = select_vector(same, d, ray.direction);
    ray.t_end = LANES_SELECT(same, LANES_LOAD(rays, VXL_RAY_END * stride + first), ray.t_end);
    ray.start =
        LANES_SELECT(same, LANES_AS_FLOAT(LANES_LOAD(hits, VXL_HIT_T * stride + first)), zero);
    ray.flags |= LANES_AS_UINT(same) & VXL_PATH_GOES_ON;
    if (VXL_CUBE_BODIES)
        ray.flags |=
            joined_flag(&ray.media, materials) | (LANES_AS_UINT(cube) & VXL_PATH_FROM_CELL);
    ray.cell_xy = LANES_LOAD(hits, VXL_HIT_CELL * stride + first);
    ray.cell_z = face;
    put_children(&queue, &ray, refracted, valid, compact, end - begin + (first - begin), counters,
                 children + stride + first, child_weights + stride + first);
}

/// Adds to each node what its entry's children brought; one work-item is one entry.
kernel void gather_light(uint begin, uint end, uint stride, global const uint* restrict children,
                         global const float* restrict child_weights,
                         global const float* restrict node_weights,
                         global const float* restrict transmittance,
                         global const uint* restrict paths,
                         global const float* restrict child_nodes, uint child_stride,
                         global float* restrict nodes, uint node_stride) {
    const uint entry = begin + work_item();
    if (entry >= end) return;
    const uint reflected = children[entry];
    const uint refracted = VXL_REFRACTS ? children[stride + entry] : VXL_NO_CHILD;
    if ((reflected == VXL_NO_CHILD) & (refracted == VXL_NO_CHILD)) return;
    const uint node = VXL_TRANSMISSION ? paths[VXL_PATH_TARGET * stride + entry] : entry;
    for (uint c = 0; c < 3; ++c) {
        float light = 0.0f;
        if (reflected != VXL_NO_CHILD)
            light = child_weights[entry] * child_nodes[c * child_stride + reflected];
        if (refracted != VXL_NO_CHILD)
            light += child_weights[stride + entry] * child_nodes[c * child_stride + refracted];
        float node_weight = 1.0f;
        if (VXL_TRANSMISSION)
            node_weight = node_weights[c * stride + entry];
        else if (VXL_ABSORBS)
            node_weight = transmittance[c * stride + entry];
        nodes[c * node_stride + node] += node_weight * light;
    }
}
