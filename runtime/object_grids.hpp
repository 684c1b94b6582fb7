// models and exact objects -> brick grids: voxelized once, and kept while frames show them.
#pragma once

#include <memory>
#include <vector>

#include "runtime/model_frame.hpp"
#include "runtime/stages/voxelize.hpp"

namespace voxelume {

using SharedGrid = std::shared_ptr<const BrickGrid>;

/// The grids of a scene's objects. A model is voxelized in its own space for all its objects, an
/// exact one in the world's frame for each object.
class ObjectGrids {
  public:
    ObjectGrids(const Device& device, MeshStore& meshes)
        : device_(device), meshes_(meshes), voxelizer_(device) {}

    /// The grid that shows `object`, of `scene`. Throws Error::input and Error::limit as voxelizing
    /// does, opened by the place in the scene.
    SharedGrid grid_of(const Scene& scene, const Object& object);

    /// The grid of a model in its own space, of exact ones, too: an instance's.
    SharedGrid own_grid_of(const Model& model);

    /// Forgets the grids that weren't asked for since the last call.
    void forget_unused();

    uint64_t voxelized() const { return voxelized_; }  ///< grids made so far

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

    SharedGrid find_or_make(const Model& model, const Source& source, const std::string& where);
    BrickGrid make(const Model& model, const Source& source);

    Device device_;
    MeshStore& meshes_;
    Voxelizer voxelizer_;
    std::vector<Kept> kept_;
    uint64_t voxelized_ = 0;
};

}  // namespace voxelume
