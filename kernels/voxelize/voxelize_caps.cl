// SPDX-License-Identifier: Apache-2.0
// winding numbers of a mesh closed by caps -> which points are inside the open mesh.
//
// The generalized winding number (Jacobson et al. 2013) of the open mesh is the integer winding
// number of the closed mesh minus the caps' solid angle. Away from the mesh it changes slowly and
// smoothly, even through the caps, so one point and a bound on the slope decide most bricks.
#include "lib/voxelize/cover.h"
#include "lib/voxelize/node_tile.h"
#include "lib/voxelize/solid_angle.h"
#include "lib/voxelize/windings.h"
#include "shared/voxel.h"

#ifndef VXL_CENTERS
#define VXL_CENTERS 0
#endif
#ifndef VXL_SLICES
#define VXL_SLICES 16
#endif
#define MIDDLE_POINT (8u + 16u * 8u + 256u * 8u)
#define POINT_OFFSET (VXL_CENTERS * LATTICE_VOXEL / 2)
#define TILE_COLUMNS (TILES_X * TILES_Y)
#define TURNS 0.15915494f  // 1 / 2 pi: from half a solid angle to a winding number

// This is a bound above 1 / 4 pi = 0.0795775.
#define INVERSE_SPHERE 0.0796f
// A length is right within about ten units of 2^-24. An edge's middle is rounded by half a unit of
// the lattice on each axis, 2.2e-4 voxel; where a gap is above 0, the middle is at least half a
// brick, 8 voxels, away, so this is 2.8e-5 of its distance. One part in 1000 covers both.
#define LENGTH_ROUNDING 1e-3f
// The smallest gap, in voxels, that is divided by. With it, an edge of one lattice unit already has
// a slope of 10^7 per voxel, so the brick is open whatever else is in it.
#define MIN_GAP 1e-6f
// Four times 2^-24 of each sum: one for the sum, the others for the product with TURNS and for this
// bound.
#define SUM_ROUNDING 2.4e-7f

// States of bricks.
#define STATE_OUTSIDE 0u
#define STATE_INSIDE 1u
#define STATE_CLOSED 2u  // stored: caps change nothing; the closed mesh's winding numbers decide
#define STATE_OPEN 3u    // stored: every point needs the caps' solid angle

/// An upper bound on the slope of the caps' winding number within `radius` of the points. By the
/// law of Biot and Savart the slope depends on the outline only, which consists of each cap's first
/// edge.
static inline lane_float slope_bound(const Cap* cap, const LanePoints* p, float radius,
                                     float3 to_metric) {
    const int3 first = cap->lattice.corner[0], second = cap->lattice.corner[1];
    const float3 edge = convert_float3(second - first) * to_metric;
    const float length =
        sqrt(edge.x * edge.x + edge.y * edge.y + edge.z * edge.z) * (1.0f + LENGTH_ROUNDING);
    const LaneVector middle = vector_to(first + (second - first) / 2, p, to_metric);
    const lane_float gap = fmax(middle.length * (1.0f - LENGTH_ROUNDING) - 0.5f * length - radius,
                                (lane_float)MIN_GAP);
    return (INVERSE_SPHERE * length) / (gap * gap);
}

/// What decides a brick's state, apart from the caps' solid angle.
typedef struct {
    bool has_surface, has_caps;
    float closed;  // winding number of the closed mesh at the middle point
} BrickFacts;

/// The state of a brick. `caps` is the winding number of the caps at the middle point. At all other
/// points of the brick it differs by at most `margin`, which may be NaN.
static inline uint brick_state(BrickFacts f, float caps, float margin) {
    if (f.has_surface) return !f.has_caps && fabs(caps) + margin < 0.5f ? STATE_CLOSED : STATE_OPEN;
    const float winding = f.closed - caps;
    if (!(fabs(winding - 0.5f) >= margin)) return STATE_OPEN;
    return winding > 0.5f ? STATE_INSIDE : STATE_OUTSIDE;
}

