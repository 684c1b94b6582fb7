// SPDX-License-Identifier: Apache-2.0
// triangles of each brick, and what is inside -> signed distances at its nodes, 16 bits each.
//
// Distances are gathered: one work-item owns its nodes and visits the brick's triangles; the
// smallest squared distance does not depend on their order. A triangle concerns only nodes within
// the band. Tiles that are surely beyond the band are skipped, and nodes beyond it are stored as
// saturated.
#include "lib/voxelize/cover.h"
#include "lib/voxelize/node_tile.h"
#include "lib/voxelize/point_triangle.h"
#include "shared/voxel.h"

#ifndef VXL_SLICES
#define VXL_SLICES 16
#endif
#define TILE_COLUMNS (TILES_X * TILES_Y)
#define BRICK_CENTER (LATTICE_BRICK / 2 - LATTICE_VOXEL / 2)

/// One work-item takes one triangle. It writes the part of the triangle's frame that does not
/// depend on the brick.
kernel void shape_triangles(float4 scale, VXL_MESH_PARAMETERS, global float* restrict shapes) {
    if (work_item() >= triangle_count) return;
    const LatticeMesh mesh = VXL_MESH;
    const LatticeTriangle t = load_triangle(&mesh, work_item(), (int3)(0, 0, 0));
    shape_of_triangle(&t, scale.xyz, shapes + (size_t)SHAPE_FLOATS * work_item());
}

/// A range of z, in voxels from the brick's centre; empty if first > last.
typedef struct {
    float first, last;
} SliceRange;

/// Narrows the range to where at + slope z <= limit. A slope below 1e-6, which moves `at` by less
/// than 8e-6 within the brick, counts as 0: `limit` has a margin of 0.01.
static inline void narrow(SliceRange* range, float at, float slope, float limit) {
    if (fabs(slope) < 1e-6f) {
        if (at > limit) range->last = -100.0f;
        return;
    }
    const float bound = (limit - at) / slope;
    if (slope > 0.0f)
        range->last = fmin(range->last, bound);
    else
        range->first = fmax(range->first, bound);
}

/// The slices whose tile at (x, y) can have a node within `band` of the triangle. Only slices that
/// are surely farther away are left out (the margin is far above rounding), so no stored value
/// depends on the result.
static inline SliceRange concerned_slices(const TriangleFrame* f, float x, float y, float band,
                                          SliceRange all) {
    SliceRange range = all;
    const float half_x = 0.5f * (TILE_X - 1), half_y = 0.5f * (TILE_Y - 1), margin = 0.01f;
    const float3 n = f->height.gradient;
    const float at = f->height.at + n.x * x + n.y * y;
    const float limit = band + fabs(n.x) * half_x + fabs(n.y) * half_y + margin;
    narrow(&range, at, n.z, limit);
    narrow(&range, -at, -n.z, limit);
    for (int i = 0; i < 3; ++i) {
        const float3 s = f->edge[i].outside.gradient;
        narrow(&range, f->edge[i].outside.at + s.x * x + s.y * y, s.z,
               band + fabs(s.x) * half_x + fabs(s.y) * half_y + margin);
    }
    return range;
}

/// Nodes of a brick, both ends included.
typedef struct {
    int3 first, last;
} NodeBox;

/// Lowers `best` by the distances to one triangle, for the nodes of `box`.
static inline void lower_distances(const TriangleFrame* f, NodeBox box, int first_slice, float band,
                                   lane_float* best) {
    const SliceRange slices = {(float)box.first.z - 7.5f, (float)box.last.z - 7.5f};
    for (int j = box.first.y / TILE_Y; j <= box.last.y / TILE_Y; ++j)
        for (int i = box.first.x / TILE_X; i <= box.last.x / TILE_X; ++i) {
            const float x = (float)(i * TILE_X) - 7.5f, y = (float)(j * TILE_Y) - 7.5f;
            const SliceRange range =
                concerned_slices(f, x + 0.5f * (TILE_X - 1), y + 0.5f * (TILE_Y - 1), band, slices);
            if (!(range.first <= range.last)) continue;
            const int first = (int)(range.first + 7.5f), last = (int)(range.last + 7.5f);
            const TileFrame tile = tile_frame(f, TILE_LANE_X + x, TILE_LANE_Y + y);
            lane_float* column = best + (j * TILES_X + i) * VXL_SLICES - first_slice;
            for (int z = first; z <= last; ++z)
                column[z] = fmin(column[z], squared_distance(f, &tile, (float)z - 7.5f));
        }
}

