// SPDX-License-Identifier: Apache-2.0
// triangles of each brick -> the packed attributes, colour and normal of its voxels.
//
// All three come from the triangle closest to the voxel's centre; among equally close ones, from
// the one with the lowest number. So they don't depend on the order of work. These kernels run only
// for meshes with several groups or colours, or whose cubes need normals.
#include "lib/surface/packed_normal.h"
#include "lib/voxelize/cover.h"
#include "lib/voxelize/node_tile.h"
#include "lib/voxelize/point_triangle.h"
#include "lib/voxelize/texture.h"
#include "shared/texture.h"
#include "shared/voxel.h"

#ifndef VXL_SLICES
#define VXL_SLICES 16
#endif
/// VXL_VERTEX_COLORS: the mesh's vertices have colours. VXL_MESH_TEXTURES: the mesh has textures.
#ifndef VXL_VERTEX_COLORS
#define VXL_VERTEX_COLORS 1
#endif
#ifndef VXL_MESH_TEXTURES
#define VXL_MESH_TEXTURES 0
#endif
/// VXL_VERTEX_NORMALS: the mesh has normals at its triangles' corners.
#ifndef VXL_VERTEX_NORMALS
#define VXL_VERTEX_NORMALS 0
#endif
#define TILE_COLUMNS (TILES_X * TILES_Y)
#define BRICK_CENTER (LATTICE_BRICK / 2)
#define NO_TRIANGLE 0xFFFFFFFFu

/// The triangle that is closest to each voxel of the stored bricks, whose coordinates these are:
/// the parameters that `bind` of NearestTriangles sets, in its order.
#define VXL_NEAREST_PARAMETERS                                                               \
    int4 bricks, float4 scale, VXL_MESH_PARAMETERS, global const uint *restrict coordinates, \
        global const uint *restrict nearest

/// The textures that triangles wear: the parameters that `bind` of WornTextures sets, in its order.
#define VXL_WORN_PARAMETERS                                                          \
    global const uint *restrict texture_words, global const uint *restrict textures, \
        global const uint *restrict texels, global const uint *restrict uv_indices,  \
        global const float *restrict uvs

typedef struct {
    lane_float squared;
    lane_uint number;
} Nearest;

static inline void compare_nearest(Nearest* best, lane_float squared, uint number) {
    const lane_int closer =
        LANE_MASK(squared < best->squared) |
        (LANE_MASK(squared == best->squared) & LANE_MASK(number < best->number));
    best->squared = LANES_SELECT(closer, squared, best->squared);
    best->number = LANES_SELECT(closer, (lane_uint)(number), best->number);
}

/// One work-item takes VXL_SLICES slices of one brick. It writes the triangle closest to each
/// voxel's centre; voxels farther than `band` from all triangles get NO_TRIANGLE. `band` is in
/// shortest edges, and `reach` is the band in lattice units, rounded up.
///
/// There may be more bins with lists than stored bricks. The latter's coordinates are in
/// `coordinates_of_slots`.
kernel void find_nearest(uint count, int4 bricks, int4 reach, float4 scale, float band,
                         VXL_MESH_PARAMETERS, VXL_BINS_PARAMETERS,
                         global const uint* restrict coordinates_of_slots,
                         global const float* restrict shapes, global uint* restrict nearest) {
    if (work_item() >= count * (16 / VXL_SLICES)) return;
    const LatticeMesh mesh = VXL_MESH;
    const TriangleBins bins = VXL_BINS;
    const uint slot = work_item() / (16 / VXL_SLICES);
    const int first_slice = (int)(work_item() % (16 / VXL_SLICES)) * VXL_SLICES;
    const int3 brick = brick_of(coordinates_of_slots[slot], bricks);
    const uint bin =
        bins.number_of_bin[(brick.z * bins.size.y + brick.y) * bins.size.x + brick.x + 1];
    Nearest best[TILE_COLUMNS * VXL_SLICES];
    for (int i = 0; i < TILE_COLUMNS * VXL_SLICES; ++i) {
        best[i].squared = (lane_float)(band * band);
        best[i].number = (lane_uint)(NO_TRIANGLE);
    }
    const bool has_list = bin != VXL_BRICK_OUTSIDE;
    const uint end = has_list ? bins.first[bin + 1] : 0;
    for (uint i = has_list ? bins.first[bin] : 0; i < end; ++i) {
        const LatticeTriangle t =
            load_triangle(&mesh, bins.lists[i], brick * LATTICE_BRICK + BRICK_CENTER);
        const int3 low = lowest_corner(&t) + BRICK_CENTER - reach.xyz;
        const int3 high = highest_corner(&t) + BRICK_CENTER + reach.xyz;
        const int3 from = max(low >> LATTICE_BITS, (int3)(0, 0, first_slice));
        const int3 to = min(high >> LATTICE_BITS, (int3)(15, 15, first_slice + VXL_SLICES - 1));
        if (any(from > to)) continue;
        const TriangleFrame f =
            frame_triangle(&t, shapes + (size_t)SHAPE_FLOATS * bins.lists[i], scale.xyz);
        for (int j = from.y / TILE_Y; j <= to.y / TILE_Y; ++j)
            for (int k = from.x / TILE_X; k <= to.x / TILE_X; ++k) {
                const TileFrame tile = tile_frame(&f, TILE_LANE_X + (float)(k * TILE_X) - 7.5f,
                                                  TILE_LANE_Y + (float)(j * TILE_Y) - 7.5f);
                Nearest* column = best + (j * TILES_X + k) * VXL_SLICES - first_slice;
                for (int z = from.z; z <= to.z; ++z)
                    compare_nearest(&column[z], squared_distance(&f, &tile, (float)z - 7.5f),
                                    bins.lists[i]);
            }
    }
    for (int z = 0; z < VXL_SLICES; ++z)
        for (int j = 0; j < TILES_Y; ++j)
            for (int k = 0; k < TILES_X; ++k)
                store_tile_words(best[(j * TILES_X + k) * VXL_SLICES + z].number,
                                 nearest + 4096u * slot + 256u * (uint)(first_slice + z) +
                                     16u * (uint)(j * TILE_Y) + (uint)(k * TILE_X));
}

