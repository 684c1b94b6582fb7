// SPDX-License-Identifier: Apache-2.0
#include "runtime/assets/model_frame.hpp"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>

#include "runtime/base/error.hpp"
#include "runtime/geometry/solid/solid_bounds.hpp"
#include "runtime/stages/voxelize/voxelize.hpp"

namespace voxelume {
namespace {

/// The voxel edges of a model whose bounds are `extent`, metres.
glm::dvec3 voxel_edge(const Model& model, const glm::dvec3& extent) {
    if (model.resolution == 0) return model.voxel_size;
    const double longest = std::max({extent.x, extent.y, extent.z});
    if (!(longest > 0))
        throw Error(ErrorKind::input,
                    "the model is a single point, so no resolution gives it a "
                    "voxel size: give the voxel size instead");
    return glm::dvec3(longest / model.resolution);
}

GridFrame solid_frame(const Model& model) {
    const SolidBounds extent = {model.extent.min, model.extent.max};
    const glm::dmat4 identity(1);
    const SolidBounds box = bounds(*model.solid, identity, extent);
    const glm::dvec3 edge = voxel_edge(model, box.max - box.min);
    return frame_around(*model.solid, identity, edge, kModelMargin, extent);
}

/// The lattice of a mesh. Voxels of a given size lie as in a world whose bounds are multiples of
/// that size, so they are the same wherever an object moves by whole voxels. A resolution counts
/// from the mesh's side.
GridFrame mesh_frame(const Model& model, const MeshSummary& mesh) {
    const glm::dvec3 edge = voxel_edge(model, mesh.surface.max - mesh.surface.min);
    const glm::dvec3 low = mesh.vertices.min, high = mesh.vertices.max;
    if (model.resolution > 0) return frame_around(low, high, edge, kModelMargin);
    const glm::dvec3 first = glm::floor(low / edge);
    GridFrame frame = frame_around(first * edge, high, edge, kModelMargin);
    frame.origin = (first - double(kModelMargin)) * edge;
    return frame;
}

}  // namespace

GridFrame model_frame(const Model& model, const MeshSummary* mesh) {
    try {
        return mesh ? mesh_frame(model, *mesh) : solid_frame(model);
    } catch (const Error& error) {
        throw Error(error.kind(), "{}: {}", model.where, error.what());
    }
}

bool may_be_shown(const Scene& scene, const Object& object) {
    const Model& model = scene.models[size_t(object.model)];
    const SolidBounds extent = {model.extent.min, model.extent.max};
    if (!object.visible || extent.is_empty()) return false;
    return !model.solid || !bounds(*model.solid, glm::dmat4(1), extent).is_empty();
}

bool is_potentially_visible(const Scene& scene, const Object& object) {
    return object.potentially_visible && may_be_shown(scene, object);
}

}  // namespace voxelume
