// SPDX-License-Identifier: Apache-2.0
#include "runtime/analysis/cube_steps.hpp"

#include "runtime/analysis/object_lattice.hpp"
#include "runtime/assets/model_frame.hpp"
#include "runtime/assets/voxel_model_file.hpp"
#include "runtime/grid/world_frame.hpp"
#include "runtime/scene/predicates.hpp"
#include "runtime/stages/place/placement_map.hpp"

namespace voxelume {
namespace {

/// 0 for an object whose cubes aren't resampled or have no normals.
glm::dmat3 steps_of_object(const Scene& scene, const Object& object, ObjectLattices& lattices,
                           AssetStore& meshes) {
    if (is_instanced(scene, object) || !object.visible) return glm::dmat3(0);
    if (!gives_cubes_normals(scene.models[size_t(object.model)], meshes)) return glm::dmat3(0);
    return gradients_in_object(lattices.own_frame(object), world_frame(scene.world),
                               object.world_from_object);
}

}  // namespace

bool gives_cubes_normals(const Model& model, AssetStore& meshes, bool reads) {
    if (!shows_voxels(model.surface)) return false;
    if (model.voxels.empty()) return model.normals == CubeNormals::surface;
    if (model.given || !surface_of_voxel_model(model.voxels)) return false;
    return !reads || !meshes.voxels(model).normals.empty();
}

std::optional<GridFrame> frame_of_resampled_cubes(const Scene& scene, const Object& object,
                                                  AssetStore& meshes) {
    ObjectLattices lattices(scene, meshes);
    if (steps_of_object(scene, object, lattices, meshes) == glm::dmat3(0)) return {};
    return lattices.own_frame(object);
}

std::vector<float> cube_steps(const Scene& scene, AssetStore& meshes,
                              std::span<const VoxelBox> boxes) {
    constexpr size_t kNumbers = 9;
    std::vector<float> all(kNumbers * scene.objects.size());
    ObjectLattices lattices(scene, meshes);
    bool is_resampled = false;
    for (size_t i = 0; i < scene.objects.size(); ++i) {
        const Object& object = scene.objects[i];
        if (is_empty(boxes[i]) || !is_potentially_visible(scene, object)) continue;
        const glm::dmat3 steps = steps_of_object(scene, object, lattices, meshes);
        is_resampled |= steps != glm::dmat3(0);
        for (int row = 0; row < 3; ++row)
            for (int column = 0; column < 3; ++column)
                all[kNumbers * i + size_t(3 * row + column)] = float(steps[column][row]);
    }
    return is_resampled ? all : std::vector<float>();
}

}  // namespace voxelume