/// One work-item takes one voxel. It writes the packed attributes of the closest triangle, or
/// `packed` if there is none.
kernel void label_voxels(uint count, uint packed, global const uint* restrict nearest,
                         global const uint* restrict triangle_attributes,
                         global uint* restrict attributes) {
    if (work_item() >= count) return;
    const uint number = nearest[work_item()];
    attributes[work_item()] = number == NO_TRIANGLE ? packed : triangle_attributes[number];
}

/// The weights of a triangle's corners at its point closest to the origin.
static inline float3 closest_weights(float3 a, float3 b, float3 c) {
    const float3 ab = b - a, ac = c - a, n = cross_product(ab, ac);
    const float area = dot_product(n, n);
    // Where the sides are parallel, a component of n is only the rounding error of a product: below
    // 2^-24 of the product, so n is below 2^-23 of the sides' product. The square of that is
    // 1.4e-14; the rest of the bound is for edges of voxels that aren't cubes, which round the
    // corners. A triangle above the bound uses its normal if that gives valid weights.
    const float noise = 1e-13f * dot_product(ab, ab) * dot_product(ac, ac);
    float3 w = (float3)(dot_product(n, cross_product(b, c)), dot_product(n, cross_product(c, a)),
                        dot_product(n, cross_product(a, b)));
    const float sum = w.x + w.y + w.z;
    if (area > noise && w.x >= 0.0f && w.y >= 0.0f && w.z >= 0.0f && sum > 0.0f)
        return w * scalar_reciprocal(sum);
    const float3 p[3] = {a, b, c};
    float nearest = 1e30f;
    for (int i = 0; i < 3; ++i) {
        const float3 from = p[i], edge = p[(i + 1) % 3] - from;
        const float squared = dot_product(edge, edge);
        const float t =
            squared > 0.0f
                ? clamp(-dot_product(from, edge) * scalar_reciprocal(squared), 0.0f, 1.0f)
                : 0.0f;
        const float3 foot = from + edge * t;
        const float distance = dot_product(foot, foot);
        if (distance >= nearest) continue;
        nearest = distance;
        w = (float3)(i == 0   ? 1.0f - t
                     : i == 2 ? t
                              : 0.0f,
                     i == 1   ? 1.0f - t
                     : i == 0 ? t
                              : 0.0f,
                     i == 2   ? 1.0f - t
                     : i == 1 ? t
                              : 0.0f);
    }
    return w;
}

/// The sRGB code 0..255 of a linear value: the number of the 255 ascending thresholds that are at
/// most `value`.
static inline uint encode(float value, global const float* thresholds) {
    uint code = 0;
    for (uint step = 128; step > 0; step >>= 1)
        if (value >= thresholds[code + step - 1]) code += step;
    return code;
}

/// The weighted mean of the values of a triangle's corners.
static inline float3 mean_color(uint3 numbers, global const float* colors, float3 weights) {
    return vload3(numbers.x, colors) * weights.x + vload3(numbers.y, colors) * weights.y +
           vload3(numbers.z, colors) * weights.z;
}

static inline float2 mean_uv(uint3 numbers, global const float* uvs, float3 weights) {
    return vload2(numbers.x, uvs) * weights.x + vload2(numbers.y, uvs) * weights.y +
           vload2(numbers.z, uvs) * weights.z;
}

/// A triangle relative to the centre of a brick's voxel `number`.
static inline LatticeTriangle triangle_from(const LatticeMesh* mesh, uint triangle, int3 brick,
                                            uint number) {
    const int3 within =
        (int3)((int)(number & 15u), (int)(number >> 4 & 15u), (int)(number >> 8 & 15u));
    return load_triangle(mesh, triangle,
                         brick * LATTICE_BRICK + within * LATTICE_VOXEL + LATTICE_VOXEL / 2);
}

