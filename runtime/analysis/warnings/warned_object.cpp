// SPDX-License-Identifier: Apache-2.0
#include "runtime/analysis/warnings/warned_object.hpp"

#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/mat4x4.hpp>
#include <optional>

#include "runtime/base/text.hpp"
#include "runtime/geometry/solid/solid_bounds.hpp"
#include "runtime/scene/predicates.hpp"

namespace voxelume {
namespace {

glm::dvec3 scale_of(const glm::dmat4& map) {
    return {glm::length(glm::dvec3(map[0])), glm::length(glm::dvec3(map[1])),
            glm::length(glm::dvec3(map[2]))};
}

Bounds mapped(const Bounds& box, const glm::dmat4& map) {
    Bounds image{glm::dvec3(INFINITY), glm::dvec3(-INFINITY)};
    for (int i = 0; i < 8; ++i) {
        const glm::dvec3 p(map * glm::dvec4(corner(box, i), 1));
        image.min = glm::min(image.min, p);
        image.max = glm::max(image.max, p);
    }
    return image;
}

/// Edges of a model's voxels in object space.
glm::dvec3 own_voxel(const Model& model, const Bounds& own, AssetStore& meshes) {
    if (!model.voxels.empty()) return meshes.voxels(model).frame.voxel_edge;
    if (model.resolution == 0) return model.voxel_size;
    return glm::dvec3(largest(own.max - own.min) / model.resolution);
}

}  // namespace

PlacedModel placed(const Scene& scene, const Object& object, AssetStore& meshes) {
    PlacedModel result{scene.models[size_t(object.model)]};
    const Model& model = result.model;
    result.is_instance = is_instanced(scene, object);
    result.scale = scale_of(object.world_from_object);
    if (model.solid) {
        const Bounds lattice = lattice_bounds(scene.world);
        const bool is_endless = is_infinite(*model.solid);
        const SolidBounds clip{lattice.min, lattice.max};
        const SolidBounds box = bounds(*model.solid, object.world_from_object,
                                       is_endless ? std::optional(clip) : std::nullopt);
        result.is_empty = box.is_empty();
        result.world = {box.min, box.max};
        if (!is_endless) {
            const SolidBounds own = bounds(*model.solid, glm::dmat4(1));
            result.own = {own.min, own.max};
            result.is_void = own.is_empty();
        }
    } else if (const MeshSummary* mesh = meshes.summary_of(model)) {
        result.own = mesh->surface;
        result.world = mapped(result.own, object.world_from_object);
    } else {
        const GridFrame& frame = meshes.voxels(model).frame;
        result.own = {frame.origin, frame.origin + frame.voxel_edge * glm::dvec3(frame.size)};
        result.world = mapped(result.own, object.world_from_object);
    }
    result.voxel = own_voxel(model, result.own, meshes) * result.scale;
    return result;
}

std::string title_of(const Object& object) {
    return object.name.empty() || object.name.starts_with("objects[") ? "the object"
                                                                      : quote(object.name);
}

}  // namespace voxelume
