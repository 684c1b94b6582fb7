// SPDX-License-Identifier: Apache-2.0
// Rays from surface points to emissive voxels: how they are chosen, and how probable each ray was.
//
// A ray goes to a point on the visible sides of the voxel's box, and counts if it meets the voxel's
// surfaces first. So whatever lies in the voxel, cubes, fields, triangles or solids, the
// probability of a direction is that of a point on a parallelogram.
#ifndef VXL_EMITTERS_H
#define VXL_EMITTERS_H

#include "lib/lanes/vector.h"
#include "lib/sampling/sobol.h"
#include "shared/emitters.h"
#include "shared/instance.h"

/// The parameters that `bind` of EmitterTable sets, in its order; there are none where paths look
/// for no emitters. A comma ends them.
#if VXL_EMITTERS
#define VXL_EMITTER_PARAMETERS                                                                  \
    uint emitter_count, global const float *restrict emitters, uint emitter_slots,              \
        global const uint *restrict emitter_table, global const float *restrict emitter_frames, \
        float emitter_volume,
#else
#define VXL_EMITTER_PARAMETERS
#endif

/// The emitters of a scene. Without instances there is no table of frames.
typedef struct {
    uint count;
    global const float* restrict records;
    uint slots;
    global const uint* restrict table;
    global const float* restrict frames;
    float volume;  // volume of the world's voxels, cubic metres
} Emitters;

/// The value of Emitters in a kernel with these parameters.
#if VXL_EMITTERS
#define VXL_EMITTER_TABLE \
    { emitter_count, emitters, emitter_slots, emitter_table, emitter_frames, emitter_volume }
#else
#define VXL_EMITTER_TABLE \
    { 0, 0, 0, 0, 0, 0.0f }
#endif

/// Emitters' boxes seen from points, in coordinates in which the box is the unit cube.
typedef struct {
    Vector at;      // the point
    Vector weight;  // weight of the side across each axis; 0: it isn't visible
    lane_uint frame;
    lane_float sum;  // of the weights
    lane_float probability;
    lane_float volume;
} BoxView;

/// A vector, mapped by the matrix at `first` of a frame.
static inline Vector framed(const Emitters* e, lane_uint frame, uint first, Vector v) {
    if (!VXL_INSTANCES) return v;
    lane_float m[9];
    for (uint i = 0; i < 9; ++i) m[i] = LANES_GATHER_FLOAT(e->frames, frame + first + i);
    const Vector result = {fma(m[0], v.x, fma(m[1], v.y, m[2] * v.z)),
                           fma(m[3], v.x, fma(m[4], v.y, m[5] * v.z)),
                           fma(m[6], v.x, fma(m[7], v.y, m[8] * v.z))};
    return result;
}

/// The weight of the visible side across an axis along which the point is `at`: the distance from
/// the box's middle, to which the solid angle of the side is proportional from far away.
static inline lane_float side_weight(lane_float at, lane_uint sides, uint low) {
    const lane_int below = LANE_MASK(at < 0.0f) & LANE_MASK((sides & low) != 0u);
    const lane_int above = LANE_MASK(at > 1.0f) & LANE_MASK((sides & (low << 1)) != 0u);
    return LANES_SELECT(below | above, fabs(at - 0.5f), (lane_float)0.0f);
}

/// The boxes of emitters `number`, seen from points in the world's voxels.
static inline BoxView view_box(const Emitters* e, lane_uint number, Vector from) {
    Vector point = from;
    const lane_uint r = number * (uint)VXL_EMITTER_WORDS;
    global const uint* words = (global const uint*)e->records;
    BoxView b;
    b.volume = (lane_float)e->volume;
    b.frame = (lane_uint)0;
    if (VXL_INSTANCES) {
        b.frame = (LANES_GATHER_UINT(words, r + VXL_EMITTER_INSTANCE) + 1u) * (uint)VXL_FRAME_WORDS;
        global const float* f = e->frames;
        point.x -= LANES_GATHER_FLOAT(f, b.frame + (uint)VXL_FRAME_CENTER);
        point.y -= LANES_GATHER_FLOAT(f, b.frame + (uint)(VXL_FRAME_CENTER + 1));
        point.z -= LANES_GATHER_FLOAT(f, b.frame + (uint)(VXL_FRAME_CENTER + 2));
        point = framed(e, b.frame, 0u, point);
        point.x += LANES_GATHER_FLOAT(f, b.frame + (uint)VXL_FRAME_IMAGE);
        point.y += LANES_GATHER_FLOAT(f, b.frame + (uint)(VXL_FRAME_IMAGE + 1));
        point.z += LANES_GATHER_FLOAT(f, b.frame + (uint)(VXL_FRAME_IMAGE + 2));
        b.volume = LANES_GATHER_FLOAT(f, b.frame + (uint)VXL_FRAME_VOLUME);
    }
    b.at.x = point.x - LANES_GATHER_FLOAT(e->records, r);
    b.at.y = point.y - LANES_GATHER_FLOAT(e->records, r + 1u);
    b.at.z = point.z - LANES_GATHER_FLOAT(e->records, r + 2u);
    const lane_uint sides = LANES_GATHER_UINT(words, r + (uint)VXL_EMITTER_SIDES);
    b.weight.x = side_weight(b.at.x, sides, 1u);
    b.weight.y = side_weight(b.at.y, sides, 4u);
    b.weight.z = side_weight(b.at.z, sides, 16u);
    b.sum = b.weight.x + b.weight.y + b.weight.z;
    b.probability = LANES_GATHER_FLOAT(e->records, r + (uint)VXL_EMITTER_PROBABILITY);
    return b;
}

