// SPDX-License-Identifier: Apache-2.0
// The position of a grid's voxels in its space, and boxes of voxels.
#pragma once

#include <cstddef>
#include <glm/common.hpp>
#include <glm/vec3.hpp>
#include <glm/vector_relational.hpp>

namespace voxelume {

inline constexpr int kLeafSize = 4;     ///< voxels along a leaf's edge
inline constexpr int kBrickSize = 16;   ///< voxels along a brick's edge
inline constexpr int kSectorSize = 64;  ///< voxels along a sector's edge
inline constexpr size_t kVoxelsPerBrick = 4096, kLeavesPerBrick = 64;
inline constexpr size_t kFloatsPerTriangle = 9;

/// The margin of empty voxels around a model, whether it is voxelized or comes from a file. The
/// differences of a smooth surface lie inside it.
inline constexpr int kModelMargin = 4;

/// The position and the size of a grid's voxels: voxel (i,j,k) fills origin + edge * [(i,j,k),
/// (i,j,k)+1].
struct GridFrame {
    glm::dvec3 origin{0};      ///< minimum corner of voxel (0,0,0), metres in the grid's space
    glm::dvec3 voxel_edge{1};  ///< metres
    glm::ivec3 size{0};        ///< voxels

    /// Number of bricks along each axis: enough for nodes 0..size, so a grid of 16 voxels has two.
    glm::ivec3 bricks() const { return size / kBrickSize + 1; }
    glm::ivec3 sectors() const { return (size + kSectorSize - 1) / kSectorSize; }

    friend bool operator==(const GridFrame&, const GridFrame&) = default;
};

/// An axis-parallel box in a grid's voxels; empty if `low` exceeds `high` on any axis.
struct VoxelBox {
    glm::dvec3 low{0}, high{-1};
};

/// The number of voxels around an object's box in which it may influence the world: distances are
/// painted by whole leaves, and gradients of smooth surfaces read two nodes farther.
inline constexpr double kInfluence = 8;

/// True if two boxes share a point.
inline bool overlap(const VoxelBox& a, const VoxelBox& b) {
    return glm::all(glm::lessThanEqual(glm::max(a.low, b.low), glm::min(a.high, b.high)));
}

inline bool is_empty(const VoxelBox& box) {
    return !overlap(box, box);
}

}  // namespace voxelume
