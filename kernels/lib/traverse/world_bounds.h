// SPDX-License-Identifier: Apache-2.0
// The bounds of the world: solids that extend beyond them are cut off there, and the cut is a
// surface.
#ifndef VXL_WORLD_BOUNDS_H
#define VXL_WORLD_BOUNDS_H

// S's size in voxels, and half a voxel's edges in distance units.
typedef struct {
    int4 size, half_voxel;
} WorldBounds;

// The depth of a point, given in half voxels, inside the bounds: its distance to the nearest of
// their planes in distance units, at most 32767; negative outside.
static inline int depth_in_world(WorldBounds bounds, int4 half_steps) {
    const int4 steps = min(half_steps, bounds.size * 2 - half_steps);
    const int4 depth = clamp(steps, (int4)(-16), (int4)(16)) * bounds.half_voxel;
    return min(min(depth.x, depth.y), min(depth.z, 32767));
}

// True if a block of `edge` voxels from `first` on touches the bounds, or lies beyond them.
static inline bool is_at_bounds(WorldBounds bounds, int4 first, int edge) {
    return any((first <= 0).xyz) || any((first + edge >= bounds.size).xyz);
}

#endif
