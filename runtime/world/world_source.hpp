// SPDX-License-Identifier: Apache-2.0
// scene -> the name of its world, under which it is stored on disk.
#pragma once

#include <string>
#include <vector>

#include "runtime/assets/asset_store.hpp"
#include "runtime/scene/scene.hpp"

namespace voxelume {

/// A name of everything from which the voxels of a scene's world are made: sources, lattices and
/// placements of the objects in it. Meshes whose summaries are known aren't read.
///
/// Empty if the world is not stored: for a scene whose tracks change objects in the world or their
/// models, since its worlds would fill the disk, and for one with a file of voxels, which isn't
/// hashed.
std::string world_source(const Scene& scene, AssetStore& meshes);

/// The names of worlds that look the same to the observer: with the potentially visible objects,
/// and with all objects if there are others.
std::vector<std::string> world_sources(const Scene& scene, AssetStore& meshes);

}  // namespace voxelume
