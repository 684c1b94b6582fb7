// SPDX-License-Identifier: Apache-2.0
#include "runtime/memory/count/object_counts.hpp"

#include <algorithm>
#include <cmath>
#include <glm/matrix.hpp>

#include "runtime/analysis/object_boxes.hpp"
#include "runtime/geometry/solid/solid_parts.hpp"
#include "runtime/grid/world_frame.hpp"
#include "runtime/memory/count/cut_count.hpp"
#include "runtime/memory/count/plan_grid.hpp"
#include "runtime/memory/count/voxel_bricks.hpp"
#include "runtime/scene/predicates.hpp"

namespace voxelume {
namespace {

constexpr double kSurfaceBand = 2.8;  ///< voxels around a smooth surface that have distances
constexpr double kPlacedBand = 5;  ///< voxels around cubes: placing looks at whole leaves of them

/// The maximum ratio of a surface's bricks and voxels to the numbers that areas and distances give.
constexpr double kMargin = 1.12;
constexpr double kSolidMargin = 1.04;  ///< ratio for a solid's voxels, which are counted one by one

const glm::dmat4 kOwnSpace(1);

/// The width around a surface, in voxels, of the bricks that voxelizing stores.
double stored_band(const Model& model) {
    return stores_distances(model.surface) ? kSurfaceBand : 0;
}

bool is_solid_set(const Model& model) {
    return shows_voxels(model.surface) && model.set == VoxelSet::solid;
}

/// The number of a solid set's voxels apart from the surface: half of the voxels in its bricks, but
/// at most the number inside the object.
double filled_voxels(const SurfaceExtent& extent, double inside) {
    return std::min(inside, 0.5 * extent.bricks * double(kVoxelsPerBrick));
}

/// The smaller of two counts: areas give too much for small surfaces, and too little for others.
SurfaceExtent smaller(const SurfaceExtent& a, const SurfaceExtent& b) {
    return {std::min(a.voxels, b.voxels), std::min(a.bricks, b.bricks)};
}

SurfaceExtent with_margin(const SurfaceExtent& extent, double voxel_margin = kMargin) {
    return {voxel_margin * extent.voxels, kMargin * extent.bricks, voxel_margin * extent.listed};
}

VoxelBox whole_of(const GridFrame& frame) {
    return {glm::dvec3(0), glm::dvec3(frame.size)};
}

BrickCount count_model(const Model& model, const glm::dmat4& frame_from_model,
                       const GridFrame& frame, const VoxelBox& box, const BrickRule& rule,
                       TakenBricks& taken) {
    if (stores_distances(model.surface))
        return count_parts(*model.solid, frame_from_model, frame, box, rule, taken);
    return count_bricks(SolidField(*model.solid, frame_from_model), frame, box, rule, taken);
}

/// The number of primitives that an exact surface's voxels list: the solid, or each triangle that
/// meets a voxel.
double listed(const Model& model, const SurfaceExtent& extent) {
    return !lists_primitives(model.surface) ? 0 : model.solid ? extent.voxels : extent.listed;
}

/// The counts of a model's grid. `mesh` is null for a model without a mesh.
GridCounts counts_of(const Model& model, const MeshSummary* mesh, const GridFrame& frame,
                     const SurfaceExtent& extent) {
    GridCounts counts{.frame = frame, .surface = model.surface, .set = model.set};
    const glm::dvec3 table(frame.bricks());
    if (model.solid && stores_distances(model.surface))
        counts.parts = parts_of(*model.solid).size();
    const double all = table.x * table.y * table.z * double(counts.parts);
    counts.bricks = size_t(std::clamp(extent.bricks, 1.0, all));
    counts.voxels = size_t(std::max(extent.voxels, 1.0));
    counts.listed = size_t(listed(model, extent));
    counts.cube_normals = shows_voxels(model.surface) && model.normals == CubeNormals::surface;
    if (model.solid) counts.shapes = count_shapes(*model.solid);
    if (!mesh) return counts;
    if (const Solid cuts = cuts_of(model); !cuts.parts.empty()) {
        counts.parts = 1 + parts_of(cuts).size();
        counts.shapes = 1 + count_shapes(cuts);  // the whole frame comes first
    }
    counts.words = mesh->group_names.size() > 1;
    counts.paint = mesh->paint;
    counts.texture_key = reinterpret_cast<uintptr_t>(mesh);
    counts.normals = has_shading_normals(model.shading, mesh->has_normals);
    counts.vertices = mesh->corners;
    counts.triangles = mesh->triangles;
    return counts;
}

WorldCounts sum_of(const WorldExtent& extent, double primitives, const PartBricks& parts,
                   const GridFrame& frame) {
    const double table = brick_table(frame);
    WorldCounts counts;
    counts.bricks = size_t(std::clamp(extent.bricks, 1.0, table));
    counts.voxels = size_t(std::max(extent.voxels, 1.0));
    counts.primitives = size_t(primitives);
    counts.field_bricks = size_t(std::ceil(parts.of_fields));
    counts.other_bricks = size_t(std::ceil(std::min(parts.of_others, table)));
    return counts;
}

}  // namespace

GridCounts mesh_grid(const Model& model, const MeshSummary& mesh, const GridFrame& frame,
                     const SurfaceArea& area) {
    return counts_of(model, &mesh, frame,
                     surface_extent(area, kOwnSpace, frame, stored_band(model)));
}

/// The extent of a solid's surface in a lattice in the solid's own space.
SurfaceExtent ObjectCounts::solid_extent(const Model& model, const GridFrame& frame) {
    return of_solids_.of(model, frame.voxel_edge.x, [&] {
        TakenBricks taken(frame);
        return with_margin(count_model(model, kOwnSpace, frame, whole_of(frame),
                                       model_rule(model.surface, is_solid_set(model)), taken)
                               .extent);
    });
}

/// The extent of a solid in its part of the world's lattice, where it has a grid of its own.
SurfaceExtent ObjectCounts::object_extent(const Object& object, const GridFrame& frame) {
    const auto [entry, added] = of_objects_.try_emplace(&object);
    if (!added) return entry->second;
    const Model& model = scene_.models[size_t(object.model)];
    const VoxelBox box = in_part(box_of(object), world_frame(scene_.world), frame);
    TakenBricks taken(frame);
    return entry->second = with_margin(count_model(model, object.world_from_object, frame, box,
                                                   model_rule(model.surface, false), taken)
                                           .extent);
}

GridCounts ObjectCounts::model_grid(const Model& model, const GridFrame& frame, Estimate estimate) {
    const MeshSummary* mesh = meshes_.summary_of(model);
    const bool is_expected = estimate == Estimate::expected;
    if (model.solid) {
        const SurfaceExtent counted = solid_extent(model, frame);
        if (is_expected) return counts_of(model, mesh, frame, counted);
        const SurfaceArea area =
            min_solid_area(*model.solid, kOwnSpace, {model.extent.min, model.extent.max});
        const SurfaceExtent by_area = surface_extent(area, kOwnSpace, frame, stored_band(model));
        return counts_of(model, mesh, frame, smaller(counted, by_area));
    }
    if (is_expected) {
        GridCounts counts = mesh_grid(model, *mesh, frame, mesh->area);
        counts.cut_bricks = cut_bricks(model, kOwnSpace, frame);
        return counts;
    }
    return mesh_grid(model, *mesh, frame,
                     model.cuts.empty() ? min_area_of(model, meshes_) : SurfaceArea{});
}

GridCounts ObjectCounts::object_grid(const Object& object, const Model& model,
                                     const GridFrame& frame, Estimate estimate) {
    const bool is_expected = estimate == Estimate::expected;
    if (model.is_thin_part)
        return counts_of(model, meshes_.summary_of(model), frame,
                         is_expected ? extents_.thin_part(object, 0) : SurfaceExtent{});
    const double band = stored_band(model);
    SurfaceExtent extent =
        model.solid ? object_extent(object, frame) : extents_.planned(object, band);
    if (!is_expected) {
        const SurfaceExtent minimum = extents_.minimum(object, band);
        extent = model.solid ? smaller(extent, minimum) : minimum;
    }
    GridCounts counts = counts_of(model, meshes_.summary_of(model), frame, extent);
    if (is_expected) counts.cut_bricks = cut_bricks(model, object.world_from_object, frame);
    return counts;
}

BrickCount ObjectCounts::expected_in_world(const Object& object, TakenBricks& taken) {
    const Model& model = scene_.models[size_t(object.model)];
    if (!model.voxels.empty() && !lists_primitives(model.surface))
        return count_voxels(meshes_.voxels(model), object.world_from_object, spread_of(object),
                            world_frame(scene_.world), taken);
    const bool keeps_inside = shows_inside(scene_, object);
    if (model.solid) {
        const double spread =
            lattices_.lattice_of(object) == Lattice::world ? 1 : spread_of(object);
        const BrickRule rule = world_rule(model.surface, is_solid_set(model), keeps_inside, spread);
        return count_model(model, object.world_from_object, world_frame(scene_.world),
                           box_of(object), rule, taken);
    }
    SurfaceExtent extent =
        extents_.planned(object, stores_distances(model.surface) ? kSurfaceBand : kPlacedBand);
    const SurfaceExtent cut = cut_extent(model, object.world_from_object, world_frame(scene_.world),
                                         box_of(object), world_rule(model.surface, false, false));
    extent.voxels += cut.voxels;
    extent.bricks += cut.bricks;
    const double inside = keeps_inside || is_solid_set(model) ? extents_.inside_voxels(object) : 0;
    if (is_solid_set(model)) extent.voxels += filled_voxels(extent, inside);
    if (keeps_inside) {
        extent.voxels += inside;
        extent.bricks += inside / double(kVoxelsPerBrick);
    }
    return {extent, extent.bricks};
}

SurfaceExtent ObjectCounts::min_of_voxels(const Object& object, const VoxelModel& voxels) {
    const GridFrame& frame = voxels.frame;
    const glm::dvec3 end = frame.origin + frame.voxel_edge * glm::dvec3(frame.size);
    if (!extents_.lies_in_world(frame.origin, end, object.world_from_object)) return {};
    return min_count(voxels, object.world_from_object, world_frame(scene_.world));
}

WorldExtent ObjectCounts::min_in_world(size_t number) {
    const Object& object = scene_.objects[number];
    const Model& model = scene_.models[size_t(object.model)];
    const bool has_voxels = !model.voxels.empty() && !lists_primitives(model.surface);
    SurfaceExtent extent =
        has_voxels ? min_of_voxels(object, meshes_.voxels(model))
                   : extents_.minimum(object,
                                      stores_distances(model.surface) ? kSurfaceBand : kPlacedBand);
    // Areas give too much for small objects.
    constexpr double kAreaMargin = 1.2;
    const SurfaceExtent& counted = in_world_[number];
    extent = smaller(extent, {kAreaMargin * counted.voxels, kAreaMargin * counted.bricks});
    return {extent.voxels, extent.bricks, lists_primitives(model.surface) ? extent.voxels : 0};
}

PartBricks ObjectCounts::changed_bricks(const std::vector<bool>& objects) {
    world(Estimate::expected);
    PartBricks sum;
    for (size_t number = 0; number < objects.size(); ++number)
        if (objects[number])
            (is_smooth(number) ? sum.of_fields : sum.of_others) += in_world_[number].bricks;
    return sum;
}

std::vector<size_t> ObjectCounts::placed_numbers() {
    std::vector<size_t> numbers;
    for (size_t number = 0; number < scene_.objects.size(); ++number) {
        const Object& object = scene_.objects[number];
        if (!is_instanced(scene_, object) && is_potentially_visible(scene_, object) &&
            !is_empty(boxes()[number]))
            numbers.push_back(number);
    }
    std::stable_partition(numbers.begin(), numbers.end(),
                          [this](size_t number) { return !is_smooth(number); });
    return numbers;
}

bool ObjectCounts::is_smooth(size_t number) const {
    return stores_distances(scene_.models[size_t(scene_.objects[number].model)].surface);
}

WorldCounts ObjectCounts::expected_world() {
    const GridFrame frame = world_frame(scene_.world);
    TakenBricks taken(frame);
    WorldExtent sum;
    double primitives = 0, of_fields = 0, of_others = 0;
    for (const size_t number : placed_numbers()) {
        const Object& object = scene_.objects[number];
        const Model& model = scene_.models[size_t(object.model)];
        const auto [counted, new_bricks] = expected_in_world(object, taken);
        in_world_[number] = counted;
        const SurfaceExtent extent = with_margin(counted, model.solid ? kSolidMargin : kMargin);
        sum.voxels += extent.voxels;
        sum.bricks += kMargin * new_bricks;
        if (is_smooth(number))
            of_fields += extent.bricks;
        else
            of_others += kMargin * new_bricks;
        primitives += listed(model, extent);
        const SurfaceExtent thin = with_margin(extents_.thin_part(object, kPlacedBand));
        sum.voxels += thin.voxels;  // voxels that are smooth as well list two records
        of_others += thin.bricks;
        primitives += thin.listed;
    }
    return sum_of(sum, primitives, {of_fields, of_others}, frame);
}

WorldCounts ObjectCounts::min_world() {
    std::vector<ObjectExtent> others, all;
    double of_fields = 0;
    for (const size_t number : placed_numbers()) {
        all.push_back({boxes()[number], min_in_world(number)});
        if (is_smooth(number))
            of_fields += all.back().extent.bricks;
        else
            others.push_back(all.back());
    }
    const WorldExtent sum = min_extent(std::move(all));
    const double of_others = min_extent(std::move(others)).bricks;
    return sum_of(sum, sum.exact_voxels, {of_fields, of_others}, world_frame(scene_.world));
}

WorldCounts ObjectCounts::world(Estimate estimate) {
    in_world_.resize(scene_.objects.size());
    if (!expected_) expected_ = expected_world();
    return estimate == Estimate::expected ? *expected_ : min_world();
}

}  // namespace voxelume
