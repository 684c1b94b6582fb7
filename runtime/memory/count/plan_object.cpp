// SPDX-License-Identifier: Apache-2.0
#include "runtime/memory/count/plan_object.hpp"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <glm/vector_relational.hpp>

#include "runtime/assets/model_frame.hpp"
#include "runtime/grid/world_frame.hpp"
#include "runtime/memory/count/plan_grid.hpp"

namespace voxelume {

ObjectExtents::ObjectExtents(const Scene& scene, AssetStore& meshes)
    : scene_(scene), meshes_(meshes), frame_(world_frame(scene.world)) {
    box_ = {frame_.origin, frame_.origin + glm::dvec3(frame_.size) * frame_.voxel_edge};
}

const SurfaceArea& ObjectExtents::area_of(int model_number) {
    const auto [entry, added] = areas_.try_emplace(model_number);
    const Model& model = scene_.models[size_t(model_number)];
    if (added) {
        const MeshSummary* mesh = meshes_.summary_of(model);
        entry->second =
            mesh ? mesh->area
                 : solid_area(*model.solid, glm::dmat4(1), {model.extent.min, model.extent.max});
    }
    return entry->second;
}

SurfaceArea min_area_of(const Model& model, AssetStore& meshes) {
    const SurfaceArea& area = meshes.summary_of(model)->min_area;
    const std::optional<Model> part = thin_part_of(model);
    return part ? without(area, meshes.summary_of(*part)->area) : area;
}

SurfaceExtent ObjectExtents::extent(const Object& object, double band, bool is_minimum) {
    const Model& model = scene_.models[size_t(object.model)];
    const glm::dmat4& map = object.world_from_object;
    if (model.solid) {
        const SurfaceArea area = is_minimum ? min_solid_area(*model.solid, map, box_)
                                            : solid_area(*model.solid, map, box_);
        return surface_extent(area, glm::dmat4(1), frame_, band);
    }
    const SurfaceArea area = is_minimum ? min_area_of(model, meshes_) : area_of(object.model);
    const SurfaceExtent extent = surface_extent(area, map, frame_, band);
    const double inside = part_in_world(object);
    return {extent.voxels * inside, extent.bricks * inside, extent.listed * inside};
}

SurfaceExtent ObjectExtents::minimum(const Object& object, double band) {
    if (!scene_.models[size_t(object.model)].cuts.empty()) return {};
    return extent(object, band, true);
}

SurfaceExtent ObjectExtents::thin_part(const Object& object, double band) {
    const std::optional<Model> part = thin_part_of(scene_.models[size_t(object.model)]);
    if (!part) return {};
    const SurfaceArea& area = meshes_.summary_of(*part)->area;
    return surface_extent(area, object.world_from_object, frame_, band);
}

double ObjectExtents::inside_voxels(const Object& object) {
    const Model& model = scene_.models[size_t(object.model)];
    const glm::dmat4& map = object.world_from_object;
    const glm::dvec3& edge = frame_.voxel_edge;
    const double voxel = edge.x * edge.y * edge.z;
    if (!model.solid) {
        const Bounds& box = meshes_.summary_of(model)->surface;
        const glm::dvec3 size = box.max - box.min, world = box_.max - box_.min;
        const double volume = size.x * size.y * size.z * std::abs(glm::determinant(map));
        return std::min(volume, world.x * world.y * world.z) / voxel;
    }
    const SolidBounds box = bounds(*model.solid, map, box_);
    const glm::dvec3 size = glm::max(box.max - box.min, 0.0);
    return size.x * size.y * size.z / voxel;
}

bool ObjectExtents::lies_in_world(const glm::dvec3& low, const glm::dvec3& high,
                                  const glm::dmat4& map) const {
    for (int corner = 0; corner < 8; ++corner) {
        const glm::dvec3 p(map * glm::dvec4(corner & 1 ? high.x : low.x,
                                            corner & 2 ? high.y : low.y,
                                            corner & 4 ? high.z : low.z, 1.0));
        if (glm::any(glm::lessThan(p, box_.min)) || glm::any(glm::greaterThan(p, box_.max)))
            return false;
    }
    return true;
}

double ObjectExtents::part_in_world(const Object& object) {
    const Model& model = scene_.models[size_t(object.model)];
    const glm::dmat4& map = object.world_from_object;
    const Bounds& box = meshes_.summary_of(model)->surface;
    if (lies_in_world(box.min, box.max, map)) return 1;
    const auto [part, added] = parts_.try_emplace(&object);
    if (added) part->second = part_inside(*meshes_.mesh_of(model), map, box_);
    return part->second;
}

const std::vector<VoxelBox>& ObjectExtents::boxes() {
    if (boxes_.empty()) boxes_ = object_boxes(scene_, meshes_);
    return boxes_;
}

double spread_of(const Object& object) {
    const glm::dmat3 turn(object.world_from_object);
    double sum = 0;
    for (int axis = 0; axis < 3; ++axis) {
        const glm::dvec3 direction = glm::normalize(turn[axis]);
        sum += std::abs(direction.x) + std::abs(direction.y) + std::abs(direction.z);
    }
    return sum / 3;
}

}  // namespace voxelume
