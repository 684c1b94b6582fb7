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

/// The grids of a scene's objects. A model is voxelized in its own space for all its objects, or
/// in the world for each object. What the store's cache has of a mesh that an
/// earlier run voxelized is taken from there.
class GridCache {
  public:
    GridCache(const Device& device, AssetStore& meshes)
        : device_(device), meshes_(meshes), voxelizer_(device) {}

    /// The grid that shows `object`, of which `model` is the model, on a lattice. An exact solid is
    /// closed where the lattice ends, unless light goes through it: water that the world's sides
    /// cut goes on beyond them. Throws Error::input and Error::limit as voxelizing does, with
    /// messages that begin with the place in the scene.
    SharedGrid grid_of(const Object& object, const Model& model, const ObjectLattice& lattice,
                       bool transmits);

    /// The grid of a model in its own space, as instances use it; of exact models, too.
    SharedGrid own_grid_of(const Model& model, bool transmits);

    /// Forgets the grids that weren't asked for since the last call. Grids of models that are
    /// `retained` and of which none was asked for stay as they are in `scene`: the first made that
    /// take at most `room` bytes of the device. It keeps the first made because models that are
    /// shown in turns would otherwise push each other out.
    void forget_unused(const Scene& scene, const std::vector<bool>& retained, uint64_t room);

    /// The bytes on the device of the grids that the last call kept though nothing asked for them.
    uint64_t retained_bytes() const { return retained_bytes_; }

    uint64_t voxelized() const { return voxelized_; }      ///< grids made so far
    uint64_t from_cache() const { return from_cache_; }    ///< grids taken from the cache so far
    double keep_seconds() const { return keep_seconds_; }  ///< writing grids to the cache

  private:
    /// Everything that a grid depends on.
    struct Source {
        Model model;  ///< without the values that only its frame and messages depend on
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
    /// grid, of many times its mesh's bytes.
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
