// SPDX-License-Identifier: Apache-2.0
// How much light the nodes of a tree of lights may send to points, or to ways through a medium.
//
// Every light that may reach a point has a weight above 0 there: bounds are loosened by more than
// rounding, which takes some 5e-4 off a cosine.
#ifndef VXL_LIGHT_NODES_H
#define VXL_LIGHT_NODES_H

#include "lib/light/lit_points.h"
#include "lib/light/receivers.h"
#include "shared/light_tree.h"

/// By how much bounds of cosines are loosened.
#define VXL_COSINE_SLACK 1e-3f

/// The smallest cosine at a light with an area that weights count.
#define VXL_LEAST_EMITTING_COSINE 0.02f

/// The parameters that `bind` of LightTree sets, in its order.
#define VXL_LIGHT_TREE_PARAMETERS                                                      \
    global const float *restrict tree_lights, global const float *restrict tree_areas, \
        global const float *restrict tree_nodes, uint tree_levels, uint tree_compared, \
        uint tree_has_areas

/// Lights, each of them a point or a spot, or all of them with an area, and the tree above them.
/// Lights are numbered as the nodes of the last level, which is `levels` below the root.
typedef struct {
    global const float* restrict lights;
    global const float* restrict areas;
    global const float* restrict nodes;
    uint levels;
    uint compared;  // the level whose nodes are compared
    int has_areas;
} LightTree;

/// The value of a LightTree in a kernel with these parameters.
#define VXL_LIGHT_TREE                                                   \
    {                                                                    \
        tree_lights, tree_areas, tree_nodes, tree_levels, tree_compared, \
            VXL_CHOSEN_AREAS ? (int)tree_has_areas : 0                   \
    }

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

/// The largest cosine between a direction and the normals of nodes' lights with areas. The
/// direction has the cosine `leaving` with the nodes' axes.
static inline lane_float emitting_cosine(const Nodes* n, lane_float leaving) {
    const lane_float one = (lane_float)1.0f;
    // The angle within which normals are is 90 degrees less than that within which light leaves.
    const lane_float sine = clamp(-n->cosine, 0.0f, 1.0f);
    const lane_float cosine = exact_sqrt(fma(-sine, sine, one));
    return LANES_SELECT(LANE_MASK(n->cosine < -1.0f), one, cosine_of_less(leaving, cosine, sine));
}

/// The smallest squared distance that counts, in square metres: nearer than a thousandth of a
/// voxel's edge, a direction says nothing. This only shifts chances.
static inline float least_distance(float4 edge) {
    return 1e-6f * fmin(edge.x * edge.x, fmin(edge.y * edge.y, edge.z * edge.z));
}

/// The axes of single lights with an area, in voxels.
typedef struct {
    Vector x, y;
} Axes;

static inline Axes gather_axes(const LightTree* tree, lane_uint number) {
    const lane_uint word = number * (uint)VXL_AREA_WORDS;
    const Axes a = {gather_vector(tree->areas, word + (uint)VXL_AREA_AXIS_X),
                    gather_vector(tree->areas, word + (uint)VXL_AREA_AXIS_Y)};
    return a;
}

/// Repeats the axes of one light in all lanes.
static inline Axes load_axes(const LightTree* tree, uint number) {
    global const float* x = tree->areas + number * VXL_AREA_WORDS + VXL_AREA_AXIS_X;
    global const float* y = tree->areas + number * VXL_AREA_WORDS + VXL_AREA_AXIS_Y;
    const Axes a = {{(lane_float)x[0], (lane_float)x[1], (lane_float)x[2]},
                    {(lane_float)y[0], (lane_float)y[1], (lane_float)y[2]}};
    return a;
}

