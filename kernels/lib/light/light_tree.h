// SPDX-License-Identifier: Apache-2.0
// Surface points, or points and ways in a medium -> one of many lights each, and how probable that
// was, in proportion to how much light nodes of a tree may send there (Conty Estevez and Kulla
// 2018).
//
// All nodes of one level are compared, which loads each once for a whole packet. Below it, points
// go down node by node.
//
// Every light that may reach a point has a probability above 0 there: its nodes have weights above
// 0, and no share is smaller than chance can meet.
#ifndef VXL_LIGHT_TREE_H
#define VXL_LIGHT_TREE_H

#include "lib/light/area_points.h"
#include "lib/light/light_nodes.h"
#include "lib/light/lit_points.h"
#include "lib/light/path_samples.h"
#include "lib/light/receivers.h"
#include "shared/light_tree.h"

/// The part of the probability that all nodes that may bring light have alike. Without it a lamp
/// in the next room, which brings nothing, would hide a weaker one here from the points.
#define VXL_EVEN_SHARE 0.0625f

/// The smallest probability of one of two nodes that both may bring light, for the same reason.
#define VXL_LEAST_SHARE 0.03125f

/// The largest float below 1.
#define VXL_BELOW_ONE 0.99999994f

/// Lights that points have chosen.
typedef struct {
    lane_int found;  // mask: some light may reach the point
    lane_uint number;
    lane_float probability;
} ChosenLights;

/// Goes down from the nodes in `c` to lights.
static inline void descend(const LightTree* tree, const Receivers* p, lane_float next,
                           ChosenLights* c) {
    const lane_float one = (lane_float)1.0f;
    for (uint level = tree->compared; level < tree->levels && lanes_any(c->found); ++level) {
        const int are_lights = level + 1 == tree->levels;
        const lane_uint low = c->number * 2u;
        const Nodes first = gather_nodes(tree, low), second = gather_nodes(tree, low + 1u);
        Axes first_axes, second_axes;
        if (are_lights && tree->has_areas) {
            const lane_uint number = (low - (2u << level)) & LANES_AS_UINT(c->found);
            first_axes = gather_axes(tree, number);
            second_axes = gather_axes(tree, number + 1u);
        }
        const lane_float a = node_weight(tree, &first, p, are_lights, &first_axes);
        const lane_float b = node_weight(tree, &second, p, are_lights, &second_axes);
        c->found &= LANE_MASK(a + b > 0.0f);
        const lane_float part = exact_divide(a, LANES_SELECT(c->found, a + b, one));
        const lane_int both = LANE_MASK(a > 0.0f) & LANE_MASK(b > 0.0f);
        const lane_float share =
            LANES_SELECT(both, clamp(part, VXL_LEAST_SHARE, 1.0f - VXL_LEAST_SHARE), part);
        const lane_int high = LANE_MASK(next >= share);
        const lane_float taken =
            LANES_SELECT(c->found, LANES_SELECT(high, 1.0f - share, share), one);
        next = fmin(exact_divide(LANES_SELECT(high, next - share, next), taken), VXL_BELOW_ONE);
        c->probability *= taken;
        c->number = LANES_SELECT(c->found, low + (LANES_AS_UINT(high) & 1u), c->number);
    }
}

/// Compares the nodes of one level, and chooses one for each of the points `asked`, by `point`.
/// Sets `next` to a number below 1 by which points go on.
static inline ChosenLights choose_nodes(const LightTree* tree, const Receivers* p,
                                        SquarePoint point, lane_int asked, lane_float* next) {
    const lane_float zero = (lane_float)0.0f, one = (lane_float)1.0f;
    const uint nodes = 1u << tree->compared;
    const int are_lights = tree->compared == tree->levels;
    float weights[VXL_MOST_COMPARED_NODES * VXL_LANES];
    lane_float sum = zero, some = zero;
    for (uint i = 0; i < nodes; ++i) {
        const Nodes n = load_node(tree->nodes + (nodes + i) * VXL_NODE_WORDS);
        Axes axes;
        if (are_lights && tree->has_areas) axes = load_axes(tree, i);
        const lane_float weight = node_weight(tree, &n, p, are_lights, &axes);
        sum += weight;
        some += LANES_SELECT(LANE_MASK(weight > 0.0f), one, zero);
        LANES_STORE(weight, weights, i * VXL_LANES);
    }
    ChosenLights c = {asked & LANE_MASK(sum > 0.0f), (lane_uint)nodes, one};
    const lane_float even = exact_divide(VXL_EVEN_SHARE * sum, LANES_SELECT(c.found, some, one));
    const lane_float whole = LANES_SELECT(c.found, fma(even, some, sum), one);
    const lane_float wanted = point.x * whole;
    lane_float before = zero, taken = one;
    lane_int is_past = (lane_int)0;
    for (uint i = 0; i < nodes; ++i) {
        const lane_float weight = LANES_LOAD(weights, i * VXL_LANES);
        // Rounding may leave the last node's end below what is wanted; it is taken all the same.
        const lane_int here = LANE_MASK(weight > 0.0f) & ~is_past;
        taken = LANES_SELECT(here, weight + even, taken);
        c.number = LANES_SELECT(here, (lane_uint)(nodes + i), c.number);
        before = LANES_SELECT(here, before + taken, before);
        is_past |= here & LANE_MASK(before > wanted);
    }
    c.probability = exact_divide(LANES_SELECT(c.found, taken, one), whole);
    *next = point.y;
    return c;
}

