// SPDX-License-Identifier: Apache-2.0
// object -> what its mesh file lacks, and what it says without effect
#pragma once

#include <string>
#include <vector>

#include "runtime/assets/asset_store.hpp"
#include "runtime/base/warning.hpp"
#include "runtime/geometry/mesh_summary.hpp"
#include "runtime/scene/scene.hpp"

namespace voxelume {

/// Adds what is wrong with the mesh that an object shows: holes and faces that turn inwards, where
/// a surface or material needs an inside; materials and textures that aren't read.
void add_mesh_warnings(const Scene& scene, const Object& object, AssetStore& meshes,
                       std::vector<Warning>& warnings);

/// Returns a sentence on why a mesh has groups whose materials no library has. `missing` isn't
/// empty.
std::string missing_materials_sentence(const std::vector<std::string>& missing,
                                       const MeshSummary& mesh);

}  // namespace voxelume