/// A weight for the light that single lights with an area send to surface points or to points in a
/// medium: 0 if these are behind the light, or it is behind the surface. The falloff is that of the
/// closest point of the light's rectangle, less steep within the rectangle's size.
static inline lane_float area_weight(const Nodes* n, const Axes* axes, const Receivers* p) {
    const lane_float one = (lane_float)1.0f;
    const float least = least_distance(p->edge);
    const Vector to = scaled(difference(n->middle, p->at), p->edge);
    const Vector x = scaled(axes->x, p->edge), y = scaled(axes->y, p->edge);
    const lane_float xx = fmax(dot_product(x, x), least), yy = fmax(dot_product(y, y), least);
    const lane_float along_x = clamp(exact_divide(-dot_product(to, x), xx), -1.0f, 1.0f);
    const lane_float along_y = clamp(exact_divide(-dot_product(to, y), yy), -1.0f, 1.0f);
    const Vector closest = add_scaled(add_scaled(to, x, along_x), y, along_y);
    const lane_float squared = fmax(dot_product(closest, closest), least);
    const lane_float inverse = exact_reciprocal(exact_sqrt(squared));
    const lane_float length = exact_sqrt(fmax(dot_product(to, to), least));
    const lane_float slack = VXL_COSINE_SLACK * (length + n->radius);
    const lane_float before = -dot_product(n->axis, to);
    lane_int reaches = LANE_MASK(before > -slack);
    const lane_float to_middle = exact_reciprocal(length);
    const Vector l = {to.x * to_middle, to.y * to_middle, to.z * to_middle};
    const lane_float ball_sine = fmin(n->radius * to_middle, 1.0f);
    lane_float returned;
    if (p->kind == VXL_RECEIVES_IN_MEDIUM) {
        const lane_float ball_cosine = exact_sqrt(fmax(fma(-ball_sine, ball_sine, one), 0.0f));
        returned = scattered_light(p, l, ball_cosine, ball_sine);
    } else {
        const lane_float middle_height = dot_product(p->normal, to);
        const lane_float highest =
            middle_height + fabs(dot_product(p->normal, x)) + fabs(dot_product(p->normal, y));
        reaches &= LANE_MASK(highest > -slack);
        const lane_float facing =
            fmax(middle_height * to_middle, dot_product(p->normal, closest) * inverse);
        const lane_float above = 0.5f * exact_divide(highest, length + n->radius);
        returned = returned_light(p, l, fmin(fmax(facing, above), one), ball_sine * ball_sine);
    }
    const lane_float emitted = clamp(before * inverse, VXL_LEAST_EMITTING_COSINE, 1.0f);
    const lane_float falloff = exact_sqrt(squared + xx) * exact_sqrt(squared + yy);
    return LANES_SELECT(reaches, exact_divide(n->power * returned * emitted, falloff),
                        (lane_float)0.0f);
}

/// A weight for the light that nodes may send to the points or ways: 0 if it is none. `are_lights`:
/// the nodes are single lights; if they have areas, these have the axes `axes`.
static inline lane_float node_weight(const LightTree* tree, const Nodes* n, const Receivers* p,
                                     int are_lights, const Axes* axes) {
    const int are_points = are_lights && !tree->has_areas;
    if (are_lights && tree->has_areas && p->kind != VXL_RECEIVES_ON_WAY)
        return area_weight(n, axes, p);
    const lane_float one = (lane_float)1.0f;
    const Vector to = scaled(difference(n->middle, p->at), p->edge);
    const lane_float distance = dot_product(to, to);  // squared
    const float least = least_distance(p->edge);
    if (p->kind == VXL_RECEIVES_ON_WAY) return n->power * light_along_way(p, to, n->radius, least);
    lane_int outside = LANE_MASK(distance > least);
    if (!are_points) outside &= LANE_MASK(distance > n->radius * n->radius);
    const lane_float inverse = exact_reciprocal(exact_sqrt(LANES_SELECT(outside, distance, one)));
    const Vector l = {to.x * inverse, to.y * inverse, to.z * inverse};
    lane_float facing = dot_product(p->normal, l);
    lane_float ball_cosine = one, ball_sine = (lane_float)0.0f;
    lane_float leaving = -dot_product(n->axis, l);
    lane_float near = distance;
    if (!are_points) {
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
    if (tree->has_areas) returned *= fmax(emitting_cosine(n, leaving), VXL_LEAST_EMITTING_COSINE);
    returned = LANES_SELECT(outside, returned, one);
    return LANES_SELECT(reaches | ~outside, exact_divide(n->power * returned, fmax(near, least)),
                        (lane_float)0.0f);
}

#endif