/// Chooses a light for each of the points or ways `asked`, by a point of the unit square.
static inline ChosenLights choose_lights(const LightTree* tree, const Receivers* p,
                                         SquarePoint point, lane_int asked) {
    lane_float next;
    ChosenLights c = choose_nodes(tree, p, point, asked, &next);
    descend(tree, p, next, &c);
    c.number -= 1u << tree->levels;
    return c;
}

/// Chooses as a path decides at a point that light comes from.
static inline ChosenLights choose_by_path(const LightTree* tree, const Receivers* p,
                                          const PathSamples* samples, lane_int asked) {
    const uint decision = tree->has_areas ? VXL_DECISION_AREA_CHOICE : VXL_DECISION_CHOICE;
    return choose_lights(tree, p, path_point(samples, decision), asked);
}

/// The chosen lights, as strong as their probability makes them, and their middles. Those that are
/// dark no longer count as found.
static inline Light chosen_light(const LightTree* tree, ChosenLights* chosen, Vector* position) {
    const lane_uint word = (chosen->number & LANES_AS_UINT(chosen->found)) * (uint)VXL_LIGHT_WORDS;
    global const float* lights = tree->lights;
    *position = gather_vector(lights, word + (uint)VXL_LIGHT_POSITION);
    const Vector intensity = gather_vector(lights, word + (uint)VXL_LIGHT_INTENSITY);
    const lane_float scale = exact_reciprocal(chosen->probability);
    Light light;
    light.kind = tree->has_areas ? VXL_LIGHT_AREA_SAMPLE : VXL_LIGHT_SPOT;
    light.direction = gather_vector(lights, word + (uint)VXL_LIGHT_DIRECTION);
    light.inner_cosine = LANES_GATHER_FLOAT(lights, word + (uint)VXL_LIGHT_INNER_COSINE);
    light.outer_cosine = LANES_GATHER_FLOAT(lights, word + (uint)VXL_LIGHT_OUTER_COSINE);
    light.spread = (lane_float)0.0f;
    light.intensity[0] = intensity.x * scale;
    light.intensity[1] = intensity.y * scale;
    light.intensity[2] = intensity.z * scale;
    chosen->found &= LANE_MASK(intensity.x + intensity.y + intensity.z > 0.0f);
    return light;
}

/// The points of chosen lights with these middles that the paths' samples choose, in voxels.
static inline Vector chosen_points(const LightTree* tree, const ChosenLights* chosen, Vector middle,
                                   const PathSamples* samples) {
    if (!tree->has_areas) return middle;
    const lane_uint word = (chosen->number & LANES_AS_UINT(chosen->found)) * (uint)VXL_AREA_WORDS;
    global const float* areas = tree->areas;
    SquarePoint p = path_point(samples, VXL_DECISION_AREA_POINT);
    const SquarePoint round = disk_point(p);
    const lane_int is_round =
        LANE_MASK(LANES_GATHER_FLOAT(areas, word + (uint)VXL_AREA_IS_ROUND) != 0.0f);
    p.x = LANES_SELECT(is_round, round.x, fma(p.x, 2.0f, -1.0f));
    p.y = LANES_SELECT(is_round, round.y, fma(p.y, 2.0f, -1.0f));
    return point_of_area(p, middle, gather_vector(areas, word + (uint)VXL_AREA_AXIS_X),
                         gather_vector(areas, word + (uint)VXL_AREA_AXIS_Y));
}

/// The areas of chosen lights, in square metres; 0 for points.
static inline lane_float chosen_areas(const LightTree* tree, const ChosenLights* chosen) {
    if (!tree->has_areas) return (lane_float)0.0f;
    const lane_uint word = (chosen->number & LANES_AS_UINT(chosen->found)) * (uint)VXL_AREA_WORDS;
    return LANES_GATHER_FLOAT(tree->areas, word + (uint)VXL_AREA_SIZE);
}

#endif
