// SPDX-License-Identifier: Apache-2.0
// The point of a smooth object's mesh that is closest to a hit on the object, and its triangle.
//
// A packet searches the tree of one object at a time, nearer boxes first. Boxes are larger than
// rounding moves points, so what is left out cannot be closest: the point that is found doesn't
// depend on the packet's other rays.
#ifndef VXL_SOURCE_MESH_H
#define VXL_SOURCE_MESH_H

#include "lib/surface/shading_normal.h"
#include "shared/instance.h"
#include "shared/source_mesh.h"
#include "shared/texture.h"
#include "shared/trace.h"

/// All meshes, and the records of all objects.
typedef struct {
    global const SourceRecord* objects;
    global const uint* words;
} SourceMeshes;

// Computed squares of equal distances differ by less than this factor, which is 256 roundings.
#define VXL_SQUARE_ROUNDING 0x1.0001p0f

/// The square of the distance from a point to the closest point of a triangle, and the weights of
/// the corners there. `from` is the point relative to each corner.
static inline lane_float closest_on_triangle(const Vector* from, lane_float* weight) {
    const Vector ab = difference(from[0], from[1]), ac = difference(from[0], from[2]);
    const Vector n = cross_of(ab, ac);
    const lane_float zero = (lane_float)0.0f, one = (lane_float)1.0f;
    lane_int above = (lane_int)-1;  // mask: above the triangle, not beside one of its edges
    for (int i = 0; i < 3; ++i) {
        weight[i] = dot_product(cross_of(from[(i + 1) % 3], from[(i + 2) % 3]), n);
        above &= LANE_MASK(weight[i] >= 0.0f);
    }
    const lane_float sum = weight[0] + weight[1] + weight[2];
    above &= LANE_MASK(sum > 0.0f);
    const lane_float inverse = exact_reciprocal(LANES_SELECT(above, sum, one));
    Vector off = {zero, zero, zero};
    for (int i = 0; i < 3; ++i) {
        weight[i] *= inverse;
        off = add_scaled(off, from[i], weight[i]);
    }
    lane_float squared = LANES_SELECT(above, dot_product(off, off), (lane_float)INFINITY);
    if (!lanes_any(~above)) return squared;
    for (int i = 0; i < 3; ++i) {
        const int next = (i + 1) % 3;
        const Vector edge = difference(from[i], from[next]);
        const lane_float length = dot_product(edge, edge);
        const lane_int some = LANE_MASK(length > 0.0f);
        const lane_float along =
            exact_divide(dot_product(from[i], edge), LANES_SELECT(some, length, one));
        const lane_float t = LANES_SELECT(some, clamp(along, 0.0f, 1.0f), zero);
        const Vector away = add_scaled(from[i], edge, -t);
        const lane_float there = dot_product(away, away);
        const lane_int closer = LANE_MASK(there < squared);
        squared = LANES_SELECT(closer, there, squared);
        weight[i] = LANES_SELECT(closer, one - t, weight[i]);
        weight[next] = LANES_SELECT(closer, t, weight[next]);
        weight[3 - i - next] = LANES_SELECT(closer, zero, weight[3 - i - next]);
    }
    return squared;
}

/// The best result of a search so far: the square of the smallest distance, and the triangle at
/// that distance, VXL_NO_PRIMITIVE for none.
typedef struct {
    lane_float squared;
    lane_uint triangle;
} ClosestTriangle;

/// Replaces the closest triangle by one with these corners if that is closer, or as close with a
/// smaller number.
static inline void meet_triangle(global const float* corners, uint number, Vector p,
                                 lane_int active, ClosestTriangle* best) {
    global const float* c = corners + (size_t)number * VXL_SOURCE_CORNER_WORDS;
    Vector from[3];
    for (int i = 0; i < 3; ++i) {
        const Vector seen = {p.x - c[3 * i], p.y - c[3 * i + 1], p.z - c[3 * i + 2]};
        from[i] = seen;
    }
    lane_float weight[3];
    const lane_float squared = closest_on_triangle(from, weight);
    const lane_int closer =
        active & (LANE_MASK(squared < best->squared) |
                  (LANE_MASK(squared == best->squared) & LANE_MASK(number < best->triangle)));
    best->squared = LANES_SELECT(closer, squared, best->squared);
    best->triangle = LANES_SELECT(closer, (lane_uint)number, best->triangle);
}

/// A lower bound on the squared distances from points to the contents of a child's box.
static inline lane_float squared_to_box(global const InstanceNode* node, int child, Vector p) {
    global const float* low = node->low[child];
    global const float* high = node->high[child];
    const Vector away = {fmax(fmax(low[0] - p.x, p.x - high[0]), 0.0f),
                         fmax(fmax(low[1] - p.y, p.y - high[1]), 0.0f),
                         fmax(fmax(low[2] - p.z, p.z - high[2]), 0.0f)};
    return dot_product(away, away);
}

/// Mask: points for which something at this distance may replace the closest triangle.
static inline lane_int may_be_closer(lane_float squared, const ClosestTriangle* best) {
    return LANE_MASK(squared <= best->squared * VXL_SQUARE_ROUNDING);
}

