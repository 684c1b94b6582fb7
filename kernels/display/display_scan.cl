// SPDX-License-Identifier: Apache-2.0
// probe lines -> probe points: every crossing of the lines of a display's lattice with a surface.
//
// One work-item traces VXL_LANES lines through the world, and then through the voxels of each
// instance that they come to.
#include "lib/lanes/work_item.h"  // first, since it says how all of the code is compiled

#include "lib/display/crossings.h"
#include "lib/packets/instances.h"
#include "shared/display.h"
#include "shared/scene.h"

/// The number of each line's crossings, their coordinates and the surfaces that are crossed: the
/// parameters that `bind` of CrossingArrays sets, in its order.
#define VXL_CROSSINGS_PARAMETERS \
    global uint *restrict counts, global float *restrict crossings, global uint *restrict surfaces

/// Scans the `walking` lanes' voxels up to t_end. Lanes that reach an occupied voxel wait until no
/// lane is walking; then the surfaces in those voxels are crossed together. `beginning` lanes start
/// inside the voxels: if they start among cubes, they have not crossed a surface of them.
static inline void scan_way(const WorldView* world, const PyramidView* p, Walk* w, lane_float t_end,
                            lane_int walking, lane_int beginning, ScanResult* r) {
    lane_int in_cube = (lane_int)0;
    lane_uint row = (lane_uint)0u;  // the cube that the line is in
    while (lanes_any(walking)) {
        lane_int waiting = (lane_int)0;
        lane_uint leaf = (lane_uint)0u;
        while (lanes_any(walking)) {
            const CellState state = look_up(p, w->x, w->y, w->z, walking, &w->last);
            const lane_int arrived = state.occupied & walking;
            leaf = LANES_SELECT(arrived, state.leaf, leaf);
            waiting |= arrived;
            walking &= ~arrived;
            beginning &= ~walking;
            if (VXL_CUBES) {
                r->surface = row;
                if (!r->covers) keep_crossings(r, walking & in_cube, w->t, (lane_float)-1.0f);
                in_cube &= ~walking;
            }
            advance(p, w, state.log2_size, walking);
            walking &= in_grid(p, w) & LANE_MASK(w->t <= t_end);
        }
        const lane_int cubes = scan_voxels(world, p, w, leaf, waiting, r);
        if (VXL_CUBES) {
            r->surface = row = LANES_SELECT(cubes, r->surface, row);
            const lane_int counted = r->covers ? cubes : cubes ^ in_cube;
            keep_crossings(
                r, waiting & counted & ~(beginning & cubes), w->t,
                LANES_SELECT(cubes, (lane_float)(r->covers ? 2.0f : 1.0f), (lane_float)-1.0f));
            in_cube = LANES_SELECT(waiting, cubes, in_cube);
        }
        beginning &= ~waiting;
        walking = waiting;
        advance(p, w, (lane_int)0, walking);
        const lane_int going_on = LANE_MASK(w->t <= t_end);
        const lane_int inside = in_grid(p, w);
        if (VXL_CUBES && !r->covers)
            keep_crossings(r, walking & going_on & ~inside & in_cube, w->t, (lane_float)-1.0f);
        walking &= inside & going_on;
    }
}

/// Scans the voxels of instance `number` where the `active` lines pass through them before t_end.
static INLINED void scan_instance(const WorldView* world, uint number, lane_float inverse_squared,
                                  lane_float t_end, lane_int active, ScanResult* r) {
    global const InstanceRecord* record = world->instances.records + number;
    const lane_float zero = (lane_float)0.0f;
    const BoxPassage way = pass_box(record, r->origin, r->way, inverse_squared, zero);
    active &= way.met & LANE_MASK(way.base + way.from <= t_end);
    if (!lanes_any(active)) return;
    const TransformedRay c = transform_ray(record, &way);
    const PyramidView p = instance_pyramid(&world->pyramid, record);
    Walk w =
        begin_walk(c.origin.x, c.origin.y, c.origin.z, c.direction.x, c.direction.y, c.direction.z);
    w.axis = record->aligned ? (lane_int)3 : way.axis;
    if (record->aligned) enter_box(&p, record, zero, &w);
    r->into = c;
    r->instance = number;
    scan_way(world, &p, &w, transformed_t(&c, t_end), active & in_grid(&p, &w),
             LANE_MASK(w.axis == 3), r);
}

/// Scans the voxels of all instances that the `active` lines come to, in the order of their tree.
static INLINED void scan_instances(const WorldView* world, const Walk* line, lane_float t_end,
                                   lane_int active, ScanResult* r) {
    const InstanceView* v = &world->instances;
    const SlabRay slab = slab_ray(line);
    const lane_float inverse_squared = exact_reciprocal(dot_product(r->way, r->way));
    uint nodes[VXL_INSTANCE_DEPTH];
    lane_int masks[VXL_INSTANCE_DEPTH];
    int waiting = 0;
    nodes[waiting] = 0u, masks[waiting++] = active;
    while (waiting > 0) {
        const uint node = nodes[--waiting];
        active = masks[waiting];
        if (node & VXL_INSTANCE_LEAF) {
            scan_instance(world, node & ~VXL_INSTANCE_LEAF, inverse_squared, t_end, active, r);
            continue;
        }
        for (int child = 1; child >= 0; --child) {
            lane_float t;
            const lane_int met = meets_child(&slab, v->nodes + node, child, t_end, &t) & active;
            if (!lanes_any(met)) continue;
            nodes[waiting] = v->nodes[node].child[child], masks[waiting++] = met;
        }
    }
}

