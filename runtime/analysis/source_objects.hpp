// SPDX-License-Identifier: Apache-2.0
// scene -> the smooth objects that show the textures of their meshes.
#pragma once

#include <cstdint>
#include <vector>

#include "runtime/assets/asset_store.hpp"
#include "runtime/scene/scene.hpp"

namespace voxelume {

/// An object whose hits are looked up in the mesh that it was made of.
struct SourceObject {
    uint32_t object = 0;  ///< its number in the scene
    uint32_t model = 0;   ///< index into ListedSources::models
};

struct ListedSources {
    std::vector<int> models;  ///< numbers of the scene's models, each once
    std::vector<SourceObject> objects;
};

/// The potentially visible smooth objects whose mesh files have textures.
ListedSources list_sources(const Scene& scene, AssetStore& meshes);

}  // namespace voxelume
