// SPDX-License-Identifier: Apache-2.0
// voxels shown in the layout `lattice` -> the mean light of the surface in each.
//
// A probe point and the normal there define a plane that stands for a surface in a voxel: samples
// are spread evenly over the part of the plane that lies in the voxel. Rays are aimed at them as at
// the probe point, and count where they meet a surface in the voxel. For each axis, a voxel has one
// probe point on lines along that axis; it counts if its plane faces that axis most. So two
// surfaces that meet in a voxel, as at the rim of a plate, have a plane each.
#include "lib/display/lattice_mask.h"
#include "lib/display/probe.h"
#include "lib/display/voxel_light.h"
#include "lib/lanes/vector.h"
#include "lib/lanes/work_item.h"
#include "shared/display.h"
#include "shared/scene.h"
#include "shared/trace.h"

// How far outside its voxel a sample may be met, in lattice voxels. Surfaces may lie on voxels'
// sides.
#define VXL_SAMPLE_SLACK 0.00390625f

// Surfaces whose normal's y is below minus this value have no samples: few observers see them, and
// they would put dark spots on the rims of plates.
#define VXL_LOOKS_DOWN 0.7f

/// Stores the normals of rays 0 .. count-1, which were aimed at voxels from `first_voxel` on.
kernel void keep_normals(global const uint* restrict hits, global const float* restrict normals,
                         uint stride, uint first_voxel, uint count,
                         global float* restrict voxel_normals) {
    const uint n = work_item();
    if (n >= count || hits[VXL_HIT_VOXEL * stride + n] == VXL_NO_VOXEL) return;
    const size_t voxel = first_voxel + n;
    for (uint axis = 0; axis < 3; ++axis)
        voxel_normals[3 * voxel + axis] = normals[axis * stride + n];
}

/// The corners of a packet's voxels, in lattice voxels.
static inline Vector voxel_corners(const DisplayLattice* l, global const ulong* restrict indices,
                                   uint first, uint end) {
    float x[VXL_LANES], y[VXL_LANES], z[VXL_LANES];
    for (uint i = 0; i < VXL_LANES; ++i) {
        const ulong index = first + i < end ? indices[first + i] : 0;
        x[i] = (float)(index % (ulong)l->size_x);
        y[i] = (float)(index / (ulong)l->size_x % (ulong)l->size_y);
        z[i] = (float)(index / (ulong)l->size_x / (ulong)l->size_y);
    }
    const Vector corners = {LANES_LOAD(x, 0), LANES_LOAD(y, 0), LANES_LOAD(z, 0)};
    return corners;
}

/// The normals of a packet's voxels.
static inline Vector kept_normals(global const float* restrict voxel_normals, uint first,
                                  uint end) {
    float n[3][VXL_LANES];
    for (uint i = 0; i < VXL_LANES; ++i)
        for (uint axis = 0; axis < 3; ++axis)
            n[axis][i] = first + i < end ? voxel_normals[3 * (size_t)(first + i) + axis] : 0.0f;
    const Vector normals = {LANES_LOAD(n[0], 0), LANES_LOAD(n[1], 0), LANES_LOAD(n[2], 0)};
    return normals;
}

/// The planes that stand for the surfaces in a packet's voxels. Points are in lattice voxels from
/// the voxels' corners.
typedef struct {
    Vector point, normal;
    lane_int by_x, by_y, by_z;  // masks: the axis that the plane faces most
} SamplePlane;

/// The component of a metric normal along a lattice axis, as the derivative by that lattice
/// coordinate. Three of them are a normal in the lattice.
static inline lane_float along_axis(float4 axis, float4 edge, Vector normal) {
    return fma(normal.x, axis.x * edge.x,
               fma(normal.y, axis.y * edge.y, normal.z * (axis.z * edge.z)));
}

