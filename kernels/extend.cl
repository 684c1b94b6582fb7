// SPDX-License-Identifier: Apache-2.0
// surface points of light paths -> the light that they add, and the next rays of the paths.
//
// Global light: an unbiased estimate of the light along each sight ray (Kajiya 1986). Lights are
// sampled at every surface that a path meets; the sky and the background are what its rays run
// into. Emission is found in both ways, which share it: lib/light/emission_share.h.
#include "lib/lanes/vector.h"
#include "lib/lanes/work_item.h"
#include "lib/light/child_rays.h"
#include "lib/light/directions.h"
#include "lib/light/emitters.h"
#include "lib/light/layer.h"
#include "lib/light/path_samples.h"
#include "lib/light/paths.h"

/// The parts of the light that a packet's surfaces return from each way on.
typedef struct {
    lane_float diffuse[3];
    lane_float reflected, refracted;
    lane_float straight;  // past the surface, which covers only a part
} Lobes;

/// The ways that the paths go on, as masks, and what their light is multiplied by.
typedef struct {
    lane_int diffuse, reflected, refracted, straight;
    lane_float throughput[3];
    lane_float clear;   // in proportion to the straight way's throughput
    lane_float chance;  // of the diffuse way
} Choice;

/// Adds the light at the paths' surfaces to the light of their sight rays, whose sums the first
/// surfaces begin. Multiplies `throughput` by what the medium and objects on the way let through.
static inline void add_path_light(const RayBatch* batch, uint first, lane_int valid, uint is_first,
                                  const NodeLight* nodes, lane_uint target,
                                  lane_float* throughput) {
    const uint stride = batch->stride;
    int add[VXL_LANES];
    uint node[VXL_LANES];
    LANES_STORE(valid, add, 0);
    LANES_STORE(target, node, 0);
    for (uint c = 0; c < 3; ++c) {
        float light[VXL_LANES];
        LANES_STORE(throughput[c] * LANES_LOAD(batch->radiance, c * stride + first), light, 0);
        for (int lane = 0; lane < VXL_LANES; ++lane) {
            if (!add[lane]) continue;
            global float* sum = nodes->radiance + c * nodes->stride + node[lane];
            *sum = is_first ? light[lane] : *sum + light[lane];
        }
        if (VXL_ABSORBS) throughput[c] *= LANES_LOAD(batch->transmittance, c * stride + first);
    }
}

/// Notes how much of what lies behind the paths' first surfaces these cover: all, unless a path has
/// left the world on a straight way.
static inline void note_coverage(const NodeLight* nodes, lane_int valid, lane_int met,
                                 lane_uint target, lane_float clear) {
    int add[VXL_LANES];
    uint node[VXL_LANES];
    float covered[VXL_LANES];
    LANES_STORE(valid, add, 0);
    LANES_STORE(target, node, 0);
    LANES_STORE(LANES_SELECT(met, (lane_float)1.0f, 1.0f - clear), covered, 0);
    for (int lane = 0; lane < VXL_LANES; ++lane)
        if (add[lane]) nodes->coverage[node[lane]] = covered[lane];
}

/// What the surfaces return. Those that a path meets after its last scattering only let it pass.
static inline Lobes lobes_of(const Surroundings* around, global const uint* restrict colors,
                             const RayBatch* batch, uint first, ScatterPoint* p,
                             const lane_float opacity, lane_int scatters) {
    const lane_float zero = (lane_float)0.0f;
    global const float* materials = around->materials;
    Scattered reflected, refracted;
    scatter_light(around, p, &reflected, &refracted);
    const lane_uint number = LANES_LOAD(batch->hits, VXL_HIT_VOXEL * batch->stride + first);
    const lane_uint voxel = number & LANES_AS_UINT(p->hit);
    const lane_uint color =
        color_offset(materials, p->material, p->position.x, p->position.y, p->position.z);
    const lane_float covered = LANES_SELECT(p->hit & scatters, opacity, zero);
    const lane_float diffuse =
        covered * LANES_GATHER_FLOAT(materials, p->material + VXL_MATERIAL_DIFFUSE);
    Lobes l;
    for (int c = 0; c < 3; ++c)
        l.diffuse[c] = diffuse * surface_color(materials, color, colors, voxel, c);
    l.reflected = covered * reflected.returned;
    l.refracted = covered * refracted.returned;
    l.straight = zero;
    return l;
}

