// model -> grid: its voxels in a frame, from its mesh, its solid or a file of voxels.
#pragma once

#include "runtime/grid.hpp"
#include "runtime/model_frame.hpp"
#include "runtime/stages/voxelize.hpp"

namespace voxelume {

/// Whether a model's voxels are taken from a file as they are.
inline bool is_voxels(const Model& model) {
    return !model.voxels.empty() && model.surface != Surface::exact;
}

/// Makes grids of models, and keeps the compiled kernels between calls.
class ModelVoxelizer {
  public:
    ModelVoxelizer(const Device& device, MeshStore& meshes)
        : device_(device), meshes_(meshes), voxelizer_(device) {}

    /// The model in its own frame.
    BrickGrid in_own_frame(const Model& model);

    /// A model that isn't of voxels, in a frame; `where` in the scene opens the message if the user
    /// has to change something.
    BrickGrid in_frame(const Model& model, const glm::dmat4& frame_from_model,
                       const GridFrame& frame, const std::string& where);

  private:
    const Device& device_;
    MeshStore& meshes_;
    Voxelizer voxelizer_;
};

}  // namespace voxelume
