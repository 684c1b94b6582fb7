// SPDX-License-Identifier: Apache-2.0
#include "runtime/analysis/object_lattice.hpp"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/matrix.hpp>

#include "runtime/assets/model_frame.hpp"
#include "runtime/base/error.hpp"
#include "runtime/grid/world_frame.hpp"
#include "runtime/scene/parts/scene_affine.hpp"
#include "runtime/scene/predicates.hpp"
#include "runtime/stages/place/place.hpp"
#include "runtime/stages/place/placement_map.hpp"

namespace voxelume {
namespace {

/// The number of copies of a model from which the copies share a grid: grids of their own would all
/// be kept while the copies are placed.
constexpr uint32_t kManyCopies = 8;

/// The number of sizes of shared voxels per octave. Few sizes let objects of all scales share few
/// grids.
constexpr double kStepsPerOctave = 4;

/// The relative difference up to which sizes count as equal: decimal numbers in scenes and maps are
/// rounded.
constexpr double kSameSize = 1e-9;

bool has_own_voxels(const Model& model) {
    return !model.voxels.empty() && !lists_primitives(model.surface);
}

bool is_cube(const glm::dvec3& edges) {
    const double min = std::min({edges.x, edges.y, edges.z});
    return std::max({edges.x, edges.y, edges.z}) <= min * (1 + kSameSize);
}

bool is_similarity(const Stretch& stretch) {
    return stretch.max <= stretch.min * (1 + kSameSize);
}

/// The part of the world's lattice around a box, in whole bricks. It has all distances of the
/// surface in the box, also next to the world's end.
GridFrame part_around(const VoxelBox& box, const GridFrame& world) {
    const glm::dvec3 edge(kBrickSize);
    const glm::dvec3 low = glm::floor((box.low - double(kModelMargin)) / edge) * edge;
    const glm::dvec3 high = glm::ceil((box.high + double(kModelMargin)) / edge) * edge;
    return {world.origin + low * world.voxel_edge, world.voxel_edge, glm::ivec3(high - low)};
}

}  // namespace

bool is_finer_field(const Scene& scene, const Object& object, AssetStore& meshes) {
    const Model& model = scene.models[size_t(object.model)];
    return has_own_voxels(model) && stores_distances(model.surface) &&
           voxels_per_world_voxel(meshes.voxels(model).frame, world_frame(scene.world),
                                  object.world_from_object) > kFinestField;
}

ObjectLattices::ObjectLattices(const Scene& scene, AssetStore& meshes)
    : scene_(scene), meshes_(meshes), copies_(scene.models.size()) {
    for (const Object& object : scene.objects)
        copies_[size_t(object.model)] += !is_instanced(scene, object);
}

Lattice ObjectLattices::lattice_of(const Object& object) {
    const Model& model = scene_.models[size_t(object.model)];
    if (lists_primitives(model.surface)) return Lattice::world;
    if (has_own_voxels(model) || shows_voxels(model.surface)) return Lattice::model;
    const GridFrame world = world_frame(scene_.world);
    const GridFrame own = model_frame(model, meshes_.summary_of(model));
    const glm::dmat4& map = object.world_from_object;
    const bool is_coarser =
        model.is_sized && voxels_per_world_voxel(own, world, map) < 1 - kSameSize;
    if (is_coarser || maps_nodes_to_nodes(own, world, map)) return Lattice::model;
    const bool is_copied = copies_[size_t(object.model)] >= kManyCopies || object.moves;
    return is_copied && is_cube(world.voxel_edge) && is_similarity(stretch_of(glm::dmat3(map)))
               ? Lattice::shared
               : Lattice::world;
}

/// The model with voxels in object space that are no smaller than the world's voxels seen from
/// there.
Model ObjectLattices::shared_model(const Object& object) const {
    Model model = scene_.models[size_t(object.model)];
    const double scale = stretch_of(glm::dmat3(object.world_from_object)).min;
    const double step = std::ceil(-kStepsPerOctave * std::log2(scale) - kSameSize);
    model.voxel_size = scene_.world.voxel_size * std::exp2(step / kStepsPerOctave);
    model.resolution = 0;
    return model;
}

GridFrame ObjectLattices::own_frame(const Object& object) {
    const Model& model = scene_.models[size_t(object.model)];
    if (has_own_voxels(model)) return meshes_.voxels(model).frame;
    const bool is_shared = lattice_of(object) == Lattice::shared;
    return model_frame(is_shared ? shared_model(object) : model, meshes_.summary_of(model));
}

/// Refuses a field in a file that is too fine to be resampled.
void ObjectLattices::check_field(const Object& object) {
    if (!is_finer_field(scene_, object, meshes_)) return;
    const GridFrame& frame = meshes_.voxels(scene_.models[size_t(object.model)]).frame;
    throw Error(ErrorKind::scene,
                "{}: the object \"{}\" can't be placed in the world: the voxels of its file, with "
                "distances for a few of them, are {:.3g} times as fine as the world's: give it "
                "\"placement\": \"instance\", or the world a smaller \"voxel_size\"",
                object.where, object.name,
                voxels_per_world_voxel(frame, world_frame(scene_.world), object.world_from_object));
}

ObjectLattice world_lattice(const Scene& scene, const Object& object) {
    return {Lattice::world, world_frame(scene.world), object.world_from_object, glm::dmat4(1)};
}

ObjectLattice ObjectLattices::of(const Object& object, const VoxelBox& box) {
    check_field(object);
    const Lattice lattice = lattice_of(object);
    if (lattice != Lattice::world)
        return {lattice, own_frame(object), glm::dmat4(1), object.world_from_object};
    ObjectLattice whole = world_lattice(scene_, object);
    if (lists_primitives(scene_.models[size_t(object.model)].surface)) return whole;
    check_invertible(object.world_from_object, uint32_t(&object - scene_.objects.data()));
    whole.frame = part_around(box, whole.frame);
    return whole;
}

}  // namespace voxelume
