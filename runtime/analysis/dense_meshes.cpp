// SPDX-License-Identifier: Apache-2.0
#include "runtime/analysis/dense_meshes.hpp"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/vector_relational.hpp>

#include "runtime/geometry/solid/solid_bounds.hpp"
#include "runtime/scene/parts/scene_affine.hpp"
#include "runtime/scene/predicates.hpp"
#include "runtime/scene/scene_motion.hpp"

namespace voxelume {
namespace {

/// A mesh with more triangles than this per face of its voxels gets finer voxels. With fewer,
/// pictures of the undivided mesh take about as long.
constexpr double kDenseTriangles = 16;

/// The number of triangles per voxel face for which the voxels of dense meshes are sized.
constexpr double kSparseTriangles = 2;

/// The maximum number of such voxels along the mesh's longest side: triangles may differ in size.
constexpr double kMaxSparseVoxels = 1024;

/// The maximum distance, in voxels of the world, between sides of boxes that count as flush.
constexpr double kFlush = 0.01;

double triangles_per_face(const MeshSummary& mesh, double edge) {
    return mesh.area.total > 0 ? double(mesh.triangles) * edge * edge / mesh.area.total : 0;
}

double largest_edge(const glm::dvec3& v) {
    return std::max({v.x, v.y, v.z});
}

/// True if a model's shape may change from frame to frame.
bool changes(const Scene& scene, size_t number) {
    return scene.models[number].morph || any_part_changes(scene, [&](const MovingPart& part) {
               return part.part == ScenePart::model && part.index == number;
           });
}

/// The box around an object's surface in the world.
Bounds box_in_world(const Scene& scene, const Object& object, AssetStore& meshes) {
    const Model& model = scene.models[size_t(object.model)];
    const glm::dmat4& map = object.world_from_object;
    if (model.solid) {
        const Bounds world = lattice_bounds(scene.world);
        const SolidBounds box = bounds(*model.solid, map, SolidBounds{world.min, world.max});
        return {box.min, box.max};
    }
    Bounds box = kEmptyBounds;
    const Bounds& own = meshes.summary_of(model)->surface;
    for (int i = 0; i < 8; ++i) {
        const glm::dvec3 p(map * glm::dvec4(corner(own, i), 1));
        box = {glm::min(box.min, p), glm::max(box.max, p)};
    }
    return box;
}

bool are_flush(const Bounds& a, const Bounds& b, double slack) {
    if (glm::any(glm::lessThanEqual(glm::min(a.max, b.max), glm::max(a.min, b.min)))) return false;
    const auto near = [&](const glm::dvec3& p, const glm::dvec3& q) {
        return glm::any(glm::lessThan(glm::abs(p - q), glm::dvec3(slack)));
    };
    return near(a.min, b.min) || near(a.max, b.max);
}

bool is_flush_with_another(const Scene& scene, const Object& object, AssetStore& meshes) {
    const Bounds own = box_in_world(scene, object, meshes);
    const double slack = kFlush * largest_edge(scene.world.voxel_size);
    return std::ranges::any_of(scene.objects, [&](const Object& other) {
        return &other != &object && other.visible &&
               lists_primitives(scene.models[size_t(other.model)].surface) &&
               are_flush(own, box_in_world(scene, other, meshes), slack);
    });
}

}  // namespace

double triangles_per_voxel(const Scene& scene, const Object& object, AssetStore& meshes) {
    const Model& model = scene.models[size_t(object.model)];
    if (model.mesh.empty() || !lists_primitives(model.surface)) return 0;
    const double scale = stretch_of(glm::dmat3(object.world_from_object)).max;
    return triangles_per_face(*meshes.summary_of(model),
                              largest_edge(scene.world.voxel_size) / scale);
}

bool is_better_divided(const Scene& scene, const Object& object, AssetStore& meshes) {
    const auto number = size_t(object.model);
    const Model& model = scene.models[number];
    return triangles_per_voxel(scene, object, meshes) > kDenseTriangles && !model.is_sized &&
           !changes(scene, number) && !is_flush_with_another(scene, object, meshes);
}

glm::dvec3 sparse_voxel_size(const Scene& scene, size_t number, AssetStore& meshes) {
    const Model& model = scene.models[number];
    const bool is_exact_instance =
        !model.mesh.empty() && lists_primitives(model.surface) &&
        std::ranges::any_of(scene.objects, [&](const Object& object) {
            return size_t(object.model) == number && is_instanced(scene, object);
        });
    if (!is_exact_instance || changes(scene, number)) return model.voxel_size;
    const MeshSummary& mesh = *meshes.summary_of(model);
    if (triangles_per_face(mesh, largest_edge(model.voxel_size)) <= kDenseTriangles)
        return model.voxel_size;
    const double sparse = std::sqrt(kSparseTriangles * mesh.area.total / double(mesh.triangles));
    const double finest = longest_side(mesh.surface) / kMaxSparseVoxels;
    return glm::min(model.voxel_size, glm::dvec3(std::max(sparse, finest)));
}

}  // namespace voxelume
