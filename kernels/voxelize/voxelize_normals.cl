// SPDX-License-Identifier: Apache-2.0
// analytic solid -> the normals of its cubes.
#include "lib/lanes/work_item.h"
#include "lib/solid/solid_surface.h"
#include "lib/surface/packed_normal.h"

/// Writes the normals of VXL_LANES neighbouring voxels of a stored brick: the gradients of the
/// solid's formula at their centres, in voxels.
kernel void normals_of_solid(global const SolidShape* restrict solids,
                             global const uint* restrict coordinates, int4 bricks, uint first_brick,
                             uint voxel_count, global uint* restrict normals) {
    const uint number = work_item() * VXL_LANES;
    if (number >= voxel_count) return;
    const uint slot = first_brick + (number >> 12), voxel = number & 4095u;
    const int brick = (int)coordinates[slot];
    const int row = brick / bricks.x;
    const float x = (float)((brick - row * bricks.x) * 16 + (int)(voxel & 15u)) + 0.5f;
    const float y = (float)(row % bricks.y * 16 + (int)(voxel >> 4 & 15u)) + 0.5f;
    const float z = (float)(row / bricks.y * 16 + (int)(voxel >> 8)) + 0.5f;
    // With t = 0, solid_normal evaluates the origin of the ray, so the direction doesn't matter.
    const lane_float one = (lane_float)1.0f;
    const SolidRay ray = {
        LANES_FLOAT(LANES_NUMBERS) + x, (lane_float)y, (lane_float)z, one, one, one};
    const SolidPoint n = solid_normal(solids, 0, &ray, (lane_float)0.0f);
    const lane_float longest = fmax(fabs(n.x), fmax(fabs(n.y), fabs(n.z)));
    const lane_int some = LANE_MASK(longest > 0.0f);
    const lane_float inverse =
        exact_divide((lane_float)1.0f, LANES_SELECT(some, longest, (lane_float)1.0f));
    LANES_STORE(pack_components(n.x * inverse, n.y * inverse, n.z * inverse), normals,
                ((size_t)slot << 12) + voxel);
}
