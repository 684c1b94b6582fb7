// SPDX-License-Identifier: Apache-2.0
// A copy of kernels/voxelize/voxelize_cover.cl in 32-bit floats, to measure the cost of exactness.
// It makes the kernel's tests, in the kernel's order, on coordinates in voxels.
#pragma once

namespace voxelume {

inline constexpr const char* kFloatCover = R"(
#include "lib/voxelize/cover.h"

typedef struct {
    float3 u, w, low, high;
} FloatSilhouette;

static inline FloatSilhouette float_silhouette(float2 a, float2 b, float2 c, float area) {
    const float3 u = (float3)(a.x, b.x, c.x), w = (float3)(a.y, b.y, c.y);
    FloatSilhouette s;
    s.u = w - w.yzx;
    s.w = u.yzx - u;
    const float3 at = s.u * u + s.w * w;
    s.low = at + fmin(area, 0.0f) - fmax(s.u, 0.0f) - fmax(s.w, 0.0f);
    s.high = at + fmax(area, 0.0f) - fmin(s.u, 0.0f) - fmin(s.w, 0.0f);
    return s;
}

static inline bool float_cell_in(const FloatSilhouette* s, int u, int w) {
    const float3 at = s->u * (float)u + s->w * (float)w;
    return all((at >= s->low) & (at <= s->high));
}

typedef struct {
    CoverBox box;
    bool sees_xy, sees_yz, sees_zx, meets_plane;
    float3 n;
    float low, high;
    FloatSilhouette xy, yz, zx;
    ushort xy_rows[16];
} FloatCover;

static inline void prepare_float_cover(FloatCover* c, const LatticeTriangle* t,
                                       const CoverBox* box) {
    const int3 is_long = long_axes(t);
    c->box = *box;
    c->sees_xy = is_long.x & is_long.y;
    c->sees_yz = is_long.y & is_long.z;
    c->sees_zx = is_long.z & is_long.x;
    c->meets_plane = c->sees_xy & is_long.z;
    if (!(c->sees_xy | c->sees_yz | c->sees_zx)) return;
    const float3 a = convert_float3(t->corner[0]) * (1.0f / LATTICE_VOXEL);
    const float3 b = convert_float3(t->corner[1]) * (1.0f / LATTICE_VOXEL);
    const float3 d = convert_float3(t->corner[2]) * (1.0f / LATTICE_VOXEL);
    const float3 u = b - a, v = d - a;
    c->n = (float3)(u.y * v.z - u.z * v.y, u.z * v.x - u.x * v.z, u.x * v.y - u.y * v.x);
    if (c->meets_plane) {
        const float at = c->n.x * a.x + c->n.y * a.y + c->n.z * a.z;
        const float3 positive = fmax(c->n, 0.0f), negative = fmin(c->n, 0.0f);
        c->low = at - (positive.x + positive.y + positive.z);
        c->high = at - (negative.x + negative.y + negative.z);
    }
    if (c->sees_yz) c->yz = float_silhouette(a.yz, b.yz, d.yz, c->n.x);
    if (c->sees_zx) c->zx = float_silhouette(a.zx, b.zx, d.zx, c->n.y);
    if (!c->sees_xy) return;
    c->xy = float_silhouette(a.xy, b.xy, d.xy, c->n.z);
    for (int y = box->first.y; y <= box->last.y; ++y) {
        uint row = 0;
        for (int x = box->first.x; x <= box->last.x; ++x)
            row |= (uint)float_cell_in(&c->xy, x, y) << x;
        c->xy_rows[y] = (ushort)row;
    }
}

static inline uint float_row(const FloatCover* c, int y, int z) {
    const uint seen =
        c->sees_xy ? c->xy_rows[y] : bits_between(c->box.first.x, c->box.last.x);
    if (!seen || (c->sees_yz && !float_cell_in(&c->yz, y, z))) return 0u;
    if (!c->sees_zx) return seen;
    const float row_at = c->n.y * (float)y + c->n.z * (float)z;
    uint row = 0;
    for (int x = c->box.first.x; x <= c->box.last.x; ++x) {
        bool inside = float_cell_in(&c->zx, z, x);
        if (c->meets_plane) {
            const float at = row_at + c->n.x * (float)x;
            inside = inside & (at >= c->low) & (at <= c->high);
        }
        row |= (uint)inside << x;
    }
    return row & seen;
}

static inline void add_row(ulong* masks, uint row, int y, int z) {
    const int leaf = ((y >> 2) << 2) | ((z >> 2) << 4);
    const int shift = ((y & 3) << 2) | ((z & 3) << 4);
    for (int i = 0; i < 4; ++i) masks[leaf + i] |= (ulong)((row >> (4 * i)) & 15u) << shift;
}

kernel void cover_bricks(uint count, int4 size, int4 bricks, VXL_MESH_PARAMETERS,
                         VXL_BINS_PARAMETERS, global ulong* restrict occupancy) {
    if (work_item() >= count * (16 / VXL_SLICES)) return;
    const LatticeMesh mesh = VXL_MESH;
    const TriangleBins bins = VXL_BINS;
    const uint slot = work_item() / (16 / VXL_SLICES);
    const int first_slice = (int)(work_item() % (16 / VXL_SLICES)) * VXL_SLICES;
    const int3 brick = brick_of(bins.coordinates[slot], bricks);
    const int3 last = min(size.xyz - brick * 16, (int3)(16)) - 1;
    ulong masks[4 * VXL_SLICES];
    for (int i = 0; i < 4 * VXL_SLICES; ++i) masks[i] = 0;
    for (uint i = bins.first[slot]; i < bins.first[slot + 1]; ++i) {
        const LatticeTriangle t =
            load_triangle(&mesh, bins.lists[i], brick * LATTICE_BRICK);
        CoverBox box = cover_box(&t, last);
        box.first.z = max(box.first.z, first_slice);
        box.last.z = min(box.last.z, first_slice + VXL_SLICES - 1);
        if (any(box.first > box.last)) continue;
        FloatCover cover;
        prepare_float_cover(&cover, &t, &box);
        for (int z = box.first.z; z <= box.last.z; ++z)
            for (int y = box.first.y; y <= box.last.y; ++y) {
                const uint row = float_row(&cover, y, z);
                if (row) add_row(masks, row, y, z - first_slice);
            }
    }
    for (int i = 0; i < 4 * VXL_SLICES; ++i)
        occupancy[64u * slot + 4u * first_slice + i] = masks[i];
}
)";

}  // namespace voxelume
