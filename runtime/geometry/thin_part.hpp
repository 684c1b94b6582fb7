// SPDX-License-Identifier: Apache-2.0
// mesh -> its parts that are too thin for distances in voxels of some size.
#pragma once

#include <glm/vec3.hpp>
#include <vector>

#include "runtime/geometry/mesh.hpp"

namespace voxelume {

/// Walls of a body are thin below this many voxels.
inline constexpr double kThinVoxels = 2;

/// The parts of a mesh that distances are too coarse to show.
struct ThinPart {
    Mesh mesh;  ///< the triangles around them, with their attributes of the whole mesh
    std::vector<glm::vec3> points;  ///< within the walls, two a voxel along each axis
};

/// The triangles of a closed mesh within at least five voxels of walls that are thinner than
/// kThinVoxels. `voxel_edge` is in metres. Walls are found on lines along the axes, two for each
/// voxel; those of a voxel or two all around, as folds of scanned meshes are, don't count. Empty
/// for a mesh without thin walls, of more than 2048 voxels along an axis, or with too many layers
/// to have an inside.
ThinPart thin_part_of(const Mesh& mesh, double voxel_edge);

}  // namespace voxelume
