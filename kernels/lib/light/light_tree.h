// SPDX-License-Identifier: Apache-2.0
// Surface points, or points and ways in a medium -> one of many lights each, and how probable that
// was, in proportion to how much light nodes of a tree may send there (Conty Estevez and Kulla
// 2018).
//
// All nodes of one level are compared, which loads each once for a whole packet. Below it, points
// go down node by node.
//
// Every light that may reach a point has a probability above 0 there: bounds are loosened by more
// than rounding, which takes some 5e-4 off a cosine, and no share is smaller than chance can meet.
#ifndef VXL_LIGHT_TREE_H
#define VXL_LIGHT_TREE_H

#include "lib/light/lit_points.h"
#include "lib/light/path_samples.h"
#include "lib/light/receivers.h"
#include "shared/light_tree.h"

/// By how much bounds of cosines are loosened.
#define VXL_COSINE_SLACK 1e-3f

/// The part of the probability that all nodes that may bring light have alike. Without it a lamp
/// in the next room, which brings nothing, would hide a weaker one here from the points.
#define VXL_EVEN_SHARE 0.0625f

/// The smallest probability of one of two nodes that both may bring light, for the same reason.
#define VXL_LEAST_SHARE 0.03125f

/// The largest float below 1.
#define VXL_BELOW_ONE 0.99999994f

/// The parameters that `bind` of LightTree sets, in its order.
#define VXL_LIGHT_TREE_PARAMETERS                                                      \
    global const float *restrict tree_lights, global const float *restrict tree_nodes, \
        uint tree_levels, uint tree_compared

/// Lights, each of them a point or a spot, and the tree above them. Lights are numbered as the
/// nodes of the last level, which is `levels` below the root.
typedef struct {
    global const float* restrict lights;
    global const float* restrict nodes;
    uint levels;
    uint compared;  // the level whose nodes are compared
} LightTree;

/// The value of a LightTree in a kernel with these parameters.
#define VXL_LIGHT_TREE \
    { tree_lights, tree_nodes, tree_levels, tree_compared }

/// Nodes of the tree, one for each lane.
typedef struct {
    Vector middle, axis;
    lane_float radius, cosine, power;
} Nodes;

/// Three words of a table, from `word` on.
static inline Vector gather_vector(global const float* table, lane_uint word) {
    const Vector v = {LANES_GATHER_FLOAT(table, word), LANES_GATHER_FLOAT(table, word + 1u),
                      LANES_GATHER_FLOAT(table, word + 2u)};
    return v;
}

static inline Nodes gather_nodes(const LightTree* tree, lane_uint node) {
    const lane_uint word = node * (uint)VXL_NODE_WORDS;
    global const float* nodes = tree->nodes;
    const Nodes n = {gather_vector(nodes, word), gather_vector(nodes, word + (uint)VXL_NODE_AXIS),
                     LANES_GATHER_FLOAT(nodes, word + (uint)VXL_NODE_RADIUS),
                     LANES_GATHER_FLOAT(nodes, word + (uint)VXL_NODE_COSINE),
                     LANES_GATHER_FLOAT(nodes, word + (uint)VXL_NODE_POWER)};
    return n;
}

/// Repeats a node in all lanes.
static inline Nodes load_node(global const float* w) {
    const Nodes n = {{(lane_float)w[0], (lane_float)w[1], (lane_float)w[2]},
                     {(lane_float)w[VXL_NODE_AXIS], (lane_float)w[VXL_NODE_AXIS + 1],
                      (lane_float)w[VXL_NODE_AXIS + 2]},
                     (lane_float)w[VXL_NODE_RADIUS],
                     (lane_float)w[VXL_NODE_COSINE],
                     (lane_float)w[VXL_NODE_POWER]};
    return n;
}

/// A weight for the light that nodes may send to the points or ways: 0 if it is none. `are_lights`:
/// the nodes are single lights.
static inline lane_float node_weight(const Nodes* n, const Receivers* p, int are_lights) {
    const lane_float one = (lane_float)1.0f;
    const Vector to = scaled(difference(n->middle, p->at), p->edge);
    const lane_float distance = dot_product(to, to);  // squared
    // Nearer than a thousandth of a voxel's edge, a direction says nothing. This only shifts
    // chances.
    const float least =
        1e-6f * fmin(p->edge.x * p->edge.x, fmin(p->edge.y * p->edge.y, p->edge.z * p->edge.z));
    if (p->kind == VXL_RECEIVES_ON_WAY) return n->power * light_along_way(p, to, n->radius, least);
    lane_int outside = LANE_MASK(distance > least);
    if (!are_lights) outside &= LANE_MASK(distance > n->radius * n->radius);
    const lane_float inverse = exact_reciprocal(exact_sqrt(LANES_SELECT(outside, distance, one)));
    const Vector l = {to.x * inverse, to.y * inverse, to.z * inverse};
    lane_float facing = dot_product(p->normal, l);
    lane_float ball_cosine = one, ball_sine = (lane_float)0.0f;
    lane_float leaving = -dot_product(n->axis, l);
    lane_float near = distance;
    if (!are_lights) {
        // The ball is seen under this angle around its middle.
        ball_sine = fmin(n->radius * inverse, 1.0f);
        ball_cosine = exact_sqrt(fmax(fma(-ball_sine, ball_sine, 1.0f), 0.0f));
        facing = cosine_of_less(facing, ball_cosine, ball_sine);
        leaving = cosine_of_less(leaving, ball_cosine, ball_sine);
        near = fmax(distance, n->radius * n->radius);
    }
    const lane_int reaches =
        LANE_MASK(facing > -VXL_COSINE_SLACK) & LANE_MASK(leaving > n->cosine - VXL_COSINE_SLACK);
    lane_float returned;
    if (p->kind == VXL_RECEIVES_IN_MEDIUM)
        returned = scattered_light(p, l, ball_cosine, ball_sine);
    else
        returned = returned_light(p, l, facing, ball_sine * ball_sine);
    returned = LANES_SELECT(outside, returned, one);
    return LANES_SELECT(reaches | ~outside, exact_divide(n->power * returned, fmax(near, least)),
                        (lane_float)0.0f);
}

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
        const lane_float a = node_weight(&first, p, are_lights);
        const lane_float b = node_weight(&second, p, are_lights);
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
    float weights[VXL_MOST_COMPARED_NODES * VXL_LANES];
    lane_float sum = zero, some = zero;
    for (uint i = 0; i < nodes; ++i) {
        const Nodes n = load_node(tree->nodes + (nodes + i) * VXL_NODE_WORDS);
        const lane_float weight = node_weight(&n, p, tree->compared == tree->levels);
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

/// The chosen lights, as strong as their probability makes them. Those that are dark no longer
/// count as found.
static inline Light chosen_light(const LightTree* tree, ChosenLights* chosen, Vector* position) {
    const lane_uint word = (chosen->number & LANES_AS_UINT(chosen->found)) * (uint)VXL_LIGHT_WORDS;
    global const float* lights = tree->lights;
    *position = gather_vector(lights, word + (uint)VXL_LIGHT_POSITION);
    const Vector intensity = gather_vector(lights, word + (uint)VXL_LIGHT_INTENSITY);
    const lane_float scale = exact_reciprocal(chosen->probability);
    Light light;
    light.kind = VXL_LIGHT_SPOT;
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

#endif