/// The stored value of nodes with squared distance `squared`, negative where `inside`.
static inline lane_int distance_units(lane_float squared, lane_int inside, float band) {
    const lane_float distance = exact_sqrt(squared) * (float)VXL_DISTANCE_UNITS;
    // Adding 1.5 * 2^23 leaves the nearest integer in the low bits, ties to even.
    const lane_int nearest = LANES_AS_INT(distance + 12582912.0f) - 0x4B400000;
    const lane_int within = LANE_MASK(squared <= band * band) & LANE_MASK(nearest < 32767);
    const lane_int units = LANES_SELECT(within, nearest, (lane_int)(32767));
    return LANES_SELECT(inside, -units, units);
}

/// One work-item takes VXL_SLICES slices of one brick.
///
/// `scale` is each voxel edge in units of the shortest edge; `band` is in shortest edges, at most
/// 4, and `reach` is the band in lattice units along each axis, rounded up. Bit x of inside[16 z +
/// y] is set inside.
kernel void measure_distances(uint count, int4 bricks, int4 reach, float4 scale, float band,
                              VXL_MESH_PARAMETERS, VXL_BINS_PARAMETERS,
                              global const float* restrict shapes,
                              global const ushort* restrict inside,
                              global short* restrict distance) {
    if (work_item() >= count * (16 / VXL_SLICES)) return;
    const LatticeMesh mesh = VXL_MESH;
    const TriangleBins bins = VXL_BINS;
    const uint slot = work_item() / (16 / VXL_SLICES);
    const int first_slice = (int)(work_item() % (16 / VXL_SLICES)) * VXL_SLICES;
    const int3 origin = brick_of(bins.coordinates[slot], bricks) * LATTICE_BRICK;
    lane_float best[TILE_COLUMNS * VXL_SLICES];
    for (int i = 0; i < TILE_COLUMNS * VXL_SLICES; ++i) best[i] = (lane_float)(1000.0f);
    for (uint i = bins.first[slot]; i < bins.first[slot + 1]; ++i) {
        const LatticeTriangle t = load_triangle(&mesh, bins.lists[i], origin + BRICK_CENTER);
        NodeBox box;
        const int3 low = lowest_corner(&t) + BRICK_CENTER - reach.xyz;
        box.first = max((low + (LATTICE_VOXEL - 1)) >> LATTICE_BITS, (int3)(0, 0, first_slice));
        box.last = min((highest_corner(&t) + BRICK_CENTER + reach.xyz) >> LATTICE_BITS,
                       (int3)(15, 15, first_slice + VXL_SLICES - 1));
        if (any(box.first > box.last)) continue;
        const TriangleFrame f =
            frame_triangle(&t, shapes + (size_t)SHAPE_FLOATS * bins.lists[i], scale.xyz);
        lower_distances(&f, box, first_slice, band, best);
    }
    for (int z = 0; z < VXL_SLICES; ++z)
        for (int j = 0; j < TILES_Y; ++j) {
            const uint row = 256u * slot + 16u * (uint)(first_slice + z) + (uint)(j * TILE_Y);
            ushort rows[TILE_Y];
            for (int k = 0; k < TILE_Y; ++k) rows[k] = inside[row + (uint)k];
            for (int i = 0; i < TILES_X; ++i)
                store_tile(distance_units(best[(j * TILES_X + i) * VXL_SLICES + z],
                                          tile_mask(rows, i * TILE_X), band),
                           distance + 16u * row + (uint)(i * TILE_X));
        }
}