/// Chooses a way for each path with a probability in proportion to what comes from it. `roulette`
/// is the mask of paths that may end, the more probably the less light they can still bring.
static inline Choice choose_way(const Lobes* l, const lane_float* throughput, SquarePoint p,
                                lane_int roulette) {
    const lane_float zero = (lane_float)0.0f, one = (lane_float)1.0f;
    const lane_float diffuse = largest(l->diffuse);
    const lane_float to_reflected = diffuse + l->reflected;
    const lane_float to_refracted = to_reflected + l->refracted;
    const lane_float all = to_refracted + l->straight, at = p.x * all;
    Choice c;
    c.diffuse = LANE_MASK(at < diffuse);
    c.reflected = LANE_MASK(at < to_reflected) & ~c.diffuse & LANE_MASK(l->reflected > 0.0f);
    c.refracted = LANE_MASK(at < to_refracted) & LANE_MASK(at >= to_reflected) &
                  LANE_MASK(l->refracted > 0.0f);
    c.straight = LANE_MASK(at >= to_refracted) & LANE_MASK(l->straight > 0.0f);
    c.clear = all;
    const lane_float per_diffuse =
        exact_divide(all, LANES_SELECT(LANE_MASK(diffuse > 0.0f), diffuse, one));
    c.chance = exact_divide(diffuse, LANES_SELECT(LANE_MASK(all > 0.0f), all, one));
    for (int i = 0; i < 3; ++i)
        c.throughput[i] = throughput[i] * LANES_SELECT(c.diffuse, l->diffuse[i] * per_diffuse, all);
    const lane_float brings = largest(c.throughput);
    const lane_int ends = roulette & ~c.straight & LANE_MASK(brings < 1.0f);
    const lane_int stays = LANE_MASK(p.y < brings) | ~ends;
    c.diffuse &= stays, c.reflected &= stays, c.refracted &= stays;
    const lane_int some = ends & LANE_MASK(brings > 0.0f);
    const lane_float scale =
        LANES_SELECT(some, exact_reciprocal(LANES_SELECT(some, brings, one)), one);
    for (int i = 0; i < 3; ++i) c.throughput[i] *= scale;
    const lane_int lives = LANE_MASK(brings > zero);
    c.diffuse &= lives, c.reflected &= lives, c.refracted &= lives, c.straight &= lives;
    return c;
}

/// Directions and sides of the rays that leave surfaces: where matt ones scatter light by `at`,
/// where mirrors reflect and glass refracts it.
static inline void set_out_ways(PyramidShape shape, const ScatterPoint* p, const RayBatch* batch,
                                uint first, const Choice* way, SquarePoint at, NewRays* r) {
    Vector side = p->normal;
    Vector ahead = mirrored_direction(p);
    if (lanes_any(way->diffuse)) {
        Vector normal = p->normal;
        if (VXL_SHADING_NORMALS) normal = load_vector(batch->shading, batch->stride, first);
        Vector scattered = cosine_direction(normal, at);
        if (VXL_SHADING_NORMALS)
            scattered = select_vector(
                p->curved, keep_on_side(scattered, p->normal, (lane_float)(1.0f / 4096.0f)),
                scattered);
        ahead = select_vector(way->diffuse, scattered, ahead);
    }
    if (VXL_REFRACTS) {
        const Vector into = opposite(p->normal);
        ahead = select_vector(way->refracted, bent_direction(p, into), ahead);
        side = select_vector(way->refracted, into, side);
    }
    set_out_child(r, shape,
                  offset_origin(shape, p->position, side, batch->hits, batch->stride, first), side,
                  ahead);
}

