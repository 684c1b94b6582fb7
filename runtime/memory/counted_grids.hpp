// SPDX-License-Identifier: Apache-2.0
// scene -> the grids of its objects on a counting device, each made once, as GridCache does.
#pragma once

#include <map>
#include <vector>

#include "runtime/analysis/placed_objects.hpp"
#include "runtime/memory/object_counts.hpp"

namespace voxelume {

/// A grid with what making and keeping it takes of the device.
struct CountedGrid {
    int model = 0;
    int object = -1;  ///< whose grid it is alone; -1 for a model's, which objects share
    GridCounts counts;
    SharedGrid grid = {};
    double made_bytes = 0;  ///< the maximum while it is made, its own bytes included
    double kept_bytes = 0;  ///< its own bytes
    std::string largest_buffer = {};
    double largest_bytes = 0;
};

/// A mesh's grid, freed again.
CountedGrid count_mesh(const Device& device, const GridCounts& counts);

class CountedGrids {
  public:
    CountedGrids(const Device& device, const Scene& scene, AssetStore& meshes,
                 ObjectCounts& objects, Estimate estimate)
        : device_(device), scene_(scene), meshes_(meshes), objects_(objects), estimate_(estimate) {}

    /// The grid that shows an object in the world, and that of its model, whole, in its own space.
    SharedGrid world_grid(const Object& object, const Model& model, const ObjectLattice& lattice);
    SharedGrid own_grid(const Object& object, const Model& model);

    const std::vector<CountedGrid>& all() const { return grids_; }
    const GridCounts& counts_of(const SharedGrid& grid) const;

    /// Frees the grids; what they take is still known.
    void forget();

  private:
    SharedGrid model_grid(const Object& object, const Model& model, const GridFrame& frame);
    SharedGrid make(CountedGrid counted, const Model& model);
    SharedGrid found(int model, int object, const GridFrame& frame) const;

    const Device& device_;
    const Scene& scene_;
    AssetStore& meshes_;
    ObjectCounts& objects_;
    Estimate estimate_;
    std::vector<CountedGrid> grids_;
    std::vector<BrickGrid> bodies_;  ///< of meshes that are cut
};

}  // namespace voxelume
