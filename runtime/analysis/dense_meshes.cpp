// SPDX-License-Identifier: Apache-2.0
#include "runtime/analysis/dense_meshes.hpp"

#include <algorithm>
#include <cmath>

#include "runtime/scene/parts/scene_affine.hpp"
#include "runtime/scene/predicates.hpp"

namespace voxelume {
namespace {

/// Triangles for a face of the voxels that dense meshes get.
constexpr double kSparseTriangles = 2;

/// The most of these along the mesh's longest side: triangles may differ in size.
constexpr double kMaxSparseVoxels = 1024;

double triangles_per_face(const MeshSummary& mesh, double edge) {
    return mesh.area.total > 0 ? double(mesh.triangles) * edge * edge / mesh.area.total : 0;
}

double largest_edge(const glm::dvec3& v) {
    return std::max({v.x, v.y, v.z});
}

}  // namespace

double triangles_per_voxel(const Scene& scene, const Object& object, AssetStore& meshes) {
    const Model& model = scene.models[size_t(object.model)];
    if (model.mesh.empty() || !lists_primitives(model.surface)) return 0;
    const double scale = stretch_of(glm::dmat3(object.world_from_object)).max;
    return triangles_per_face(*meshes.summary_of(model),
                              largest_edge(scene.world.voxel_size) / scale);
}

glm::dvec3 sparse_voxel_size(const Scene& scene, size_t number, AssetStore& meshes) {
    const Model& model = scene.models[number];
    const bool is_exact_instance =
        !model.mesh.empty() && lists_primitives(model.surface) &&
        std::ranges::any_of(scene.objects, [&](const Object& object) {
            return size_t(object.model) == number && is_instanced(scene, object);
        });
    if (!is_exact_instance) return model.voxel_size;
    const MeshSummary& mesh = *meshes.summary_of(model);
    if (triangles_per_face(mesh, largest_edge(model.voxel_size)) <= kDenseTriangles)
        return model.voxel_size;
    const double sparse = std::sqrt(kSparseTriangles * mesh.area.total / double(mesh.triangles));
    const double finest = largest_edge(mesh.surface.max - mesh.surface.min) / kMaxSparseVoxels;
    return glm::min(model.voxel_size, glm::dvec3(std::max(sparse, finest)));
}

}  // namespace voxelume
