// SPDX-License-Identifier: Apache-2.0
// OpenVDB's narrow-band level sets of meshes, three voxels wide on each side.
#pragma once

#include <openvdb/openvdb.h>

#include <glm/mat4x4.hpp>

#include "runtime/geometry/mesh.hpp"

namespace voxelume {

openvdb::FloatGrid::Ptr level_set(const Mesh& mesh, double voxel);

/// The level set of the mesh after an affine map, sampled trilinearly from its own.
openvdb::FloatGrid::Ptr placed_level_set(openvdb::FloatGrid& grid, double voxel,
                                         const glm::dmat4& world_from_object);

}  // namespace voxelume
