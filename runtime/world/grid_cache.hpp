// models and exact objects -> brick grids: voxelized once, and kept while frames show them.
#pragma once

#include <memory>
#include <vector>

#include "runtime/analysis/placed_objects.hpp"
#include "runtime/assets/asset_store.hpp"
#include "runtime/assets/model_frame.hpp"
#include "runtime/stages/voxelize/voxelize.hpp"

namespace voxelume {

/// The grids of a scene's objects. A model is voxelized in its own space for all its objects, an
/// exact one in the world's frame for each object. What the store's cache has of a mesh that an
/// earlier run voxelized is taken from there.
class GridCache {
  public:
    GridCache(const Device& device, AssetStore& meshes)
        : device_(device), meshes_(meshes), voxelizer_(device) {}

    /// The grid that shows `object`, of `scene`. Throws Error::input and Error::limit as voxelizing
    /// does, opened by the place in the scene.
    SharedGrid grid_of(const Scene& scene, const Object& object);

    /// The grid of a model in its own space, of exact ones, too: an instance's.
    SharedGrid own_grid_of(const Model& model);

    /// Forgets the grids that weren't asked for since the last call, but those of models that are
    /// `retained` as they are in `scene` and had none of them asked for. Of these it keeps the
    /// first made that take no more than `room` bytes of the device: what comes back in turns, the
    /// last made would drive each other out.
    void forget_unused(const Scene& scene, const std::vector<bool>& retained, uint64_t room);

    /// What the last call kept though nothing asked for it, in bytes of the device.
    uint64_t retained_bytes() const { return retained_bytes_; }

    uint64_t voxelized() const { return voxelized_; }      ///< grids made so far
    uint64_t from_cache() const { return from_cache_; }    ///< grids taken from the cache so far
    double keep_seconds() const { return keep_seconds_; }  ///< of writing grids to the cache so far

  private:
    /// All that a grid depends on.
    struct Source {
        Model model;  ///< without what only its frame and messages depend on
        glm::dmat4 frame_from_model{1};
        GridFrame frame;
        friend bool operator==(const Source&, const Source&) = default;
    };
    struct Kept {
        Source source;
        SharedGrid grid;
        bool is_used = true;
    };

    /// `where` opens messages; empty, where a caller does. `keeps` lets the cache have it: an exact
    /// object that moves is another one in every frame, and takes many times its mesh's bytes.
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
