// SPDX-License-Identifier: Apache-2.0
// Surface points -> one of many lights each, and how probable that was, in proportion to how
// much light nodes of a tree may send to the point (Conty Estevez and Kulla 2018).
//
// All nodes of one level are compared, which loads each once for a whole packet. Below it, points
// go down node by node.
//
// Every light that may reach a point has a probability above 0 there: bounds are loosened by more
// than rounding.
#ifndef VXL_LIGHT_TREE_H
#define VXL_LIGHT_TREE_H

#include "lib/light/lit_points.h"
#include "lib/light/path_samples.h"
#include "shared/light_tree.h"

/// By how much bounds of cosines are loosened, and the smallest one that counts.
#define VXL_COSINE_SLACK 1e-3f
#define VXL_LEAST_COSINE 0.02f

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

/// The same node in all lanes.
static inline Nodes load_node(global const float* w) {
    const Nodes n = {{(lane_float)w[0], (lane_float)w[1], (lane_float)w[2]},
                     {(lane_float)w[VXL_NODE_AXIS], (lane_float)w[VXL_NODE_AXIS + 1],
                      (lane_float)w[VXL_NODE_AXIS + 2]},
                     (lane_float)w[VXL_NODE_RADIUS],
                     (lane_float)w[VXL_NODE_COSINE],
                     (lane_float)w[VXL_NODE_POWER]};
    return n;
}

/// The cosine of an angle less another one of at most 90 degrees, but at most 1.
static inline lane_float cosine_of_less(lane_float cosine, lane_float less_cosine,
                                        lane_float less_sine) {
    const lane_float sine = exact_sqrt(fmax(fma(-cosine, cosine, 1.0f), 0.0f));
    return LANES_SELECT(LANE_MASK(cosine >= less_cosine), (lane_float)1.0f,
                        fma(cosine, less_cosine, sine * less_sine));
}

/// A highlight: of how much light it returns at most, for white matt surfaces' 1, and the square of
/// its width, GGX's alpha.
typedef struct {
    lane_float strength, width;
} Highlight;

/// The points from which light is chosen, in voxels, and what they return roughly.
typedef struct {
    Vector at, normal;
    float4 edge;
    Vector out;         // the unit vector to the viewer
    lane_float cosine;  // between the normal and `out`
    lane_float matt;    // what they return evenly
    Highlight own, coat;
} Receivers;

static inline lane_float squared(lane_float x) {
    return x * x;
}

/// The highlight of facets with GGX's `width` that reflect `reflectance` straight on.
static inline Highlight facet_highlight(lane_float reflectance, lane_float width,
                                        lane_float cosine) {
    const lane_float aside = 1.0f - cosine, fourth = squared(squared(aside));
    const lane_float reflected = fma(fourth * aside, 1.0f - reflectance, reflectance);
    const lane_float square = fmax(width * width, 1e-6f);
    const Highlight h = {exact_divide(0.25f * reflected, square), square};
    return h;
}

/// What surfaces of the points' materials return, without textures' maps.
static inline Receivers receivers_of(global const float* restrict materials, const LitPoints* p,
                                     float4 edge, Vector way) {
    const lane_float one = (lane_float)1.0f, zero = (lane_float)0.0f;
    Receivers r = {
        p->position, p->shading_normal, edge,       opposite(unit(scaled(way, edge))), zero,
        one,         {zero, one},       {zero, one}};
    r.cosine = clamp(dot_product(r.normal, r.out), 0.0f, 1.0f);
    const lane_uint m = p->material & LANES_AS_UINT(p->lit);
    const lane_float shininess = LANES_GATHER_FLOAT(materials, m + VXL_MATERIAL_SHININESS);
    r.own.strength = LANES_GATHER_FLOAT(materials, m + VXL_MATERIAL_SPECULAR);
    r.own.width = exact_divide((lane_float)2.0f, fmax(shininess, 0.0f) + 2.0f);
    if (!VXL_PHYSICAL) return r;
    const lane_float width = LANES_GATHER_FLOAT(materials, m + VXL_MATERIAL_WIDTH);
    const lane_float metallic = LANES_GATHER_FLOAT(materials, m + VXL_MATERIAL_METALLIC);
    const lane_float reflectance = LANES_GATHER_FLOAT(materials, m + VXL_MATERIAL_REFLECTANCE);
    const lane_int is = LANE_MASK(width > 0.0f);
    const Highlight facets =
        facet_highlight(fma(metallic, one - reflectance, reflectance), width, r.cosine);
    r.own.strength = LANES_SELECT(is, facets.strength, r.own.strength);
    r.own.width = LANES_SELECT(is, facets.width, r.own.width);
    r.matt = LANES_SELECT(is, fmax(one - metallic, 0.05f), one);
    if (!VXL_COAT) return r;
    const lane_uint block =
        LANES_UINT(LANES_GATHER_FLOAT(materials, m + VXL_MATERIAL_COAT)) & LANES_AS_UINT(is);
    const lane_int coated = LANE_MASK(block > 0u);
    const lane_float share = LANES_GATHER_FLOAT(materials, block + VXL_COAT_SHARE);
    r.coat = facet_highlight((lane_float)VXL_COAT_REFLECTANCE,
                             LANES_GATHER_FLOAT(materials, block + VXL_COAT_WIDTH), r.cosine);
    r.coat.strength = LANES_SELECT(coated, share * r.coat.strength, zero);
    r.coat.width = LANES_SELECT(coated, r.coat.width, one);
    return r;
}

