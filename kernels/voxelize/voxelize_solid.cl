// SPDX-License-Identifier: Apache-2.0
// analytic solid -> bricks with distances at nodes, or masks of voxels.
#include "lib/lanes/work_item.h"
#include "lib/solid/solid.h"
#include "lib/solid/solid_cover.h"
#include "shared/voxel.h"

static inline LatticePoint lattice_point(lane_int x, lane_int y, lane_int z, float offset) {
    LatticePoint at;
    at.x = x, at.y = y, at.z = z;
    at.offset_x = at.offset_y = at.offset_z = (lane_float)offset;
    return at;
}

/// Decides which bricks the surface may concern: those with a block of 4³ nodes (`of_nodes`) or
/// voxels at whose middle the distance does not exceed `block_reach`. Their state is 0; the state
/// of the others is VXL_BRICK_INSIDE or VXL_BRICK_OUTSIDE.
///
/// A work-item takes VXL_LANES bricks of the grid in order; `states` has room for whole groups. The
/// reaches are half the diagonals of a brick and of a block, plus the distance that matters, in
/// shortest edges: the distance changes between two points by at most the distance between them.
kernel void classify_solid_bricks(global const SolidShape* restrict solids, int4 bricks,
                                  uint brick_count, int of_nodes, float brick_reach,
                                  float block_reach, global uint* restrict states) {
    const uint first = work_item() * VXL_LANES;
    if (first >= brick_count) return;
    const lane_int brick = (lane_int)((int)first) + LANES_NUMBERS;
    const lane_int row = brick / bricks.x;
    const lane_int x = (brick - row * bricks.x) * 16;
    const lane_int z = row / bricks.y * 16;
    const lane_int y = (row - row / bricks.y * bricks.y) * 16;
    const float half_less = of_nodes ? -0.5f : 0.0f;  // nodes 0..15 have their middle at 7.5
    const SolidDistance middle =
        solid_distance(solids, 0, lattice_point(x + 8, y + 8, z + 8, half_less));
    const lane_int open = LANE_MASK(fabs(middle.distance) <= brick_reach + middle.rounding);
    lane_int stored = (lane_int)0;
    if (lanes_any(open)) {
        for (int block = 0; block < 64 && lanes_any(open & ~stored); ++block) {
            const lane_int bx = x + ((block & 3) * 4 + 2), by = y + ((block >> 2 & 3) * 4 + 2),
                           bz = z + ((block >> 4) * 4 + 2);
            const SolidDistance d = solid_distance(solids, 0, lattice_point(bx, by, bz, half_less));
            stored |= open & LANE_MASK(fabs(d.distance) <= block_reach + d.rounding);
        }
    }
    const lane_uint empty = LANES_SELECT(LANE_MASK(middle.distance <= 0.0f),
                                         (lane_uint)VXL_BRICK_INSIDE, (lane_uint)VXL_BRICK_OUTSIDE);
    const lane_uint state = LANES_SELECT(stored, (lane_uint)0u, empty);
    LANES_STORE(state, states, first);
}

/// Writes the distances of VXL_LANES neighbouring nodes of a stored brick.
kernel void sample_solid(global const SolidShape* restrict solids,
                         global const uint* restrict coordinates, int4 bricks, uint first_brick,
                         uint node_count, global short* restrict distance) {
    const uint number = work_item() * VXL_LANES;
    if (number >= node_count) return;
    const uint slot = first_brick + (number >> 12), node = number & 4095u;
    const int brick = (int)coordinates[slot];
    const int row = brick / bricks.x;
    const lane_int x = (brick - row * bricks.x) * 16 + (int)(node & 15u) + LANES_NUMBERS;
    const lane_int y = (lane_int)(row % bricks.y * 16 + (int)(node >> 4 & 15u));
    const lane_int z = (lane_int)(row / bricks.y * 16 + (int)(node >> 8));
    const SolidDistance d = solid_distance(solids, 0, lattice_point(x, y, z, 0.0f));
    const lane_float units =
        clamp(d.distance * (float)VXL_DISTANCE_UNITS, (lane_float)-32767.0f, (lane_float)32767.0f);
    const size_t at = ((size_t)slot << 12) + node;
    LANES_STORE(LANES_SHORT(LANES_INT(rint(units))), distance, at);
}

