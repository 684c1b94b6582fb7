// SPDX-License-Identifier: Apache-2.0
#include "runtime/analysis/object_boxes.hpp"

#include <glm/common.hpp>
#include <glm/vector_relational.hpp>

#include "runtime/analysis/object_lattice.hpp"
#include "runtime/geometry/solid/solid_bounds.hpp"
#include "runtime/grid/world_frame.hpp"
#include "runtime/scene/predicates.hpp"

namespace voxelume {
namespace {

/// The distance by which shown surfaces may lie off the model's own surface, in voxels of the model
/// or the world.
constexpr double kMargin = 1;

VoxelBox in_voxels(const glm::dvec3& min, const glm::dvec3& max, const GridFrame& world) {
    return {(min - world.origin) / world.voxel_edge - kMargin,
            (max - world.origin) / world.voxel_edge + kMargin};
}

/// The box around the image of a box under a map into the world.
VoxelBox mapped(const glm::dvec3& min, const glm::dvec3& max, const glm::dmat4& map,
                const GridFrame& world) {
    glm::dvec3 low(INFINITY), high(-INFINITY);
    for (int corner = 0; corner < 8; ++corner) {
        const glm::dvec3 p(map * glm::dvec4(corner & 1 ? max.x : min.x, corner & 2 ? max.y : min.y,
                                            corner & 4 ? max.z : min.z, 1));
        low = glm::min(low, p);
        high = glm::max(high, p);
    }
    return in_voxels(low, high, world);
}

VoxelBox box_of(const Scene& scene, const Object& object, AssetStore& meshes,
                ObjectLattices& lattices) {
    const Model& model = scene.models[size_t(object.model)];
    const GridFrame world = world_frame(scene.world);
    const bool in_world =
        lists_primitives(model.surface) ||
        (!is_instanced(scene, object) && lattices.lattice_of(object) == Lattice::world);
    const glm::dvec3 end = world.origin + world.voxel_edge * glm::dvec3(world.size);
    if (model.solid && in_world) {
        const SolidBounds box =
            bounds(*model.solid, object.world_from_object, SolidBounds{world.origin, end});
        return box.is_empty() ? VoxelBox{} : in_voxels(box.min, box.max, world);
    }
    const MeshSummary* mesh = meshes.summary_of(model);
    if (mesh && in_world)
        return mapped(mesh->surface.min, mesh->surface.max, object.world_from_object, world);
    const bool has_voxels = !model.voxels.empty();
    const GridFrame frame = has_voxels ? meshes.voxels(model).frame : model_frame(model, mesh);
    return mapped(frame.origin, frame.origin + frame.voxel_edge * glm::dvec3(frame.size),
                  object.world_from_object, world);
}

}  // namespace

std::vector<VoxelBox> object_boxes(const Scene& scene, AssetStore& meshes) {
    const GridFrame world = world_frame(scene.world);
    ObjectLattices lattices(scene, meshes);
    std::vector<VoxelBox> boxes(scene.objects.size());
    for (size_t i = 0; i < boxes.size(); ++i) {
        const Object& object = scene.objects[i];
        if (!is_potentially_visible(scene, object)) continue;
        const VoxelBox box = box_of(scene, object, meshes, lattices);
        boxes[i] = {glm::max(box.low, -kMargin),
                    glm::min(box.high, glm::dvec3(world.size) + kMargin)};
    }
    return boxes;
}

}  // namespace voxelume
