// SPDX-License-Identifier: Apache-2.0
// scene -> the objects that are placed in its world's voxels, those that are instances, and the
// grids that they show.
#pragma once

#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "runtime/analysis/object_lattice.hpp"
#include "runtime/assets/asset_store.hpp"
#include "runtime/scene/scene.hpp"
#include "runtime/stages/place/place.hpp"

namespace voxelume {

using SharedGrid = std::shared_ptr<const BrickGrid>;

/// Returns the grid of an object that shows `model`, on `lattice`, which may be the model's own.
using PlacedGridSource = std::function<SharedGrid(const Object& object, const Model& model,
                                                  const ObjectLattice& lattice)>;
using GridSource = std::function<SharedGrid(const Object& object, const Model& model)>;

/// The scene's objects that lie in the world according to their `boxes`, without instances. `grids`
/// keeps the grids that the objects refer to. Throws as ObjectLattices does.
std::vector<PlacedObject> placed_objects(const Scene& scene, AssetStore& meshes,
                                         std::span<const VoxelBox> boxes,
                                         const PlacedGridSource& grid_of,
                                         std::vector<SharedGrid>& grids);

/// True if the world gets voxels inside of an object's surface, too: rays may come there.
bool keeps_inside(const Scene& scene, const Object& object, const Model& model);

/// A scene's instances with the grids of their models.
struct ListedInstances {
    std::vector<SharedGrid> grids;  ///< the grid of each model, numbered as in `list`
    std::vector<Instance> list;
    std::vector<uint32_t> materials;  ///< the materials of the models' groups
};

/// Lists a scene's instances with the grids that `grid_of` returns for their models, whole, in
/// their own frames. Throws as `grid_of` and materials_of_groups do, and Error::scene for a model
/// some of whose voxels let light through.
ListedInstances list_instances(const Scene& scene, AssetStore& meshes, const GridSource& grid_of);

}  // namespace voxelume