/// Completes rays of scenes with transmitting objects: which of these the rays are inside of, and
/// those that go on along the ray that met the surface.
static inline void enter_media(PyramidShape shape, const Surroundings* around,
                               const ScatterPoint* p, const RayBatch* batch, uint first,
                               const Choice* way, NewRays* r) {
    global const uint* hits = batch->hits;
    const uint stride = batch->stride;
    const lane_int across = way->refracted | way->straight;
    const lane_int of_instance = are_of_instances(batch, first);
    const lane_int same =
        way->straight | (way->refracted & LANE_MASK(p->eta == 1.0f) & ~of_instance);
    MediumSet passed = load_medium_set(batch->paths, stride, first, p->valid);
    passed = cross_counted(passed, p->packed, p->leaving, way->straight, around->medium_overflows);
    for (int i = 0; i < VXL_MEDIUM_SET_SIZE; ++i) {
        lane_uint member = LANES_SELECT(way->refracted, p->behind.members[i], p->before.members[i]);
        r->media.members[i] = LANES_SELECT(way->straight, passed.members[i], member);
    }
    r->medium = medium_inside(&r->media, around->ranks);
    r->flags |= LANES_AS_UINT(same) & VXL_PATH_GOES_ON;
    r->origin = select_vector(same, load_vector(batch->rays, stride, first), r->origin);
    r->direction = select_vector(
        same, load_vector(batch->rays + VXL_RAY_DX * stride, stride, first), r->direction);
    r->t_end = LANES_SELECT(same, LANES_LOAD(batch->rays, VXL_RAY_END * stride + first), r->t_end);
    r->start = LANES_SELECT(same, LANES_AS_FLOAT(LANES_LOAD(hits, VXL_HIT_T * stride + first)),
                            (lane_float)0.0f);
    r->cell_xy = LANES_LOAD(hits, VXL_HIT_CELL * stride + first);
    const lane_uint face = LANES_LOAD(hits, VXL_HIT_FACE * stride + first);
    r->cell_z = LANES_SELECT(across, face, face & 0xFFFFu);
    begin_behind(shape, batch, first, way->straight & of_instance, r);
    if (!VXL_CUBE_BODIES) return;
    const lane_int in_cell = way->refracted | (p->leaving & ~across);
    r->flags |= joined_flag(&r->media, around->materials) |
                (LANES_AS_UINT(is_cube(p->packed, p->primitive) & in_cell) & VXL_PATH_FROM_CELL);
}

/// The rays that go on along the chosen ways.
static inline NewRays next_rays_of(PyramidShape shape, const Surroundings* around,
                                   const ScatterPoint* p, const RayBatch* batch, uint first,
                                   const Choice* way, SquarePoint at) {
    NewRays r = begin_node(p, batch, first);
    const lane_int within = p->leaving ^ (way->refracted | way->straight);
    r.flags = VXL_PATH_ON_SURFACE | (LANES_AS_UINT(within) & VXL_PATH_WITHIN_SOURCE);
    r.medium = (lane_uint)0;
    set_out_ways(shape, p, batch, first, way, at, &r);
    if (VXL_TRANSMISSION) enter_media(shape, around, p, batch, first, way, &r);
    for (int c = 0; c < 3; ++c) r.throughput[c] = way->throughput[c];
    return r;
}

/// The queue for rays to emitters, which `bind` of a RayQueue sets as it does VXL_QUEUE_PARAMETERS.
#define VXL_EMITTER_QUEUE_PARAMETERS                                    \
    global float *restrict sent_rays, global uint *restrict sent_paths, \
        global float *restrict sent_starts, global uint *restrict sent_inside, uint sent_stride