/// One work-item takes VXL_LANES bricks. It writes their states.
///
/// Triangles cap_first .. cap_first + cap_count - 1 are the caps. The three tables give each bin's
/// number among the bins with a surface, with caps, and with either; those with either have winding
/// numbers.
kernel void classify_open_bricks(uint count, int4 bricks, float4 scale, float radius,
                                 VXL_MESH_PARAMETERS, global const uint* restrict surface_bins,
                                 global const uint* restrict cap_bins,
                                 global const uint* restrict any_bins, VXL_WINDING_PARAMETERS,
                                 global uint* restrict states) {
    const uint first = work_item() * VXL_LANES;
    if (first >= count) return;
    const LatticeMesh mesh = VXL_MESH;
    const WindingNumbers closed = VXL_WINDINGS;
    LanePoints p;
    for (uint i = 0; i < VXL_LANES; ++i) {
        const int3 at = brick_of(min(first + i, count - 1u), bricks) * LATTICE_BRICK +
                        LATTICE_BRICK / 2 + POINT_OFFSET;
        ((int*)&p.x)[i] = at.x;
        ((int*)&p.y)[i] = at.y;
        ((int*)&p.z)[i] = at.z;
    }
    const float3 to_metric = scale.xyz * (1.0f / LATTICE_VOXEL);
    lane_float caps = (lane_float)(0.0f), slope = (lane_float)(0.0f), error = (lane_float)(0.0f);
    for (uint i = mesh.first; i < mesh.first + mesh.count; ++i) {
        const Cap cap = make_cap(load_triangle(&mesh, i, (int3)(0, 0, 0)), scale.xyz);
        slope += slope_bound(&cap, &p, radius, to_metric);
        if (all(cap.area == 0L)) continue;  // no solid angle, but a part of the outline
        const HalfAngle seen = half_solid_angle(&cap, &p, to_metric);
        caps += seen.angle;
        error += seen.error + SUM_ROUNDING * fabs(caps);
    }
    for (uint i = 0; i < VXL_LANES && first + i < count; ++i) {
        const int3 brick = brick_of(first + i, bricks);
        const uint bin = (uint)((brick.z * bricks.y + brick.y) * (bricks.x + 1) + brick.x + 1);
        BrickFacts f;
        f.has_surface = surface_bins[bin] != VXL_BRICK_OUTSIDE;
        f.has_caps = cap_bins[bin] != VXL_BRICK_OUTSIDE;
        f.closed = (float)winding_at(&closed, first + i, any_bins[bin], MIDDLE_POINT);
        const float margin = ((const float*)&error)[i] * TURNS + ((const float*)&slope)[i] * radius;
        states[first + i] = brick_state(f, ((const float*)&caps)[i] * TURNS, margin);
    }
}

/// One work-item takes VXL_SLICES slices of one stored brick. Bit x of inside[16 z + y] says
/// whether the open mesh's winding number is above 1/2.
///
/// `numbers` gives each slot's number among bins with winding numbers, or VXL_BRICK_OUTSIDE.
kernel void find_inside_open(uint count, int4 bricks, float4 scale, VXL_MESH_PARAMETERS,
                             global const uint* restrict coordinates,
                             global const uint* restrict states,
                             global const uint* restrict numbers, VXL_WINDING_PARAMETERS,
                             global ushort* restrict inside) {
    if (work_item() >= count * (16 / VXL_SLICES)) return;
    const LatticeMesh mesh = VXL_MESH;
    const WindingNumbers closed = VXL_WINDINGS;
    const uint slot = work_item() / (16 / VXL_SLICES);
    const int first_slice = (int)(work_item() % (16 / VXL_SLICES)) * VXL_SLICES;
    const uint brick = coordinates[slot], number = numbers[slot];
    const int3 origin = brick_of(brick, bricks) * LATTICE_BRICK;
    const float3 to_metric = scale.xyz * (1.0f / LATTICE_VOXEL);
    lane_float caps[TILE_COLUMNS * VXL_SLICES];
    for (int i = 0; i < TILE_COLUMNS * VXL_SLICES; ++i) caps[i] = (lane_float)(0.0f);
    const uint end = states[brick] == STATE_OPEN ? mesh.first + mesh.count : mesh.first;
    for (uint i = mesh.first; i < end; ++i) {
        const Cap cap = make_cap(load_triangle(&mesh, i, origin), scale.xyz);
        if (all(cap.area == 0L)) continue;
        for (int k = 0; k < TILE_COLUMNS * VXL_SLICES; ++k) {
            const int column = k / VXL_SLICES, z = first_slice + k % VXL_SLICES;
            LanePoints p;
            p.x =
                LATTICE_VOXEL * (LANES_INT(TILE_LANE_X) + column % TILES_X * TILE_X) + POINT_OFFSET;
            p.y =
                LATTICE_VOXEL * (LANES_INT(TILE_LANE_Y) + column / TILES_X * TILE_Y) + POINT_OFFSET;
            p.z = (lane_int)(LATTICE_VOXEL * z + POINT_OFFSET);
            caps[k] += half_solid_angle(&cap, &p, to_metric).angle;
        }
    }
    for (uint z = (uint)first_slice; z < (uint)first_slice + VXL_SLICES; ++z)
        for (uint y = 0; y < 16u; ++y) {
            uint row = 0;
            for (uint x = 0; x < 16u; ++x) {
                const uint node = 256u * z + 16u * y + x;
                const int whole = winding_at(&closed, brick, number, node);
                const uint column = y / TILE_Y * TILES_X + x / TILE_X;
                const uint lane = y % TILE_Y * TILE_X + x % TILE_X;
                const float* sums =
                    (const float*)&caps[column * VXL_SLICES + z - (uint)first_slice];
                row |= (uint)((float)whole - sums[lane] * TURNS > 0.5f) << x;
            }
            inside[256u * slot + 16u * z + y] = (ushort)row;
        }
}
