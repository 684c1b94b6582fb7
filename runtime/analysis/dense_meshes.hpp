// SPDX-License-Identifier: Apache-2.0
// Exact meshes with many triangles in each of the world's voxels, all of which a ray there tests.
//
// Instances of them have finer voxels of their own, so that each lists few triangles.
#pragma once

#include "runtime/assets/asset_store.hpp"
#include "runtime/scene/scene.hpp"

namespace voxelume {

/// Triangles of an exact mesh for an area of its surface that is as large as a face of the world's
/// voxels; 0 for an object that shows anything else.
double triangles_per_voxel(const Scene& scene, const Object& object, AssetStore& meshes);

/// From how many on `auto` makes an instance of a mesh. Up to here both take about as long.
inline constexpr double kDenseTriangles = 16;

/// From how many on a mesh that stays in the world is warned of: a ray then takes ten times as
/// long.
inline constexpr double kTooDenseTriangles = 128;

/// The edges, in metres, of a model's voxels, which are made smaller where instances would have
/// many triangles in each.
glm::dvec3 sparse_voxel_size(const Scene& scene, size_t model, AssetStore& meshes);

}  // namespace voxelume
