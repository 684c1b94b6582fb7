// SPDX-License-Identifier: Apache-2.0
// frames of a scene -> what is probably wrong with it, as far as that can be told before rendering
#pragma once

#include <span>
#include <vector>

#include "runtime/assets/asset_store.hpp"
#include "runtime/base/warning.hpp"
#include "runtime/scene/scene.hpp"

namespace voxelume {

/// Returns the warnings that hold in all of these `frames` of a scene, so an object that flies into
/// the world gets none. If there are many frames, some are looked at, spread evenly.
///
/// Works on boxes, formulas of solids and summaries of meshes. A mesh is read only if its summary
/// isn't known, or if a light or the observer is in its box. Also says that the cache of `meshes`
/// can't be written. Throws as AssetStore and scene_at do, with the frame.
std::vector<Warning> scene_warnings(const Scene& scene, std::span<const int> frames,
                                    AssetStore& meshes);

}  // namespace voxelume