/// The strength of a highlight where the half vector has this squared cosine with the normal. The
/// light comes from all over a ball that is seen under an angle with this squared sine.
static inline lane_float highlight_at(const Highlight* h, lane_float half_cosine,
                                      lane_float ball_sine) {
    const lane_float width = fmin(h->width + ball_sine, 1.0f);
    const lane_float lobe = exact_divide(width, fma(half_cosine, width - 1.0f, 1.0f));
    return h->strength * exact_divide(h->width, width) * (lobe * lobe);
}

/// What the points return of light that comes along `l`, a unit vector with the cosine `facing`.
static inline lane_float returned_light(const Receivers* p, Vector l, lane_float facing,
                                        lane_float ball_sine) {
    const lane_float between = dot_product(l, p->out);
    const lane_float length = fmax(fma(2.0f, between, 2.0f), 1e-6f);
    const lane_float half_cosine = fmin(exact_divide(squared(facing + p->cosine), length), 1.0f);
    lane_float light =
        fma(p->matt, fmax(facing, VXL_LEAST_COSINE), highlight_at(&p->own, half_cosine, ball_sine));
    if (VXL_COAT) light += highlight_at(&p->coat, half_cosine, ball_sine);
    return light;
}

/// A weight for the light that nodes may send to the points: 0 if it is none. `are_lights`: the
/// nodes are single lights.
static inline lane_float node_weight(const Nodes* n, const Receivers* p, int are_lights) {
    const lane_float one = (lane_float)1.0f;
    const Vector to = scaled(difference(n->middle, p->at), p->edge);
    const lane_float distance = dot_product(to, to);  // squared
    lane_int outside = LANE_MASK(distance > 1e-12f);
    if (!are_lights) outside &= LANE_MASK(distance > n->radius * n->radius);
    const lane_float inverse = exact_reciprocal(exact_sqrt(LANES_SELECT(outside, distance, one)));
    const Vector l = {to.x * inverse, to.y * inverse, to.z * inverse};
    lane_float facing = dot_product(p->normal, l), ball_sine = (lane_float)0.0f;
    lane_float leaving = -dot_product(n->axis, l);
    lane_float near = distance;
    if (!are_lights) {
        // The ball is seen under this angle around its middle.
        const lane_float sine = fmin(n->radius * inverse, 1.0f);
        const lane_float cosine = exact_sqrt(fmax(fma(-sine, sine, 1.0f), 0.0f));
        facing = cosine_of_less(facing, cosine, sine);
        leaving = cosine_of_less(leaving, cosine, sine);
        near = fmax(distance, n->radius * n->radius);
        ball_sine = sine * sine;
    }
    const lane_int reaches =
        LANE_MASK(facing > -VXL_COSINE_SLACK) & LANE_MASK(leaving > n->cosine - VXL_COSINE_SLACK);
    const lane_float returned = LANES_SELECT(outside, returned_light(p, l, facing, ball_sine), one);
    return LANES_SELECT(reaches | ~outside, exact_divide(n->power * returned, fmax(near, 1e-12f)),
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
        const lane_float share = exact_divide(a, LANES_SELECT(c->found, a + b, one));
        const lane_int high = LANE_MASK(next >= share);
        const lane_float taken =
            LANES_SELECT(c->found, LANES_SELECT(high, 1.0f - share, share), one);
        next = fmin(exact_divide(LANES_SELECT(high, next - share, next), taken), VXL_BELOW_ONE);
        c->probability *= taken;
        c->number = LANES_SELECT(c->found, low + (LANES_AS_UINT(high) & 1u), c->number);
    }
}

/// Chooses a light for each of the points `asked`.
static inline ChosenLights choose_lights(const LightTree* tree, const Receivers* p,
                                         const PathSamples* samples, lane_int asked) {
    const lane_float zero = (lane_float)0.0f, one = (lane_float)1.0f;
    const uint nodes = 1u << tree->compared;
    // [i]: the weights of the nodes up to number i, added
    float sums[VXL_MOST_COMPARED_NODES * VXL_LANES];
    lane_float sum = zero;
    for (uint i = 0; i < nodes; ++i) {
        const Nodes n = load_node(tree->nodes + (nodes + i) * VXL_NODE_WORDS);
        sum += node_weight(&n, p, tree->compared == tree->levels);
        LANES_STORE(sum, sums, i * VXL_LANES);
    }
    ChosenLights c = {asked & LANE_MASK(sum > 0.0f), (lane_uint)nodes, one};
    const lane_float whole = LANES_SELECT(c.found, sum, one);
    const SquarePoint point = path_point(samples, VXL_DECISION_CHOICE);
    // It stays below the sum, so that some node is found.
    const lane_float wanted = fmin(point.x, VXL_BELOW_ONE) * whole;
    lane_float before = zero, with = zero;
    lane_int is_found = (lane_int)0;
    for (uint i = 0; i < nodes; ++i) {
        const lane_float here = LANES_LOAD(sums, i * VXL_LANES);
        const lane_int is_here = LANE_MASK(here > wanted) & ~is_found;
        before = LANES_SELECT(is_found | is_here, before, here);
        with = LANES_SELECT(is_here, here, with);
        c.number = LANES_SELECT(is_here, (lane_uint)(nodes + i), c.number);
        is_found |= is_here;
    }
    c.found &= is_found;
    c.probability = exact_divide(LANES_SELECT(c.found, with - before, one), whole);
    descend(tree, p, point.y, &c);
    c.number -= 1u << tree->levels;
    return c;
}

/// The chosen lights, as strong as their probability makes them.
static inline Light chosen_light(const LightTree* tree, const ChosenLights* chosen,
                                 Vector* position) {
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
    return light;
}

#endif