/// Finds the triangles closest to the points of the `active` lanes, within best->squared.
static inline void search_tree(global const InstanceNode* tree, global const float* corners,
                               Vector p, lane_int active, ClosestTriangle* best) {
    uint nodes[VXL_INSTANCE_DEPTH];
    lane_int masks[VXL_INSTANCE_DEPTH];
    lane_float squares[VXL_INSTANCE_DEPTH];
    int waiting = 0;
    uint node = 0;
    while (true) {
        if (node & VXL_INSTANCE_LEAF) {
            meet_triangle(corners, node & ~VXL_INSTANCE_LEAF, p, active, best);
            active = (lane_int)0;
        } else {
            const lane_float to_a = squared_to_box(tree + node, 0, p);
            const lane_float to_b = squared_to_box(tree + node, 1, p);
            const lane_int a = active & may_be_closer(to_a, best);
            const lane_int b = active & may_be_closer(to_b, best);
            const lane_int b_first = b & (~a | LANE_MASK(to_b < to_a));
            const int swap = 2 * lanes_count(b_first) > lanes_count(a | b);
            nodes[waiting] = tree[node].child[swap ? 0 : 1];
            masks[waiting] = swap ? a : b;
            squares[waiting] = swap ? to_a : to_b;
            waiting += lanes_any(masks[waiting]) ? 1 : 0;
            node = tree[node].child[swap ? 1 : 0];
            active = swap ? b : a;
        }
        while (!lanes_any(active)) {
            if (waiting == 0) return;
            --waiting;
            node = nodes[waiting];
            active = masks[waiting] & may_be_closer(squares[waiting], best);
        }
    }
}

/// The triangles of meshes that are closest to points on smooth objects, and the parts of their
/// meshes' data that shading needs.
typedef struct {
    lane_int found;  // mask: there is one within reach
    lane_uint triangle;
    lane_uint worn, textures;  // where its record of what it wears begins, and its mesh's textures
    Vector from[3];            // the hit relative to the corners, in the mesh's space
    Vector sides[2];           // the given vectors, in the mesh's space
} SourceHit;

/// Converts a vector from the voxels of hits to the mesh's space.
static inline Vector in_mesh(global const SourceRecord* r, Vector v) {
    global const float* m = r->mesh_from_voxels;
    const Vector mapped = {fma(m[0], v.x, fma(m[1], v.y, m[2] * v.z)),
                           fma(m[4], v.x, fma(m[5], v.y, m[6] * v.z)),
                           fma(m[8], v.x, fma(m[9], v.y, m[10] * v.z))};
    return mapped;
}

/// Converts a point from the voxels of hits to the mesh's space.
static inline Vector point_in_mesh(global const SourceRecord* r, Vector v) {
    global const float* m = r->mesh_from_voxels;
    const Vector mapped = {fma(m[0], v.x, fma(m[1], v.y, fma(m[2], v.z, (lane_float)m[3]))),
                           fma(m[4], v.x, fma(m[5], v.y, fma(m[6], v.z, (lane_float)m[7]))),
                           fma(m[8], v.x, fma(m[9], v.y, fma(m[10], v.z, (lane_float)m[11])))};
    return mapped;
}

/// The closest triangle for each point `at` on the smooth objects with these numbers, in the lanes
/// that `ask`, if the object has a mesh. `sides` are two vectors in the voxels of the points.
static inline SourceHit closest_of_points(const SourceMeshes* sources, Vector at, lane_uint object,
                                          lane_int ask, const Vector* sides) {
    global const uint* words = sources->words;
    global const float* numbers = (global const float*)words;
    SourceHit s;
    s.found = (lane_int)0;
    s.triangle = s.worn = s.textures = (lane_uint)0u;
    for (int i = 0; i < 3; ++i) s.from[i] = at;
    for (int i = 0; i < 2; ++i) s.sides[i] = sides[i];
    lane_int left = ask;
    while (lanes_any(left)) {
        const uint one = lanes_min(LANES_SELECT(left, object, (lane_uint)0xFFFFFFFFu));
        const lane_int same = left & LANE_MASK(object == one);
        left &= ~same;
        global const SourceRecord* r = sources->objects + one;
        if (r->nodes == VXL_NO_SOURCE) continue;
        const Vector p = point_in_mesh(r, at);
        ClosestTriangle best = {(lane_float)(r->reach * r->reach), (lane_uint)VXL_NO_PRIMITIVE};
        search_tree((global const InstanceNode*)(words + r->nodes), numbers + r->triangles, p, same,
                    &best);
        const lane_int found = same & LANE_MASK(best.triangle != VXL_NO_PRIMITIVE);
        const lane_uint triangle = best.triangle & LANES_AS_UINT(found);
        const lane_uint corners = triangle * VXL_SOURCE_CORNER_WORDS + r->triangles;
        for (uint i = 0; i < 3; ++i) {
            const Vector corner = {LANES_GATHER_FLOAT(numbers, corners + 3u * i),
                                   LANES_GATHER_FLOAT(numbers, corners + (3u * i + 1u)),
                                   LANES_GATHER_FLOAT(numbers, corners + (3u * i + 2u))};
            s.from[i] = select_vector(found, difference(p, corner), s.from[i]);
        }
        for (int i = 0; i < 2; ++i)
            s.sides[i] = select_vector(found, in_mesh(r, sides[i]), s.sides[i]);
        s.triangle = LANES_SELECT(found, triangle, s.triangle);
        s.worn = LANES_SELECT(found, triangle * VXL_WORN_WORDS + r->worn, s.worn);
        s.textures = LANES_SELECT(found, (lane_uint)r->textures, s.textures);
        s.found |= found;
    }
    return s;
}

#endif
