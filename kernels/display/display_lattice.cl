// SPDX-License-Identifier: Apache-2.0
// probe points -> P in the layout `lattice`: the voxels that are shown, and the point of each.
//
// Probe points are in lattice voxels, in three arrays `total` apart. On a probe line two of their
// coordinates are exact, so a point on voxels' edges belongs to all these voxels. A mask with one
// bit for every voxel of the lattice, by index x + size_x (y + size_y z), tells which voxels are
// shown. The voxels of each group of 256 bits are numbered from their group's start.
#include "lib/display/depth.h"
#include "lib/display/lattice_mask.h"
#include "lib/display/probe.h"
#include "lib/display/voxel_light.h"
#include "lib/display/voxels.h"
#include "lib/lanes/fixed_point.h"
#include "lib/lanes/vector.h"
#include "lib/lanes/work_item.h"
#include "lib/light/paths.h"
#include "lib/traverse/display_shape.h"
#include "lib/traverse/ray_batch.h"
#include "shared/display.h"
#include "shared/scene.h"
#include "shared/trace.h"
#include "shared/voxel.h"

/// Aims a ray at each of the probe points first_point .. first_point+count-1: from E where the
/// point's view is 0, else along views[view], a vector as long as the world in voxels. Points
/// without a view (0xFFFFFFFF) get idle rays. With `search`, all views are `search - 1`, points
/// that already have a view are idle, and rays end where the point would be hidden. Without
/// `search`, rays begin shortly before the point and end shortly behind it.
kernel void aim_rays(VXL_VIEW_PARAMETERS, VXL_POINTS_PARAMETERS, uint search, uint first_point,
                     uint count, uint stride, global float* restrict rays) {
    const uint first = work_item() * VXL_LANES;
    if (first >= count) return;
    const ProbePoints all = VXL_POINTS;
    const Vector at = load_vector(all.points + first_point, all.total, first);
    const lane_uint known = LANES_LOAD(all.views, first_point + first);
    lane_int aimed = LANE_MASK(LANES_NUMBERS + (int)first < (int)count);
    const lane_int has_view = LANE_MASK(known != 0xFFFFFFFFu);
    aimed &= search ? ~has_view : has_view;
    const lane_uint view = (search ? (lane_uint)(search - 1u) : known) & LANES_AS_UINT(aimed);
    ProbeWay way = way_from_eye(&camera, shape.edge, point_in_world(&lattice, at));
    look_along_views(views, view, &way);
    way.aimed &= aimed;
    store_ways(shape, &lattice, &way, search, rays, stride, first);
}

/// For the rays of a layer that meet nothing, notes whether they end in an object.
kernel void note_objects(VXL_BATCH_PARAMETERS, uint is_first, uint count,
                         global uint* restrict in_object) {
    const uint n = work_item();
    const RayBatch batch = VXL_BATCH;
    if (n >= count || batch.rays[VXL_RAY_END * stride + n] < 0.0f) return;
    if (batch.hits[VXL_HIT_VOXEL * stride + n] != VXL_NO_VOXEL) return;
    in_object[is_first ? n : batch.paths[VXL_PATH_TARGET * stride + n]] = inside[n] != 0u;
}

/// Gives `view` to those of the points first_point .. first_point+count-1 that have no view and are
/// not hidden in this one: their rays meet nothing or, where surfaces let light through, surfaces
/// that cover at most `maximum`. With `outside_objects`, points in objects get no view.
kernel void note_view(global const uint* restrict hits, global const float* restrict coverage,
                      global const uint* restrict in_object, uint outside_objects, uint first_point,
                      uint count, uint stride, uint view, float maximum,
                      global uint* restrict view_of_point) {
    const uint n = work_item();
    if (n >= count || view_of_point[first_point + n] != 0xFFFFFFFFu) return;
    bool is_clear = VXL_TRANSMISSION ? coverage[n] <= maximum
                                     : hits[VXL_HIT_VOXEL * stride + n] == VXL_NO_VOXEL;
    if (VXL_TRANSMISSION && outside_objects) is_clear &= in_object[n] == 0u;
    if (is_clear) view_of_point[first_point + n] = view;
}

/// Marks the voxels of the points that have a view.
kernel void mark_shown(DisplayLattice lattice, VXL_POINTS_PARAMETERS, global uint* restrict mask) {
    const uint n = work_item();
    if (n >= point_count || view_of_point[n] == 0xFFFFFFFFu) return;
    const float3 point = load_point(points, total, n);
    for (uint which = 0; which < 8; ++which) {
        const int4 v = voxel_at(&lattice, point, which);
        if (v.x < 0) continue;
        const size_t index = index_of(&lattice, v);
        const uint bit = 1u << (index & 31u);
        if (!(mask[index >> 5] & bit)) atomic_or(mask + (index >> 5), bit);
    }
}

