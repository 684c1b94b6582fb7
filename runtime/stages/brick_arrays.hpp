// SPDX-License-Identifier: Apache-2.0
// The arrays of a grid's bricks: the device memory of each stored brick, written once.
#pragma once

#include "runtime/grid/grid.hpp"

namespace voxelume {

/// Bricks of a lattice, stored or not.
inline size_t brick_slots(const GridFrame& frame) {
    const glm::ivec3 bricks = frame.bricks();
    return size_t(bricks.x) * size_t(bricks.y) * size_t(bricks.z);
}

/// BrickGrid::slots.
inline Buffer<uint32_t> allocate_slots(const Device& device, const char* name,
                                       const GridFrame& frame) {
    return {device, name, brick_slots(frame)};
}

/// BrickGrid::occupancy, and other arrays with a bit for each voxel.
inline Buffer<uint64_t> allocate_masks(const Device& device, const char* name, size_t bricks) {
    return {device, name, bricks * kLeavesPerBrick};
}

/// BrickGrid::distance, and other arrays with 16 bits for each voxel.
inline Buffer<int16_t> allocate_distances(const Device& device, const char* name, size_t bricks) {
    return {device, name, bricks * kVoxelsPerBrick};
}

/// BrickGrid::attributes and colors, and other arrays with a word for each voxel.
inline Buffer<uint32_t> allocate_words(const Device& device, const char* name, size_t bricks) {
    return {device, name, bricks * kVoxelsPerBrick};
}

/// BrickGrid::primitive_first.
inline Buffer<uint32_t> allocate_list_starts(const Device& device, const char* name,
                                             size_t bricks) {
    return {device, name, bricks * kVoxelsPerBrick + 1};
}

}  // namespace voxelume
