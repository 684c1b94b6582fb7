// scene -> the objects that its world's voxels are placed from.
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "runtime/assets/asset_store.hpp"
#include "runtime/scene/scene.hpp"
#include "runtime/stages/place/place.hpp"
#include "runtime/world/grid_cache.hpp"

namespace voxelume {

/// Gives an object, that shows `model`, its grid.
using GridSource = std::function<SharedGrid(const Object& object, const Model& model)>;

/// The scene's objects that lie in the world, by their `boxes`, but for instances; `grids` keeps
/// what they name.
std::vector<PlacedObject> placed_objects(const Scene& scene, AssetStore& meshes,
                                         std::span<const VoxelBox> boxes, const GridSource& grid_of,
                                         std::vector<SharedGrid>& grids);

}  // namespace voxelume