/// The probability, per solid angle, of rays that pass a side of weight `weight` at t. Their ways
/// have the component `across` the side in the box's coordinates, and the length `metres`.
static inline lane_float side_density(const BoxView* b, lane_float weight, lane_float t,
                                      lane_float across, lane_float metres) {
    const lane_int some = LANE_MASK(weight > 0.0f) & LANE_MASK(across != 0.0f);
    const lane_float distance = t * metres;
    const lane_float area = LANES_SELECT(some, b->sum * b->volume * fabs(across), (lane_float)1.0f);
    const lane_float density =
        exact_divide(b->probability * weight * (distance * distance * metres), area);
    return LANES_SELECT(some, density, (lane_float)0.0f);
}

/// The t at which a way enters the space between an axis' two planes; 0 if it doesn't enter it from
/// outside.
static inline lane_float entry_of(lane_float at, lane_float along) {
    const lane_float out = LANES_SELECT(LANE_MASK(at > 1.0f), 1.0f - at, -at);
    const lane_int outside = LANE_MASK(at < 0.0f) | LANE_MASK(at > 1.0f);
    const lane_int comes = outside & LANE_MASK(out * along > 0.0f);
    const lane_float t = exact_divide(out, LANES_SELECT(comes, along, (lane_float)1.0f));
    return LANES_SELECT(comes, t, (lane_float)0.0f);
}

/// The probability, per solid angle, with which the points would have sent rays along `way` to the
/// emitters that rays have met. `way` is in the world's voxels and `metres` long.
static inline lane_float emitter_density(const Emitters* e, const BoxView* b, Vector way,
                                         lane_float metres) {
    const Vector along = framed(e, b->frame, 0u, way);
    const Vector t = {entry_of(b->at.x, along.x), entry_of(b->at.y, along.y),
                      entry_of(b->at.z, along.z)};
    const lane_float last = fmax(t.x, fmax(t.y, t.z));
    const lane_int x = LANE_MASK(t.x == last), y = LANE_MASK(t.y == last) & ~x;
    const lane_float weight =
        LANES_SELECT(x, b->weight.x, LANES_SELECT(y, b->weight.y, b->weight.z));
    const lane_float across = LANES_SELECT(x, along.x, LANES_SELECT(y, along.y, along.z));
    const lane_float density = side_density(b, weight, last, across, metres);
    return LANES_SELECT(LANE_MASK(last > 0.0f), density, (lane_float)0.0f);
}

/// Rays to emitters.
typedef struct {
    lane_int found;      // mask: the emitter has a side towards the point
    lane_uint number;    // of the emitter
    Vector direction;    // a unit vector in metres
    lane_float metres;   // how far away the farthest point of the emitter's box can be
    lane_float density;  // the probability of the direction, per solid angle
} EmitterRays;

/// Stretches a number x of [0, 1), which has decided for `yes` by being below `share`, to [0, 1)
/// again.
static inline lane_float spread_again(lane_float x, lane_float share, lane_int yes) {
    const lane_float low = LANES_SELECT(yes, (lane_float)0.0f, share);
    const lane_float width = LANES_SELECT(yes, share, 1.0f - share);
    const lane_float safe = LANES_SELECT(LANE_MASK(width > 0.0f), width, (lane_float)1.0f);
    return clamp(exact_divide(x - low, safe), 0.0f, 0.99999994f);
}

