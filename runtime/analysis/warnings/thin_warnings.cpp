// SPDX-License-Identifier: Apache-2.0
#include "runtime/analysis/warnings/thin_warnings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/mat3x3.hpp>

#include "runtime/base/text.hpp"
#include "runtime/geometry/shape/mesh_shape.hpp"
#include "runtime/geometry/solid/solid_inside.hpp"
#include "runtime/geometry/solid/solid_parts.hpp"
#include "runtime/scene/predicates.hpp"

namespace voxelume {
namespace {

/// The thinnest width of an object over the edge of the voxels that show it.
struct Thinness {
    double width = INFINITY, voxel = 1;
    void consider(double other_width, double other_voxel) {
        if (other_width / other_voxel < width / voxel) width = other_width, voxel = other_voxel;
    }
};

/// The edge of the voxels that hold an object's distances.
double field_voxel(const Scene& scene, const PlacedModel& placed) {
    const double own = smallest(placed.voxel), world = smallest(scene.world.voxel_size);
    if (placed.is_instance) return own;
    return placed.model.is_sized ? std::max(own, world) : world;
}

Thinness thinness_of(const Scene& scene, const Object& object, const PlacedModel& placed) {
    const Model& model = placed.model;
    const double world_edge = smallest(scene.world.voxel_size);
    const glm::dvec3 sides = (placed.own.max - placed.own.min) * placed.scale;
    Thinness thin;
    if (shows_voxels(model.surface) && model.set != VoxelSet::solid) {
        // A layer of voxels shows a sheet as it should; only what is small all around grows.
        thin.consider(largest(sides), placed.is_instance ? smallest(placed.voxel) : world_edge);
        return thin;
    }
    // In the world, voxels of a size that the scene doesn't say are the world's.
    const bool has_own = placed.is_instance || model.is_sized;
    for (int axis = 0; axis < 3 && !model.solid; ++axis) {
        if (has_own) thin.consider(sides[axis], placed.voxel[axis]);
        if (!placed.is_instance) thin.consider(sides[axis], world_edge);
    }
    if (model.solid) {
        const double width = thickness(*model.solid, glm::dmat3(object.world_from_object));
        if (has_own) thin.consider(width, smallest(placed.voxel));
        if (!placed.is_instance) thin.consider(width, world_edge);
    }
    return thin;
}

}  // namespace

void add_thin_warning(const Scene& scene, const Object& object, const PlacedModel& placed,
                      AssetStore& meshes, std::vector<Warning>& warnings) {
    const Model& model = placed.model;
    if (lists_primitives(model.surface) || !model.voxels.empty()) return;
    if (!model.mesh.empty() && !has_area(*meshes.summary_of(model))) return;  // a point is a voxel
    if (model.solid && is_infinite(*model.solid) && shows_voxels(model.surface) &&
        model.set != VoxelSet::solid)
        return;
    const Thinness thin = thinness_of(scene, object, placed);
    if (thin.width >= thin.voxel * (1 - kSizeRounding)) return;
    const std::string size =
        thin.width > 0 ? fmt::format("{:.3g} m thin where it is thinnest", thin.width) : "flat";
    const std::string voxels =
        thin.width > 0 ? fmt::format(", or use voxels below {:.2g} m", thin.width / 2) : "";
    add_once({WarningKind::thinner_than_voxel, object.where,
              fmt::format("{} is {}, and its voxels are {:.3g} m, so parts of it get lost or too "
                          "thick: give its model \"surface\": \"exact\"{}",
                          title_of(object), size, thin.voxel, voxels)},
             warnings);
}

void add_thin_part_warning(const Scene& scene, const PlacedModel& placed, AssetStore& meshes,
                           std::vector<Warning>& warnings) {
    const Model& model = placed.model;
    if (model.mesh.empty() || !stores_distances(model.surface) || model.thin_edge > 0) return;
    const auto is_known = [&](const Warning& w) {
        return w.kind == WarningKind::thinner_than_voxel && w.where == model.where;
    };
    const MeshSummary& mesh = *meshes.summary_of(model);
    if (is_open(mesh) || std::ranges::any_of(warnings, is_known)) return;
    const double scale = smallest(placed.scale), voxel = field_voxel(scene, placed);
    const MeshThickness thickness = meshes.thickness_of(model);
    if (thickness.part * scale >= kThinPartVoxels * voxel) return;
    // Next to sharp edges, little lies behind the area, however thick the body is: sheets alone
    // count.
    const bool is_sharp = has_sharp_edges(mesh, meshes.shape_of(model), voxel / scale);
    const double part = (is_sharp ? thickness.sheet : thickness.part) * scale;
    const bool has_inside = part > 0;
    if (!has_inside || part >= kThinPartVoxels * voxel) return;
    add_once({WarningKind::thinner_than_voxel, model.where,
              fmt::format("parts of {} are less than {:.2g} voxels thick and get lost on "
                          "\"smooth\": leave \"surface\" out or give \"exact\", or use voxels "
                          "below {:.2g} m",
                          quote(model.mesh.filename().string()), part / voxel, part)},
             warnings);
}

}  // namespace voxelume
