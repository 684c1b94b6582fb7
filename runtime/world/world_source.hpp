// scene -> the name of its world, by which it is found on disk.
#pragma once

#include <string>
#include <vector>

#include "runtime/assets/asset_store.hpp"
#include "runtime/scene/scene.hpp"

namespace voxelume {

/// Names all that the voxels of a scene's world are made of: sources, lattices and places of the
/// objects that are placed in it. Meshes whose summaries are known aren't read.
///
/// Empty where nothing is kept: of a scene whose tracks change objects in the world or their
/// models, since its worlds would fill the disk, and of one with a file of voxels, which no hash is
/// taken of.
std::string world_source(const Scene& scene, AssetStore& meshes);

/// Names of worlds that show the same to the observer: of the objects in reach, and that of all
/// objects, if there are others.
std::vector<std::string> world_sources(const Scene& scene, AssetStore& meshes);

}  // namespace voxelume