/// closest_weights of a triangle on the lattice.
static inline float3 weights_of(const LatticeTriangle* t, float4 scale) {
    const float3 to_metric = scale.xyz * (1.0f / LATTICE_VOXEL);
    return closest_weights(convert_float3(t->corner[0]) * to_metric,
                           convert_float3(t->corner[1]) * to_metric,
                           convert_float3(t->corner[2]) * to_metric);
}

/// One work-item takes one voxel. Its colour is that of its closest triangle at the point closest
/// to the centre: the interpolated colour of the corners, times the texture's colour there, in
/// linear light. `thresholds` and `linear_levels` are the sRGB curve from and to linear values.
kernel void color_voxels(uint count, VXL_NEAREST_PARAMETERS,
                         global const uint* restrict color_indices,
                         global const float* restrict vertex_colors,
                         global const float* restrict thresholds,
                         global const float* restrict linear_levels, VXL_WORN_PARAMETERS,
                         global uint* restrict colors) {
    const uint number = work_item();
    if (number >= count) return;
    const LatticeMesh mesh = VXL_MESH;
    const uint triangle = nearest[number];
    if (triangle == NO_TRIANGLE) {
        colors[number] = 0xFFFFFFu;
        return;
    }
    const LatticeTriangle t =
        triangle_from(&mesh, triangle, brick_of(coordinates[number >> 12], bricks), number);
    const float3 weights = weights_of(&t, scale);
    float3 color = (float3)(1.0f);
    if (VXL_VERTEX_COLORS)
        color = mean_color(vload3(triangle, color_indices), vertex_colors, weights);
    if (VXL_MESH_TEXTURES && texture_words[triangle] != VXL_NO_TEXTURE) {
        const uint word = texture_words[triangle];
        const float2 uv = mean_uv(vload3(triangle, uv_indices), uvs, weights);
        color *= texture_color(vload4(word & VXL_TEXTURE_MASK, textures),
                               word >> VXL_TEXTURE_LEVEL_SHIFT, texels, linear_levels, uv);
    }
    colors[number] = encode(color.x, thresholds) | encode(color.y, thresholds) << 8 |
                     encode(color.z, thresholds) << 16;
}

/// The normal of a triangle, as a gradient in voxels. A degenerate triangle, a line, has none.
static inline uint face_normal(const LatticeTriangle* t) {
    if (all(t->corner[1] == t->corner[2])) return VXL_NO_NORMAL;
    const float unit_length = 1.0f / LATTICE_VOXEL;
    const float3 a = convert_float3(t->corner[1] - t->corner[0]) * unit_length,
                 b = convert_float3(t->corner[2] - t->corner[0]) * unit_length;
    const float3 n = cross_product(a, b);
    const float3 size = fabs(n);
    const float longest = fmax(size.x, fmax(size.y, size.z));
    if (longest == 0.0f) return VXL_NO_NORMAL;
    return pack_normal(n * scalar_reciprocal(longest));
}

/// The weighted mean of the normals at a triangle's corners, which are of unit length in metres, as
/// a gradient in voxels. The result is the triangle's own normal where corners have none, or where
/// their mean has no direction.
static inline uint mean_normal(global const uint* codes, float3 weights, float3 scale,
                               const LatticeTriangle* t) {
    if (codes[0] == VXL_NO_NORMAL) return face_normal(t);
    const float weight[3] = {weights.x, weights.y, weights.z};
    const float3 to_metric = (float3)(scalar_reciprocal(scale.x), scalar_reciprocal(scale.y),
                                      scalar_reciprocal(scale.z));
    float3 sum = (float3)(0.0f);
    for (int i = 0; i < 3; ++i) {
        const float3 n = unpack_one_normal(codes[i]) * to_metric;
        sum += n * (scalar_reciprocal(scalar_root(dot_product(n, n))) * weight[i]);
    }
    const uint code = pack_normal(sum * scale);
    return code == VXL_NO_NORMAL ? face_normal(t) : code;
}

/// One work-item takes one voxel. It writes the normal of the closest triangle at the point closest
/// to the centre, or VXL_NO_NORMAL if no triangle is near.
kernel void give_normals(uint count, VXL_NEAREST_PARAMETERS,
                         global const uint* restrict corner_normals,
                         global uint* restrict normals) {
    const uint number = work_item();
    if (number >= count) return;
    const LatticeMesh mesh = VXL_MESH;
    const uint triangle = nearest[number];
    if (triangle == NO_TRIANGLE) {
        normals[number] = VXL_NO_NORMAL;
        return;
    }
    const LatticeTriangle t =
        triangle_from(&mesh, triangle, brick_of(coordinates[number >> 12], bricks), number);
    normals[number] = VXL_VERTEX_NORMALS ? mean_normal(corner_normals + 3u * triangle,
                                                       weights_of(&t, scale), scale.xyz, &t)
                                         : face_normal(&t);
}
