// SPDX-License-Identifier: Apache-2.0
// The keys of a model that describe its voxels.
#pragma once

#include <glm/vec3.hpp>

#include "runtime/scene/parts/object.hpp"
#include "runtime/scene_file/document/scene_fields.hpp"

namespace voxelume {

/// Reads the surface of a model. Without one, or with `auto`, it is left to the files, and `usual`
/// is used until they are read; solids are exact.
void read_surface(const SceneFields& fields, Surface usual, Model& model);

/// The pitch, surface, set and normals of a model, whose source is already read.
void read_lattice(const SceneFields& fields, glm::dvec3 world_voxel_size, Model& model);

/// The shading of a mesh, which counts where the mesh is exact, or its cubes have its normals.
Shading read_shading(const SceneFields& fields);

}  // namespace voxelume
