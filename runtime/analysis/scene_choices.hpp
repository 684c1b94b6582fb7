// SPDX-License-Identifier: Apache-2.0
// scene -> the same scene with the choices made that it leaves to the files of its models
#pragma once

#include "runtime/assets/asset_store.hpp"
#include "runtime/scene/scene.hpp"

namespace voxelume {

/// Makes the choices of a scene as it is read, once for all of its frames:
///   surface    that of a model whose surface is `auto`, by surface_for() its mesh as it is before
///              any morph, or by what its file of voxels holds. A mesh that is cut is smooth.
///   placement  an object whose file has a field finer than the world becomes an instance where
///              `auto` lets it, since there is nothing to make a coarser field from. So do cubes
///              with a surface's normals that are coarser than the world's.
/// Reads the files of objects that may be shown. Throws as AssetStore does.
void make_choices(Scene& scene, AssetStore& meshes);

}  // namespace voxelume
