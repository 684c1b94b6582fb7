// SPDX-License-Identifier: Apache-2.0
// The 64 voxels of a leaf, and their indices in its brick.
#ifndef VXL_LEAF_VOXELS_H
#define VXL_LEAF_VOXELS_H

// The voxels of a leaf that lie less than `room` voxels along each axis from the leaf's minimum
// corner.
static inline ulong mask_within(int4 room) {
    const int4 n = clamp(room, (int4)(0), (int4)(4));  // oclgrind misreads scalar limits
    if (n.x == 0 || n.y == 0 || n.z == 0) return 0;
    const ulong x = 0x1111111111111111ul * ((1ul << n.x) - 1);
    const ulong y = 0x0001000100010001ul * (n.y == 4 ? 0xFFFFul : (1ul << 4 * n.y) - 1);
    const ulong z = n.z == 4 ? ~0ul : (1ul << 16 * n.z) - 1;
    return x & y & z;
}

static inline int4 leaf_origin(int leaf) {
    return (int4)((leaf & 3) << 2, leaf & 12, leaf >> 2 & 12, 0);
}

// The voxel's index among a brick's 4096 values, from its leaf and its bit in the leaf.
static inline int voxel_in_brick(int leaf, int bit) {
    const int4 first = leaf_origin(leaf);
    return (first.x + (bit & 3)) | (first.y + (bit >> 2 & 3)) << 4 | (first.z + (bit >> 4)) << 8;
}

static inline int lowest_bit(ulong mask) {
    return (int)popcount((mask & -mask) - 1);
}

#endif
