#include "runtime/model_grid.hpp"

#include "runtime/error.hpp"
#include "runtime/stages/voxelize_solid.hpp"

namespace voxelume {

BrickGrid ModelVoxelizer::in_own_frame(const Model& model) {
    if (is_voxels(model)) return meshes_.voxels(model).upload(device_);
    return in_frame(model, glm::dmat4(1), model_frame(model, meshes_.mesh_of(model)), model.where);
}

BrickGrid ModelVoxelizer::in_frame(const Model& model, const glm::dmat4& frame_from_model,
                                   const GridFrame& frame, const std::string& where) {
    const VoxelizeOptions options = {model.surface, model.set};
    try {
        BrickGrid grid =
            model.solid
                ? voxelize_solid(device_, *model.solid, frame_from_model, frame, options)
                : voxelizer_.voxelize(*meshes_.mesh_of(model), frame_from_model, frame, options);
        device_.finish();
        return grid;
    } catch (const Error& error) {
        const bool is_users = error.kind() == ErrorKind::input || error.kind() == ErrorKind::limit;
        if (!is_users) throw;
        throw Error(error.kind(), "{}: {}", where, error.what());
    }
}

}  // namespace voxelume