static inline SamplePlane sample_plane(const DisplayLattice* l, float4 edge, Vector point,
                                       Vector metric_normal) {
    SamplePlane s;
    s.point = point;
    const Vector n = {along_axis(l->axis_x, edge, metric_normal),
                      along_axis(l->axis_y, edge, metric_normal),
                      along_axis(l->axis_z, edge, metric_normal)};
    s.normal = n;
    const lane_float x = fabs(n.x), y = fabs(n.y), z = fabs(n.z);
    s.by_x = LANE_MASK(x >= y) & LANE_MASK(x >= z) & LANE_MASK(x > 0.0f);
    s.by_y = ~s.by_x & LANE_MASK(y >= z) & LANE_MASK(y > 0.0f);
    s.by_z = ~s.by_x & ~s.by_y & LANE_MASK(z > 0.0f);
    return s;
}

/// Sets `p` to the plane's point above slot `number` of a square of 4^log2 slots in Morton order.
/// The square is the side of the voxel that the plane faces most. Returns the mask of planes that
/// are in their voxels there.
static inline lane_int point_on_plane(const SamplePlane* s, lane_uint number, int log2, Vector* p) {
    lane_uint column = (lane_uint)0u, row = (lane_uint)0u;
    for (int bit = 0; bit < log2; ++bit) {
        column |= (number >> 2 * bit & 1u) << bit;
        row |= (number >> (2 * bit + 1) & 1u) << bit;
    }
    const float part = exact_quotient(1.0f, (float)(1 << log2));
    const lane_float u = (LANES_FLOAT(LANES_AS_INT(column)) + 0.5f) * part,
                     v = (LANES_FLOAT(LANES_AS_INT(row)) + 0.5f) * part;
    const Vector n = s->normal, at = s->point;
    // The two coordinates across the axis, and how the plane rises along them.
    const lane_float a = u - LANES_SELECT(s->by_x, at.y, at.x),
                     b = v - LANES_SELECT(s->by_z, at.y, at.z),
                     along_a = LANES_SELECT(s->by_x, n.y, n.x),
                     along_b = LANES_SELECT(s->by_z, n.y, n.z);
    const lane_int some = s->by_x | s->by_y | s->by_z;
    const lane_float up = LANES_SELECT(s->by_x, n.x, LANES_SELECT(s->by_y, n.y, n.z)),
                     from = LANES_SELECT(s->by_x, at.x, LANES_SELECT(s->by_y, at.y, at.z));
    const lane_float height =
        from - exact_divide(fma(a, along_a, b * along_b), LANES_SELECT(some, up, (lane_float)1.0f));
    p->x = LANES_SELECT(s->by_x, height, u);
    p->y = LANES_SELECT(s->by_y, height, LANES_SELECT(s->by_x, u, v));
    p->z = LANES_SELECT(s->by_z, height, v);
    const float slack = 0.5f * VXL_SAMPLE_SLACK;
    return some & LANE_MASK(height >= -slack) & LANE_MASK(height <= 1.0f + slack);
}

/// Sets `p` to sample `sample` of `samples` on each plane: one of the slots whose points lie in the
/// voxel, from the sample's part of their order. `shift`, in 0 .. 1, chooses within that part.
/// Returns the mask of planes that have such a slot.
static inline lane_int sample_on_plane(const SamplePlane* s, uint sample, uint samples,
                                       lane_float shift, int log2, Vector* p, lane_float* area) {
    const uint slot_count = 1u << 2 * log2;
    lane_uint count = (lane_uint)0u;
    for (uint i = 0; i < slot_count; ++i)
        count += LANES_AS_UINT(point_on_plane(s, (lane_uint)i, log2, p)) & 1u;
    const Vector n = s->normal;
    const lane_float size = fmax(fmax(fabs(n.x), fabs(n.y)), fabs(n.z));
    *area = exact_divide(LANES_FLOAT(LANES_AS_INT(count)) * exact_sqrt(dot_product(n, n)),
                         LANES_SELECT(LANE_MASK(size > 0.0f), size, (lane_float)1.0f));
    const lane_float in_order = ((float)sample + shift) * LANES_FLOAT(LANES_AS_INT(count)) *
                                exact_quotient(1.0f, (float)samples);
    const lane_uint wanted =
        LANES_AS_UINT(clamp(LANES_INT(in_order), (lane_int)0, LANES_AS_INT(count) - 1));
    lane_uint seen = (lane_uint)0u, chosen = (lane_uint)0u;
    for (uint i = 0; i < slot_count; ++i) {
        const lane_int inside = point_on_plane(s, (lane_uint)i, log2, p);
        chosen = LANES_SELECT(inside & LANE_MASK(seen == wanted), (lane_uint)i, chosen);
        seen += LANES_AS_UINT(inside) & 1u;
    }
    return point_on_plane(s, chosen, log2, p) & LANE_MASK(count != 0u);
}