/// The cosine of directions from surfaces, of which mask `above` tells those on the surfaces' side.
static inline lane_float cosine_at(const ScatterPoint* p, const RayBatch* batch, uint first,
                                   Vector direction, lane_int* above) {
    Vector normal = p->normal;
    if (VXL_SHADING_NORMALS) normal = load_vector(batch->shading, batch->stride, first);
    const lane_float cosine = dot_product(normal, direction);
    *above = LANE_MASK(cosine > 0.0f) & LANE_MASK(dot_product(p->normal, direction) > 0.0f);
    return fmax(cosine, 0.0f);
}

/// Sends a ray from each matt surface to an emitter. Its throughput is that of the path for light
/// from there, times the share of what the path may run into itself.
static inline void look_for_emitters(PyramidShape shape, const Surroundings* around,
                                     const ScatterPoint* p, const RayBatch* batch, uint first,
                                     const Lobes* lobes, const lane_float* throughput,
                                     lane_float chance, const PathSamples* samples,
                                     const Emitters* emitters, lane_int* wanted, NewRays* r) {
    const lane_float zero = (lane_float)0.0f, one = (lane_float)1.0f;
    const SquarePoint choice = path_point(samples, VXL_DECISION_EMITTER);
    const SquarePoint place = path_point(samples, VXL_DECISION_EMITTER_POINT);
    Choice way;
    way.diffuse = p->hit & LANE_MASK(largest(lobes->diffuse) > 0.0f);
    way.reflected = way.refracted = way.straight = (lane_int)0;
    for (int c = 0; c < 3; ++c) way.throughput[c] = zero;
    *r = next_rays_of(shape, around, p, batch, first, &way, place);
    const EmitterRays s = choose_emitter(emitters, r->origin, shape.edge, choice, place);
    lane_int above;
    const lane_float cosine = cosine_at(p, batch, first, s.direction, &above) * 0.318309886f;
    *wanted = way.diffuse & s.found & above;
    lane_float density = s.density;
    if (VXL_EMITTERS == VXL_EMITTERS_BOTH) density += chance * cosine;
    const lane_float weight = exact_divide(cosine, LANES_SELECT(*wanted, density, one));
    for (int c = 0; c < 3; ++c)
        r->throughput[c] = LANES_SELECT(*wanted, throughput[c] * lobes->diffuse[c] * weight, zero);
    const Vector ahead = select_vector(*wanted, s.direction, p->normal);
    set_out_child(r, shape,
                  offset_origin(shape, p->position, p->normal, batch->hits, batch->stride, first),
                  p->normal, ahead);
    r->emitter = s.number;
    r->clear = zero;
}

