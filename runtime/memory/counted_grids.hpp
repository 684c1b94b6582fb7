// SPDX-License-Identifier: Apache-2.0
// scene -> the grids of its objects on a counting device, each made once, as GridCache does.
#pragma once

#include <functional>
#include <map>
#include <vector>

#include "runtime/analysis/placed_objects.hpp"
#include "runtime/memory/count/object_counts.hpp"

namespace voxelume {

/// A grid, and the device memory that making and keeping it takes.
struct CountedGrid {
    int model = 0;
    int object = -1;  ///< the object that alone shows it; -1: a model's, which objects share
    bool is_thin_part = false;  ///< true for the grid of the model's thin parts
    GridCounts counts;
    SharedGrid grid = {};
    double made_bytes = 0;  ///< the maximum while it is made, its own bytes included
    double kept_bytes = 0;  ///< its own bytes
    std::string largest_buffer = {};
    double largest_bytes = 0;
};

/// Counts making a mesh's grid, which is freed again.
CountedGrid count_mesh(const Device& device, const GridCounts& counts);

/// The scene's instances, and the counts of their models' grids.
struct CountedInstances {
    ListedInstances listed;
    std::vector<WorldCounts> models;  ///< counts of each of the listed grids
};

class CountedGrids {
  public:
    CountedGrids(const Device& device, const Scene& scene, AssetStore& meshes,
                 ObjectCounts& objects, Estimate estimate)
        : device_(device), scene_(scene), meshes_(meshes), objects_(objects), estimate_(estimate) {}

    /// The scene's instances, with the grids of their models. Throws as list_instances does.
    CountedInstances instances();

    /// The objects that are placed in the world; their grids stay in memory until `forget`. Throws
    /// as placed_objects does, and Error::limit for an exact mesh in a world that is too large for
    /// it.
    std::vector<PlacedObject> placed();

    const std::vector<CountedGrid>& all() const { return grids_; }

    /// Makes the grids again for which `is_changed` is true, while the old grids are still in
    /// memory.
    std::vector<BrickGrid> make_again(const std::function<bool(const CountedGrid&)>& is_changed);

    /// Frees the grids for which `is_old` is true; their numbers of bytes are kept.
    void forget_if(const std::function<bool(const CountedGrid&)>& is_old);

  private:
    SharedGrid world_grid(const Object& object, const Model& model, const ObjectLattice& lattice);
    SharedGrid own_grid(const Object& object, const Model& model);
    SharedGrid model_grid(const Object& object, const Model& model, const GridFrame& frame);
    const GridCounts& counts_of(const SharedGrid& grid) const;
    SharedGrid make(CountedGrid counted, const Model& model);
    BrickGrid grid_of(const GridCounts& counts, const Model& model);
    /// The grid of a model that objects share, if it is there.
    SharedGrid found(const Object& object, const Model& model, const GridFrame& frame) const;

    const Device& device_;
    const Scene& scene_;
    AssetStore& meshes_;
    ObjectCounts& objects_;
    Estimate estimate_;
    std::vector<CountedGrid> grids_;
    std::vector<BrickGrid> bodies_;  ///< bodies of meshes that are cut
};

}  // namespace voxelume