/// A hash in 0 .. 1 for each of a packet's voxels, plus `turn`, modulo 1. It places neighbouring
/// voxels' samples differently.
static inline lane_float voxel_shift(global const ulong* restrict indices, uint first, uint end,
                                     float turn) {
    float shift[VXL_LANES];
    for (uint i = 0; i < VXL_LANES; ++i) {
        const ulong index = first + i < end ? indices[first + i] : 0;
        uint mixed = (uint)index ^ (uint)(index >> 32);
        mixed = (mixed ^ mixed >> 16) * 0x7FEB352Du;
        mixed = (mixed ^ mixed >> 15) * 0x846CA68Bu;
        shift[i] = (float)(mixed >> 8) * 0x1p-24f + turn;
    }
    const lane_float sum = LANES_LOAD(shift, 0);
    return sum - floor(sum);
}

/// Aims rays at samples of voxels first_voxel .. first_voxel+count-1, and writes the rays' weights.
/// Where there is nothing to aim at, rays are idle. `turns` holds for each sample what is added to
/// the voxels' shifts.
kernel void aim_samples(VXL_VIEW_PARAMETERS, VXL_POINTS_PARAMETERS,
                        global const ulong* restrict indices,
                        global const float* restrict voxel_normals, SampleAim aim,
                        global const float* restrict turns, uint first_voxel, uint count,
                        uint stride, global float* restrict weights, global float* restrict rays) {
    const uint first = work_item() * VXL_LANES, group = first / 16u;
    if (first >= (count + 15u) / 16u * 16u * aim.count) return;
    const uint at = group / aim.count * 16u + first % 16u, sample = group % aim.count;
    const ProbePoints all = VXL_POINTS;
    const uint voxel = first_voxel + at;
    Vector point = load_vector(all.points + first_voxel, all.total, at);
    const lane_uint known = LANES_LOAD(all.views, voxel);
    lane_int aimed =
        LANE_MASK(LANES_NUMBERS + (int)at < (int)count) & LANE_MASK(known != 0xFFFFFFFFu);
    if (aim.samples > 0u) {
        const Vector corner = voxel_corners(&lattice, indices, voxel, first_voxel + count);
        const Vector in_voxel = {point.x - corner.x, point.y - corner.y, point.z - corner.z};
        const Vector normal = kept_normals(voxel_normals, voxel, first_voxel + count);
        const SamplePlane plane = sample_plane(&lattice, shape.edge, in_voxel, normal);
        aimed &= LANE_MASK(normal.y >= -VXL_LOOKS_DOWN);
        const lane_float shift =
            voxel_shift(indices, voxel, first_voxel + count, turns[aim.number + sample]);
        Vector p;
        lane_float area;
        aimed &= aim.axis == 0 ? plane.by_x : aim.axis == 1 ? plane.by_y : plane.by_z;
        aimed &=
            sample_on_plane(&plane, aim.sample + sample, aim.samples, shift, aim.log2, &p, &area);
        point.x = corner.x + p.x, point.y = corner.y + p.y, point.z = corner.z + p.z;
        LANES_STORE(LANES_SELECT(aimed, area, (lane_float)0.0f), weights, first);
    }
    ProbeWay way = way_from_eye(&camera, shape.edge, point_in_world(&lattice, point));
    look_along_views(views, known & LANES_AS_UINT(aimed), &way);
    way.aimed &= aimed;
    store_ways(shape, &lattice, &way, 0, rays, stride, first);
}