/// Adds the light at a packet's surfaces to the light of the sight rays that their paths began as,
/// and sends each path on along one way, unless it ends, and a ray to an emitter. `entries` of the
/// batch name their sight ray in VXL_PATH_TARGET, whose light is kept in the nodes; rays to
/// emitters may be entries, too.
kernel void extend_paths(PyramidShape shape, VXL_SURROUNDINGS_PARAMETERS,
                         global const uint* restrict colors, PathSampling sampling, uint is_first,
                         VXL_BATCH_PARAMETERS, uint count, VXL_NODE_PARAMETERS,
                         global uint* restrict counters, VXL_QUEUE_PARAMETERS,
                         VXL_EMITTER_PARAMETERS, VXL_EMITTER_QUEUE_PARAMETERS) {
    const uint first = work_item() * VXL_LANES;
    if (first >= count) return;
    const Surroundings around = VXL_SURROUNDINGS;
    const RayBatch batch = VXL_BATCH;
    const NodeLight nodes = VXL_NODES;
    const RayQueue queue = VXL_QUEUE;
    const lane_int valid = below(first, count);
    const lane_uint target = LANES_LOAD(paths, VXL_PATH_TARGET * stride + first);
    const lane_uint state = LANES_LOAD(paths, VXL_PATH_STATE * stride + first);
    lane_float throughput[3];
    for (uint c = 0; c < 3; ++c)
        throughput[c] = path_float(paths, VXL_PATH_THROUGHPUT + c, stride, first);
    add_path_light(&batch, first, valid, is_first, &nodes, target, throughput);

    const lane_uint bounces = (state >> VXL_STATE_BOUNCE_SHIFT) & VXL_STATE_BOUNCES;
    ScatterPoint p = load_point(&batch, shape.edge, first, count);
    lane_int met_any = p.hit;
    lane_float opacity = (lane_float)1.0f, clear = (lane_float)0.0f;
    if (VXL_TRANSMISSION) {
        const Layer layer = load_layer(&around, colors, &batch, first, count);
        opacity = layer.opacity;
        met_any = layer.hit;
        clear = path_float(paths, VXL_PATH_CLEAR, stride, first);
        if (nodes.coverage) note_coverage(&nodes, valid, met_any, target, clear);
    }
    Lobes lobes = lobes_of(&around, colors, &batch, first, &p, opacity,
                           LANE_MASK(bounces < sampling.bounces));
    if (VXL_TRANSMISSION) lobes.straight = LANES_SELECT(met_any, 1.0f - opacity, (lane_float)0.0f);
    const PathSamples samples = path_samples(&sampling, target, state);
    const Choice way = choose_way(&lobes, throughput, path_point(&samples, VXL_DECISION_LOBE),
                                  LANE_MASK(bounces >= VXL_ROULETTE_BOUNCES));

    const lane_uint met = min((state & VXL_STATE_MET) + 1u, (lane_uint)VXL_STATE_MET);
    if (VXL_EMITTERS && emitter_count && lanes_any(LANE_MASK(largest(lobes.diffuse) > 0.0f))) {
        const Emitters table = VXL_EMITTER_TABLE;
        const RayQueue sent = {sent_rays, sent_paths, sent_starts, sent_inside, sent_stride};
        lane_int wanted;
        NewRays ray;
        look_for_emitters(shape, &around, &p, &batch, first, &lobes, throughput, way.chance,
                          &samples, &table, &wanted, &ray);
        ray.target = target;
        ray.state = met | (sampling.bounces << VXL_STATE_BOUNCE_SHIFT) | VXL_STATE_DIFFUSE |
                    VXL_STATE_TO_EMITTER;
        const Slots slots = reserve_slots(wanted, counters + VXL_COUNT_TO_EMITTERS);
        put_rays(&sent, &ray, &slots);
    }

    const lane_int scattered = way.diffuse | way.reflected | way.refracted;
    const lane_int goes_on = scattered | way.straight;
    if (!lanes_any(goes_on)) return;
    NewRays ray = next_rays_of(shape, &around, &p, &batch, first, &way,
                               path_point(&samples, VXL_DECISION_DIRECTION));
    ray.target = target;
    ray.clear = LANES_SELECT(way.straight, clear * way.clear, (lane_float)0.0f);
    ray.state = met | ((bounces + 1u) << VXL_STATE_BOUNCE_SHIFT) |
                (LANES_AS_UINT(way.diffuse) & VXL_STATE_DIFFUSE);
    ray.state = LANES_SELECT(scattered, ray.state, met | (state & ~(lane_uint)VXL_STATE_MET));
    if (VXL_EMITTERS) {
        lane_int above;
        const Vector direction = unit(scaled(ray.direction, shape.edge));
        const lane_float density =
            cosine_at(&p, &batch, first, direction, &above) * 0.318309886f * way.chance;
        const lane_uint before = LANES_LOAD(paths, VXL_PATH_EMITTER * stride + first);
        const lane_uint now = LANES_SELECT(way.diffuse, LANES_AS_UINT(density), (lane_uint)0);
        ray.emitter = LANES_SELECT(scattered, now, before);
    }
    const Slots slots = reserve_slots(goes_on, counters + VXL_COUNT_CHILDREN);
    put_rays(&queue, &ray, &slots);
}