/// Counts the voxels of each group of the mask.
kernel void count_groups(global const uint* restrict mask, uint count,
                         global uint* restrict counts) {
    const uint group = work_item();
    if (group >= count) return;
    uint sum = 0;
    for (uint i = 0; i < VXL_GROUP_WORDS; ++i)
        sum += popcount(mask[(size_t)group * VXL_GROUP_WORDS + i]);
    counts[group] = sum;
}

/// Lists the indices of the marked voxels in ascending order.
kernel void list_indices(global const uint* restrict mask, global const uint* restrict starts,
                         uint count, global ulong* restrict indices) {
    const uint group = work_item();
    if (group >= count) return;
    uint voxel = starts[group];
    for (uint i = 0; i < VXL_GROUP_WORDS; ++i) {
        const size_t word = (size_t)group * VXL_GROUP_WORDS + i;
        for (uint left = mask[word]; left != 0u; left &= left - 1u)
            indices[voxel++] = (ulong)word * 32u + (31u - clz(left & (0u - left)));
    }
}

/// Chooses for every voxel the point with a view that lies nearest to its middle; among equals, the
/// one with the lowest number. Takes two turns over all points, whose numbers begin at
/// `first_number`: turn 0 finds the smallest distance, turn 1 the lowest number at that distance.
kernel void choose_points(DisplayLattice lattice, VXL_POINTS_PARAMETERS, uint first_number,
                          global const uint* restrict mask, global const uint* restrict starts,
                          uint turn, global uint* restrict distances,
                          global uint* restrict numbers) {
    const uint n = work_item();
    if (n >= point_count || view_of_point[n] == 0xFFFFFFFFu) return;
    const float3 point = load_point(points, total, n);
    for (uint which = 0; which < 8; ++which) {
        const int4 v = voxel_at(&lattice, point, which);
        if (v.x < 0) continue;
        const uint voxel = number_of(mask, starts, index_of(&lattice, v));
        const float x = point.x - (float)v.x - 0.5f, y = point.y - (float)v.y - 0.5f,
                    z = point.z - (float)v.z - 0.5f;
        const uint distance = as_uint(fma(x, x, fma(y, y, z * z)));
        if (turn == 0) {
            if (distance < distances[voxel]) atomic_min(distances + voxel, distance);
        } else if (distances[voxel] == distance) {
            atomic_min(numbers + voxel, first_number + n);
        }
    }
}

/// Copies the points and views of those voxels 0 .. voxels-1 whose points are among these.
kernel void take_points(VXL_POINTS_PARAMETERS, uint first_number,
                        global const uint* restrict numbers, uint voxels, uint voxel_stride,
                        global float* restrict voxel_points, global uint* restrict voxel_views) {
    const uint voxel = work_item();
    if (voxel >= voxels) return;
    const uint n = numbers[voxel] - first_number;
    if (n >= point_count) return;
    for (uint axis = 0; axis < 3; ++axis)
        voxel_points[axis * voxel_stride + voxel] = points[axis * total + n];
    voxel_views[voxel] = view_of_point[n];
}

/// Adds the light of rays 0 .. count-1 to their voxels. Ray n was aimed at the point of voxel
/// targets[first_voxel + n] or, if not `listed`, of voxel first_voxel + n. Where a ray misses its
/// surface, the voxel gets object 0.
kernel void keep_light(Camera camera, PyramidShape shape, VXL_SPACE_MEDIUM_PARAMETERS,
                       VXL_BATCH_PARAMETERS, VXL_NODE_PARAMETERS,
                       global const uint* restrict targets, uint listed, uint first_voxel,
                       uint count, VXL_VOXEL_PARAMETERS) {
    const uint first = work_item() * VXL_LANES;
    if (first >= count) return;
    const RayBatch batch = VXL_BATCH;
    const NodeLight nodes = VXL_NODES;
    const VoxelArrays voxels = VXL_VOXELS;
    const SpaceMedium medium = VXL_SPACE_MEDIUM;
    const SeenLight seen = seen_light(shape, &medium, &batch, &nodes, first);
    VoxelValues values;
    for (uint channel = 0; channel < 3; ++channel)
        LANES_STORE(seen.color[channel], values.color, channel * VXL_LANES);
    LANES_STORE(depth_of(&camera, shape.edge, from_eye(&camera, seen.point)) + camera.lead,
                values.depth, 0);
    LANES_STORE(seen.opacity, values.opacity, 0);
    LANES_STORE(
        ((LANES_LOAD(hit_attributes, first) & VXL_OBJECT_MASK) + 1u) & LANES_AS_UINT(seen.hit),
        values.object, 0);
    for (uint i = 0; i < VXL_LANES && first + i < count; ++i) {
        const size_t voxel = listed ? targets[first_voxel + first + i] : first_voxel + first + i;
        store_voxel(&voxels, voxel, &values, i);
    }
}