/// A lattice coordinate of points in the world's voxels.
static inline lane_float lattice_coordinate(float4 row, Vector p) {
    return fma(p.x, row.x, fma(p.y, row.y, fma(p.z, row.z, row.w)));
}

static inline lane_int is_within(lane_float coordinate, lane_float corner) {
    return LANE_MASK(coordinate >= corner - VXL_SAMPLE_SLACK) &
           LANE_MASK(coordinate <= corner + (1.0f + VXL_SAMPLE_SLACK));
}

/// Adds the light of the rays of `samples` samples, which aim_samples aimed, to their voxels' sums:
/// of colours times weights, and of weights, which are areas times opacities. The sums of the first
/// voxel are number `first_sum`.
kernel void add_samples(PyramidShape shape, DisplayLattice lattice, VXL_SPACE_MEDIUM_PARAMETERS,
                        VXL_BATCH_PARAMETERS, VXL_NODE_PARAMETERS,
                        global const ulong* restrict indices, global const float* restrict weights,
                        uint first_voxel, uint count, uint samples, uint first_sum,
                        global float* restrict sums) {
    const uint at = work_item() * VXL_LANES;
    if (at >= count) return;
    const RayBatch batch = VXL_BATCH;
    const NodeLight nodes = VXL_NODES;
    const SpaceMedium medium = VXL_SPACE_MEDIUM;
    const Vector corner = voxel_corners(&lattice, indices, first_voxel + at, first_voxel + count);
    for (uint sample = 0; sample < samples; ++sample) {
        const uint first = (at / 16u * samples + sample) * 16u + at % 16u;
        const SeenLight seen = seen_light(shape, &medium, &batch, &nodes, first);
        const lane_int aimed = LANE_MASK(LANES_LOAD(rays, VXL_RAY_END * stride + first) >= 0.0f);
        const lane_int counts = seen.hit & aimed &
                                is_within(lattice_coordinate(lattice.row_x, seen.point), corner.x) &
                                is_within(lattice_coordinate(lattice.row_y, seen.point), corner.y) &
                                is_within(lattice_coordinate(lattice.row_z, seen.point), corner.z);
        float color[3 * VXL_LANES], opacity[VXL_LANES];
        int added[VXL_LANES];
        for (uint channel = 0; channel < 3; ++channel)
            LANES_STORE(seen.color[channel], color, channel * VXL_LANES);
        LANES_STORE(seen.opacity, opacity, 0);
        LANES_STORE(counts, added, 0);
        for (uint i = 0; i < VXL_LANES && at + i < count; ++i) {
            if (!added[i]) continue;
            global float* sum = sums + 4 * (size_t)(first_sum + at + i);
            const float weight = opacity[i] * weights[first + i];
            for (uint channel = 0; channel < 3; ++channel)
                sum[channel] += weight * color[channel * VXL_LANES + i];
            sum[3] += weight;
        }
    }
}

/// Gives voxels the mean light of their samples. Voxels without samples keep the light of their
/// probe point, but with `clears_others` they lose their object.
kernel void mix_samples(uint count, global const float* restrict sums, uint clears_others,
                        global float* restrict colors, global uint* restrict objects) {
    const uint voxel = work_item();
    if (voxel >= count) return;
    const float weight = sums[4 * (size_t)voxel + 3];
    if (!(weight > 0.0f)) {
        if (clears_others) objects[voxel] = 0u;
        return;
    }
    for (uint channel = 0; channel < 3; ++channel)
        colors[3 * (size_t)voxel + channel] =
            exact_quotient(sums[4 * (size_t)voxel + channel], weight);
}