/// Writes the mask of one leaf of a stored brick, and the mask of those of its voxels that floats
/// cannot decide.
///
/// `set` is VXL_SET_*; `reach` is half the diagonal of a leaf (x) and of a voxel (y), in shortest
/// edges. `undecided_count` counts the leaves with such voxels.
kernel void occupy_solid(global const SolidShape* restrict solids,
                         global const uint* restrict coordinates, int4 bricks, int4 size,
                         uint leaf_count, uint set, float2 reach, global uint2* restrict occupancy,
                         global uint2* restrict undecided, global uint* restrict undecided_count) {
    const uint number = work_item();
    if (number >= leaf_count) return;
    const int brick = (int)coordinates[number >> 6];
    const int row = brick / bricks.x;
    const int x = (brick - row * bricks.x) * 16 + (int)(number & 3u) * 4;
    const int y = row % bricks.y * 16 + (int)(number >> 2 & 3u) * 4;
    const int z = row / bricks.y * 16 + (int)(number >> 4 & 3u) * 4;
    const SolidDistance middle = solid_distance(
        solids, 0, lattice_point((lane_int)(x + 2), (lane_int)(y + 2), (lane_int)(z + 2), 0.0f));
    uint2 set_bits = (uint2)(0u, 0u), open_bits = (uint2)(0u, 0u);
    const int near = lanes_any(LANE_MASK(fabs(middle.distance) <= reach.x + middle.rounding));
    const int all_in = set == VXL_SET_SOLID && lanes_any(LANE_MASK(middle.distance <= 0.0f));
    for (int first = 0; first < 64; first += VXL_LANES) {
        const lane_int voxel = (lane_int)first + LANES_NUMBERS;
        const lane_int vx = x + (voxel & 3), vy = y + (voxel >> 2 & 3), vz = z + (voxel >> 4);
        lane_int is_open = (lane_int)0, is_set = (lane_int)(-(all_in != 0));
        if (near) is_set = covered_voxels(solids, set, reach.y, vx, vy, vz, &is_open);
        const lane_int in_grid =
            LANE_MASK(vx < size.x) & LANE_MASK(vy < size.y) & LANE_MASK(vz < size.z);
        const lane_int bit = (lane_int)1 << (voxel & 31);
        const uint set_part = (uint)lanes_any(is_set & in_grid & bit);
        const uint open_part = (uint)lanes_any(is_open & in_grid & bit);
        if (first < 32)
            set_bits.x |= set_part, open_bits.x |= open_part;
        else
            set_bits.y |= set_part, open_bits.y |= open_part;
    }
    occupancy[number] = set_bits;
    undecided[number] = open_bits;
    if (open_bits.x | open_bits.y) atomic_inc(undecided_count);
}

/// Counts the voxels of one stored brick.
kernel void count_solid_voxels(global const uint2* restrict occupancy, uint brick_count,
                               global uint* restrict counts) {
    const uint slot = work_item();
    if (slot >= brick_count) return;
    uint count = 0;
    for (int leaf = 0; leaf < 64; ++leaf) {
        const uint2 mask = occupancy[slot * 64u + (uint)leaf];
        count += popcount(mask.x) + popcount(mask.y);
    }
    counts[slot] = count;
}

/// For one stored brick, writes each voxel's first entry in the list of primitives, which has one
/// entry per occupied voxel. `firsts` holds the first entry of each brick.
kernel void number_voxels(global const uint2* restrict occupancy,
                          global const uint* restrict firsts, uint brick_count,
                          global uint* restrict primitive_first) {
    const uint slot = work_item();
    if (slot >= brick_count) return;
    uint next = firsts[slot];
    for (uint voxel = 0; voxel < 4096u; ++voxel) {
        const uint x = voxel & 15u, y = voxel >> 4 & 15u, z = voxel >> 8;
        const uint2 mask = occupancy[slot * 64u + ((x >> 2) | (y >> 2) << 2 | (z >> 2) << 4)];
        const uint bit = (x & 3u) | (y & 3u) << 2 | (z & 1u) << 4;
        primitive_first[slot * 4096u + voxel] = next;
        next += ((z & 2u) ? mask.y : mask.x) >> bit & 1u;
    }
}
