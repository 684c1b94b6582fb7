// SPDX-License-Identifier: Apache-2.0
// models and objects -> brick grids: voxelized once, and kept while frames show them.
#pragma once

#include <memory>
#include <vector>

#include "runtime/analysis/placed_objects.hpp"
#include "runtime/assets/asset_store.hpp"
#include "runtime/assets/model_frame.hpp"
#include "runtime/stages/voxelize/voxelize.hpp"

namespace voxelume {

/// The grids of a scene's objects. A model is voxelized in its own space for all its objects, or in
/// the world for each object. Meshes that an earlier run voxelized are taken from the store's
/// cache.
class GridCache {
  public:
    GridCache(const Device& device, AssetStore& meshes)
        : device_(device), meshes_(meshes), voxelizer_(device) {}

    /// The grid that shows `object`, whose model is `model`, on a lattice. An exact solid is closed
    /// where the lattice ends, unless light goes through it: water that the world's sides cut
    /// continues beyond them. Throws Error::input and Error::limit as voxelizing does, with
    /// messages that begin with the place in the scene.
    SharedGrid grid_of(const Object& object, const Model& model, const ObjectLattice& lattice,
                       bool transmits);

    /// The grid of a model in its own space for instances, also of exact models.
    SharedGrid own_grid_of(const Model& model, bool transmits);

    /// Forgets the grids that weren't asked for since the last call. Grids of a `retained` model
    /// are kept if they are as in `scene` and none of the model was asked for: those made first, up
    /// to `room` bytes of the device. Keeping the first ones helps models that are shown in turns,
    /// which would otherwise displace each other.
    void forget_unused(const Scene& scene, const std::vector<bool>& retained, uint64_t room);

    /// The bytes on the device of unused grids that the last call kept.
    uint64_t retained_bytes() const { return retained_bytes_; }

    uint64_t voxelized() const { return voxelized_; }      ///< grids made so far
    uint64_t from_cache() const { return from_cache_; }    ///< grids taken from the cache so far
    double keep_seconds() const { return keep_seconds_; }  ///< writing grids to the cache

  private:
    /// Everything that a grid depends on.
    struct Source {
        Model model;  ///< without values that only matter to its frame and messages
        glm::dmat4 frame_from_model{1};
        GridFrame frame;
        bool is_open = false;  ///< a solid isn't closed where the frame ends
        friend bool operator==(const Source&, const Source&) = default;
    };
    struct Kept {
        Source source;
        SharedGrid grid;
        bool is_used = true;
    };

    /// `where` begins messages; it is empty if a caller adds the place. `keeps` lets the cache
    /// store the grid. It is false for an object in the world that moves: each frame has another
    /// grid, with many times its mesh's bytes.
    SharedGrid find_or_make(const Model& model, const Source& source, const SourcePlace& where,
                            bool keeps = true);
    bool is_retained(const Scene& scene, const std::vector<bool>& retained,
                     const Source& source) const;
    bool is_old(const Model& model, const Source& source) const;
    static Source body_source(const Model& model, const Source& source, VoxelSet set);
    void use(const Source& source);
    BrickGrid read_or_make(const Model& model, const Source& source, bool keeps);
    BrickGrid make(const Model& model, const Source& source);
    BrickGrid make_cut(const Model& model, const Source& source, bool keeps);

    Device device_;
    AssetStore& meshes_;
    Voxelizer voxelizer_;
    std::vector<Kept> kept_;  ///< in the order in which they were made
    uint64_t retained_bytes_ = 0;
    uint64_t voxelized_ = 0;
    uint64_t from_cache_ = 0;
    double keep_seconds_ = 0;
};

}  // namespace voxelume
