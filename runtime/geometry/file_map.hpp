// SPDX-License-Identifier: Apache-2.0
// meshes and voxels in a file's coordinates -> the same in object space; boxes around voxels.
#pragma once

#include <filesystem>

#include "runtime/geometry/mesh.hpp"
#include "runtime/geometry/mesh_summary.hpp"
#include "runtime/geometry/voxel_model.hpp"
#include "runtime/scene/parts/object.hpp"

namespace voxelume {

/// Moves all positions; each becomes the float that is nearest to the exact one. Throws
/// Error::input, naming the file, for one that no float can hold.
void apply(const FileMap& map, const std::filesystem::path& file, Mesh& mesh);

/// Moves the lattice, and the mesh if there is one. Throws as for a mesh.
void apply(const FileMap& map, const std::filesystem::path& file, VoxelModel& voxels);

/// The summary of the mesh after `apply`. Boxes are exact; areas are rounded in another order.
MeshSummary mapped(const FileMap& map, const MeshSummary& summary);

/// The box around occupied voxels, around those that a smooth surface may pass, or around the
/// triangles of an exact one.
Bounds occupied_bounds(const VoxelModel& voxels);

}  // namespace voxelume