/// How far away the farthest points of boxes can be. `way`, in the world's voxels and `metres`
/// long, leads to a point of the box. No point of a box is farther from another than its diagonal,
/// and rays begin less than a voxel away from where they are aimed.
static inline lane_float farthest_point(const Emitters* e, const BoxView* b, Vector way,
                                        lane_float metres, lane_int found) {
    lane_float width = (lane_float)1.7320509f;
    if (VXL_INSTANCES) width = LANES_GATHER_FLOAT(e->frames, b->frame + (uint)VXL_FRAME_WIDTH);
    const lane_float voxels = exact_sqrt(dot_product(way, way));
    const lane_int some = found & LANE_MASK(voxels > 0.0f);
    const lane_float more =
        exact_divide(width + 2.0f, LANES_SELECT(some, voxels, (lane_float)1.0f));
    return fma(metres, more, metres);
}

/// Chooses an emitter by `choice`, and the point on its box's sides by `point`.
static inline EmitterRays choose_emitter(const Emitters* e, Vector origin, float4 edge,
                                         SquareBits choice, SquarePoint point) {
    const lane_float zero = (lane_float)0.0f, by_share = unit_interval(choice.y);
    const lane_uint slot = part_of(choice.x, e->count);
    const lane_uint r = slot * (uint)VXL_EMITTER_WORDS;
    const lane_float share = LANES_GATHER_FLOAT(e->records, r + (uint)VXL_EMITTER_SHARE);
    const lane_int own = LANE_MASK(by_share < share);
    global const uint* words = (global const uint*)e->records;
    EmitterRays s;
    s.number = LANES_SELECT(own, slot, LANES_GATHER_UINT(words, r + (uint)VXL_EMITTER_ALIAS));
    const BoxView b = view_box(e, s.number, origin);
    const lane_float side = spread_again(by_share, share, own) * b.sum;
    const lane_int x = LANE_MASK(side < b.weight.x);
    const lane_int y = LANE_MASK(side < b.weight.x + b.weight.y) & ~x;
    const lane_int z = ~(x | y);
    const Vector target = {
        LANES_SELECT(x, LANES_SELECT(LANE_MASK(b.at.x > 1.0f), (lane_float)1.0f, zero), point.x),
        LANES_SELECT(y, LANES_SELECT(LANE_MASK(b.at.y > 1.0f), (lane_float)1.0f, zero),
                     LANES_SELECT(x, point.x, point.y)),
        LANES_SELECT(z, LANES_SELECT(LANE_MASK(b.at.z > 1.0f), (lane_float)1.0f, zero), point.y)};
    const Vector along = {target.x - b.at.x, target.y - b.at.y, target.z - b.at.z};
    const lane_float weight = LANES_SELECT(x, b.weight.x, LANES_SELECT(y, b.weight.y, b.weight.z));
    const lane_float across = LANES_SELECT(x, along.x, LANES_SELECT(y, along.y, along.z));
    const Vector way = framed(e, b.frame, (uint)VXL_FRAME_BACK, along);
    const Vector metric = scaled(way, edge);
    const lane_float metres = exact_sqrt(dot_product(metric, metric));
    s.density = side_density(&b, weight, (lane_float)1.0f, across, metres);
    s.direction = unit(metric);
    s.found = LANE_MASK(s.density > 0.0f);
    s.metres = farthest_point(e, &b, way, metres, s.found);
    return s;
}

/// The emitters in these voxels of instances or the world; VXL_NO_EMITTER for other voxels.
static inline lane_uint emitter_at(const Emitters* e, lane_uint voxel, lane_uint instance,
                                   lane_int wanted) {
    global const uint* words = (global const uint*)e->records;
    uint voxels[VXL_LANES], instances[VXL_LANES], numbers[VXL_LANES];
    int wants[VXL_LANES];
    LANES_STORE(voxel, voxels, 0);
    LANES_STORE(instance, instances, 0);
    LANES_STORE(wanted, wants, 0);
    for (int lane = 0; lane < VXL_LANES; ++lane) {
        numbers[lane] = VXL_NO_EMITTER;
        if (!wants[lane]) continue;
        uint slot = emitter_hash(voxels[lane], instances[lane]) & (e->slots - 1u);
        for (uint number; (number = e->table[slot]) != VXL_NO_EMITTER;
             slot = (slot + 1u) & (e->slots - 1u)) {
            global const uint* record = words + (size_t)number * VXL_EMITTER_WORDS;
            if (record[VXL_EMITTER_VOXEL] != voxels[lane] ||
                record[VXL_EMITTER_INSTANCE] != instances[lane])
                continue;
            numbers[lane] = number;
            break;
        }
    }
    return LANES_LOAD(numbers, 0);
}

#endif
