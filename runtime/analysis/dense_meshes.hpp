// SPDX-License-Identifier: Apache-2.0
// Exact meshes with many triangles in each of the world's voxels. A ray tests all of a voxel's
// triangles.
//
// Instances of such meshes have finer voxels of their own, so that each lists few triangles.
#pragma once

#include "runtime/assets/asset_store.hpp"
#include "runtime/scene/scene.hpp"

namespace voxelume {

/// The number of triangles of an exact mesh per area of one face of the world's voxels; 0 for an
/// object that shows anything else.
double triangles_per_voxel(const Scene& scene, const Object& object, AssetStore& meshes);

/// True for an object that is faster, and looks the same, as an instance of finer voxels: it shows
/// an exact mesh of many triangles a voxel, whose size the scene doesn't say. The mesh doesn't
/// change, and no side of its box is flush with one of another exact object that overlaps it, since
/// instances have no priority.
bool is_better_divided(const Scene& scene, const Object& object, AssetStore& meshes);

/// A mesh that stays in the world with more triangles per voxel than this gets a warning: a picture
/// of it takes about three times as long as a picture of an instance.
inline constexpr double kTooDenseTriangles = 128;

/// The edges, in metres, of a model's voxels, which are made smaller where instances would have
/// many triangles in each.
glm::dvec3 sparse_voxel_size(const Scene& scene, size_t model, AssetStore& meshes);

}  // namespace voxelume
