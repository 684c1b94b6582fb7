// SPDX-License-Identifier: Apache-2.0
// The placement of an object's voxels in the world, as the exact fixed-point map that kernels use.
#pragma once

#include <array>
#include <cstdint>
#include <glm/mat4x4.hpp>

#include "runtime/grid/grid_frame.hpp"

namespace voxelume {

/// The inverse map, from world voxels to object voxels.
struct PlacementMap {
    /// Three rows of three coefficients and an offset each, then the reach along each object axis;
    /// see lib/voxelize/placed.h. All are multiplied by 2^fraction_bits.
    std::array<int64_t, 16> rows{};
    int fraction_bits = 0;
    double distance_scale = 1;  ///< lower bound of world distance units per object distance unit
    bool has_reach = false;

    friend bool operator==(const PlacementMap&, const PlacementMap&) = default;
};

/// The distance from its centre's image at which a world voxel looks for occupied voxels of the
/// object.
enum class Reach {
    none,        ///< distances: only the corners of the node's cell
    supercover,  ///< far enough for sets that are tight against paths through corners
    thin,        ///< far enough for sets that are tight against paths through faces
};

/// The maximum number of voxels of an object's frame along an edge of the world's voxels, seen
/// through the object's map: 1 for equal lattices, however they are turned against each other. Not
/// finite for a singular map.
double voxels_per_world_voxel(const GridFrame& object_frame, const GridFrame& world_frame,
                              const glm::dmat4& world_from_object);

/// True if the nodes of both lattices coincide: the map turns by quarters, mirrors and moves by
/// whole voxels of equal size. Placing then copies.
bool maps_nodes_to_nodes(const GridFrame& object_frame, const GridFrame& world_frame,
                         const glm::dmat4& world_from_object);

/// The matrix from gradients in the world's voxels to those in the object's. It is 0 for a map that
/// makes each voxel of the world equal to one of the object's, apart from shifts by parts of a
/// voxel: one that only shifts, turns by quarters or mirrors.
glm::dmat3 gradients_in_object(const GridFrame& object_frame, const GridFrame& world_frame,
                               const glm::dmat4& world_from_object);

/// Refuses a map that is singular, has a condition number above 10^5 or holds an infinity by
/// Error::scene. `object` is the object's number in messages.
void check_invertible(const glm::dmat4& map, uint32_t object);

/// Inverts `world_from_object` in double precision and rounds the result to fixed point.
///
/// Offsets are rounded to 2^-24 object voxels and coefficients to 2^-24 or finer. So decimal voxel
/// edges and positions that are whole or half voxels in the scene are so here, too, and moving an
/// object by whole voxels moves its image exactly. Throws Error::scene as check_invertible does,
/// and if the map puts the object too far away to be exact.
PlacementMap placement_map(const GridFrame& object_frame, const GridFrame& world_frame,
                           const glm::dmat4& world_from_object, Reach reach, uint32_t object);

}  // namespace voxelume
