// SPDX-License-Identifier: Apache-2.0
// The ways in which surfaces send light on, and how a path chooses one of them.
#ifndef VXL_LOBES_H
#define VXL_LOBES_H

#include "lib/light/paths.h"
#include "lib/light/physical.h"
#include "lib/light/scatter_point.h"
#include "lib/sampling/sobol.h"
#include "lib/surface/surface_color.h"

/// The share of light that a packet's surfaces return from each way.
typedef struct {
    lane_float diffuse[3];  // in all directions, and all that physically based surfaces return
    lane_float reflected, refracted;
    lane_float straight;  // past the surface, which covers only a part of what is behind
} Lobes;

/// The chosen ways as masks, and the factors of their light.
typedef struct {
    lane_int diffuse, reflected, refracted, straight;
    lane_float throughput[3];
    lane_float clear;   // factor of the straight way's uncovered part
    lane_float chance;  // probability of the diffuse way
} Choice;

/// The physically based surfaces among a packet's surfaces, as paths see them.
static inline PhysicalView view_of_paths(const Surroundings* around,
                                         global const uint* restrict colors, const RayBatch* batch,
                                         uint first, const ScatterPoint* p) {
    const lane_uint number = LANES_LOAD(batch->hits, VXL_HIT_VOXEL * batch->stride + first);
    const lane_uint color =
        color_offset(around->materials, p->material, p->position.x, p->position.y, p->position.z);
    const Colors own = colors_of_hits(colors, number & LANES_AS_UINT(p->hit), batch->paint, first);
    return view_physical(around->materials, p->hit, p->material, color, own, p->shading,
                         opposite(p->way), p->leaving);
}

/// The lobes of the surfaces. Surfaces that a path meets after its last scattering only let it
/// pass.
static inline Lobes lobes_of(const Surroundings* around, global const uint* restrict colors,
                             const RayBatch* batch, uint first, ScatterPoint* p,
                             const PhysicalView* view, const lane_float opacity,
                             lane_int scatters) {
    const lane_float zero = (lane_float)0.0f;
    global const float* materials = around->materials;
    Scattered reflected, refracted;
    scatter_light(around, p, &reflected, &refracted);
    const lane_uint number = LANES_LOAD(batch->hits, VXL_HIT_VOXEL * batch->stride + first);
    const Colors own = colors_of_hits(colors, number & LANES_AS_UINT(p->hit), batch->paint, first);
    const lane_uint color =
        color_offset(materials, p->material, p->position.x, p->position.y, p->position.z);
    const lane_float covered = LANES_SELECT(p->hit & scatters, opacity, zero);
    const lane_float diffuse =
        covered * LANES_GATHER_FLOAT(materials, p->material + VXL_MATERIAL_DIFFUSE);
    Lobes l;
    for (int c = 0; c < 3; ++c) l.diffuse[c] = diffuse * surface_color(materials, color, own, c);
    if (VXL_PHYSICAL)
        for (int c = 0; c < 3; ++c)
            l.diffuse[c] = LANES_SELECT(view->is, covered * view->albedo[c], l.diffuse[c]);
    l.reflected = covered * reflected.returned;
    l.refracted = covered * refracted.returned;
    if (VXL_ROUGH_GLASS) {
        l.reflected = LANES_SELECT(view->is, zero, l.reflected);
        l.refracted = LANES_SELECT(view->is, zero, l.refracted);
    }
    l.straight = zero;
    return l;
}

/// Chooses a way for each path with a probability proportional to the light from it. `roulette` is
/// the mask of paths that may end; they end the more probably, the less light they can still bring.
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
    const lane_float stay = chance_to_go_on(brings);
    const lane_int stays = LANE_MASK(p.y < stay) | ~ends;
    c.diffuse &= stays, c.reflected &= stays, c.refracted &= stays;
    const lane_int some = ends & LANE_MASK(brings > 0.0f);
    const lane_float scale =
        LANES_SELECT(some, exact_reciprocal(LANES_SELECT(some, stay, one)), one);
    for (int i = 0; i < 3; ++i) c.throughput[i] *= scale;
    const lane_int lives = LANE_MASK(brings > zero);
    c.diffuse &= lives, c.reflected &= lives, c.refracted &= lives, c.straight &= lives;
    return c;
}

#endif