/// Finds the crossings of lines 0 .. count-1 with surfaces. `counts` gets the number of crossings,
/// and `crossings` the lattice coordinates along the line of the first `slots` of them,
/// `line_stride` apart: first those with the world's voxels, then those with each instance's, each
/// in their order along the line. Arrays hold a multiple of 16 lines.
///
/// With `covers`, a line crosses cubes where it enters each one, and the coordinates' lowest bits
/// are a VXL_CROSSES_*. Without, it crosses cubes where it enters or leaves a row of them. Where
/// light goes through surfaces, the lowest bits are a VXL_CROSSES_* in both cases, and `surfaces`
/// gets what is crossed, as packed attributes with VXL_LINE_CUBE.
kernel void scan_lines(VXL_WORLD_PARAMETERS, float4 row, global const float* restrict rays,
                       uint count, uint stride, uint slots, uint line_stride, uint covers,
                       VXL_CROSSINGS_PARAMETERS) {
    const uint first = work_item() * VXL_LANES;
    if (first >= count) return;
    const WorldView world = VXL_WORLD;
    const PyramidView p = world.pyramid;
    Walk w = load_walk(rays, stride, first);
    const Vector origin = {w.ox, w.oy, w.oz}, way = {w.dx, w.dy, w.dz};
    const lane_float zero = (lane_float)0.0f, one = (lane_float)1.0f;
    const TransformedRay same = {origin, way, zero, zero, one};
    ScanResult r = {row,      first,           line_stride,   slots,  crossings,
                    surfaces, covers,          (lane_uint)0u, origin, way,
                    same,     VXL_NO_INSTANCE, (lane_uint)0u};
    lane_float t_end = LANES_LOAD(rays, VXL_RAY_END * stride + first);
    // A line that enters the world has crossed the surface of cubes at its side.
    const lane_int comes_in =
        (LANE_MASK(w.ox == 0.0f) & w.px & w.mx) | (LANE_MASK(w.oy == 0.0f) & w.py & w.my) |
        (LANE_MASK(w.oz == 0.0f) & w.pz & w.mz) | (LANE_MASK(w.ox == (float)shape.size_x) & ~w.px) |
        (LANE_MASK(w.oy == (float)shape.size_y) & ~w.py) |
        (LANE_MASK(w.oz == (float)shape.size_z) & ~w.pz);
    const lane_int active = LANE_MASK(t_end >= 0.0f) & in_grid(&p, &w);
    const Walk line = w;
    scan_way(&world, &p, &w, t_end, active, ~comes_in, &r);
    if (VXL_INSTANCES && lanes_any(active)) {
        lane_float t_in = zero;  // beyond the world's bounds there is nothing
        clip_to_world(origin, way, p.size_x, p.size_y, p.size_z, &t_in, &t_end);
        scan_instances(&world, &line, t_end, active, &r);
    }
    LANES_STORE(r.count, counts, first);
}

/// Puts the crossings of lines 0 .. count-1 in order, and removes those that other objects hide;
/// see line_order.h. Every line has slots for all of its crossings.
kernel void order_lines(uint count, uint line_stride, global const uint* restrict ranks,
                        global const float* restrict opacities, VXL_CROSSINGS_PARAMETERS) {
    const uint n = work_item();
    if (n >= count) return;
    const LineCrossings line = {counts[n],    line_stride, crossings + n,
                                surfaces + n, ranks,       opacities};
    counts[n] = order_crossings(&line);
}

/// Packs the crossings of lines first_line .. first_line+count-1: those of line n begin at
/// starts[n]. In scenes with transmission `packed`, unless it is null, gets their surfaces.
kernel void pack_points(LineGrid lines, VXL_CROSSINGS_PARAMETERS,
                        global const uint* restrict starts, uint first_line, uint count,
                        uint stride, uint total, global float* restrict points,
                        global uint* restrict packed) {
    const uint n = work_item();
    if (n >= count) return;
    const uint tiles_x = (lines.columns + 3u) / 4u, tile = (first_line + n) / 16u;
    const uint column = tile % tiles_x * 4u + (n & 3u), row = tile / tiles_x * 4u + ((n >> 2) & 3u);
    const float a =
        exact_quotient((float)(lines.last_a - (int)column) + lines.offset_a, lines.parts_a);
    const float b =
        exact_quotient((float)(lines.last_b - (int)row) + lines.offset_b, lines.parts_b);
    const uint axis = (uint)lines.axis;
    for (uint i = 0; i < counts[n]; ++i) {
        const uint point = starts[n] + i;
        points[axis * total + point] = crossings[i * stride + n];
        points[(axis + 1u) % 3u * total + point] = a;
        points[(axis + 2u) % 3u * total + point] = b;
        if (VXL_TRANSMISSION && packed) packed[point] = surfaces[i * stride + n];
    }
}
