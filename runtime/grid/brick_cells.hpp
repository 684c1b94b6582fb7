// SPDX-License-Identifier: Apache-2.0
// Numbers of bricks, leaves and voxels, and the cells that they stand for: `grid.hpp` has the
// rules.
#pragma once

#include <cstdint>

#include "runtime/grid/grid_frame.hpp"

namespace voxelume {

/// The minimum corner of brick `number` of the frame's table, in voxels.
inline glm::ivec3 brick_corner(const GridFrame& frame, size_t number) {
    const glm::ivec3 bricks = frame.bricks();
    const int i = int(number);
    return kBrickSize * glm::ivec3(i % bricks.x, i / bricks.x % bricks.y, i / bricks.x / bricks.y);
}

/// The number of the brick that has the cell, in a table of `bricks` along each axis.
inline size_t brick_of(const glm::ivec3& cell, const glm::ivec3& bricks) {
    const glm::ivec3 b = cell / kBrickSize;
    return size_t(b.x) + size_t(bricks.x) * (size_t(b.y) + size_t(bricks.y) * size_t(b.z));
}

/// The cell of voxel `number` of a brick, counted from the brick's corner.
inline glm::ivec3 cell_in_brick(size_t number) {
    const int i = int(number);
    return {i & 15, i >> 4 & 15, i >> 8};
}

/// The number of a cell's voxel in its brick. `cell` is counted from the brick's corner.
inline size_t voxel_in_brick(const glm::ivec3& cell) {
    return size_t(cell.x | cell.y << 4 | cell.z << 8);
}

/// The minimum corner of leaf `number` of a brick, counted from the brick's corner.
inline glm::ivec3 leaf_corner(size_t number) {
    const int i = int(number);
    return kLeafSize * glm::ivec3(i & 3, i >> 2 & 3, i >> 4);
}

/// The number of the leaf that has the cell. `cell` is counted from the brick's corner.
inline size_t leaf_in_brick(const glm::ivec3& cell) {
    const glm::ivec3 leaf = cell / kLeafSize;
    return size_t(leaf.x | leaf.y << 2 | leaf.z << 4);
}

/// The cell's bit in the mask of its leaf. `cell` may be counted from any leaf's corner.
inline uint64_t bit_in_leaf(const glm::ivec3& cell) {
    const glm::ivec3 in = cell % kLeafSize;
    return uint64_t{1} << (in.x | in.y << 2 | in.z << 4);
}

/// The cell of bit `number` of a leaf's mask, counted from the leaf's corner.
inline glm::ivec3 cell_in_leaf(int number) {
    return {number & 3, number >> 2 & 3, number >> 4};
}

}  // namespace voxelume
