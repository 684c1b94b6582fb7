// SPDX-License-Identifier: Apache-2.0
#include "runtime/analysis/medium_set.hpp"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vector_relational.hpp>

#include "runtime/analysis/object_boxes.hpp"
#include "runtime/scene/predicates.hpp"

namespace voxelume {
namespace {

const Model& model_of(const Scene& scene, const Object& object) {
    return scene.models[size_t(object.model)];
}

/// True if the object may let light through, for its material or for its voxels' opacity.
bool may_transmit(const Scene& scene, const Object& object, const Features& features) {
    return transmits(scene, object) ||
           (features.voxel_opacity && shows_voxels(model_of(scene, object).surface));
}

/// An upper bound of the number of transmitting objects at one point: the maximum number of boxes
/// that overlap the box of one of them.
int max_overlapping(const Scene& scene, const Pyramid& world, const Features& features) {
    std::vector<size_t> objects;
    for (size_t i = 0; i < scene.objects.size(); ++i)
        if (may_transmit(scene, scene.objects[i], features)) objects.push_back(i);
    if (world.object_boxes.empty()) return int(objects.size());
    // Instances move without a new build of the world, and so without new boxes.
    const auto moves = [&](size_t i) { return is_instanced(scene, scene.objects[i]); };
    const auto overlapping = [&](size_t i) {
        return std::ranges::count_if(objects, [&](size_t j) {
            return moves(i) || moves(j) || overlap(world.object_boxes[i], world.object_boxes[j]);
        });
    };
    int64_t maximum = 0;
    for (const size_t i : objects) maximum = std::max(maximum, int64_t(overlapping(i)));
    return int(maximum);
}

/// The maximum distance along each axis, in voxels, between the start of a ray through the lens and
/// the start of the observer's central ray. Rays begin at depth `near`, where the lens's disk is
/// scaled by |1 - near / focus|.
glm::dvec3 lens_reach(const Observer& observer, const GridFrame& world) {
    if (!(observer.aperture > 0)) return glm::dvec3(0);
    const glm::dvec3 ahead = observer.world_from_observer[2];
    const double scale = std::abs(1 - observer.display.near / observer.focus);
    const glm::dvec3 sines = glm::sqrt(glm::max(1.0 - ahead * ahead, 0.0));
    return observer.aperture / 2 * std::max(scale, 1.0) * sines / world.voxel_edge;
}

/// True if rays from the observer may begin in a box: near their display's near surface, or where
/// they enter across the world's sides.
bool may_begin_in(const VoxelBox& box, const Scene& scene, const GridFrame& world) {
    const glm::dvec3 eye = (scene.observer.position - world.origin) / world.voxel_edge;
    const Display display =
        with_filter_margin(scene.observer.display, scene.render.filter, frame_size(scene.render));
    const glm::dvec3 lens = lens_reach(scene.observer, world);
    const glm::dvec3 reach = shape_row(display).start_radius(display) / world.voxel_edge + lens;
    if (overlap(box, {eye - reach, eye + reach})) return true;
    const VoxelBox all = {glm::dvec3(0), glm::dvec3(world.size)};
    const bool is_at_side = glm::any(glm::lessThanEqual(box.low, all.low)) ||
                            glm::any(glm::greaterThanEqual(box.high, all.high));
    const bool is_within = glm::all(glm::greaterThanEqual(eye - lens, all.low)) &&
                           glm::all(glm::lessThanEqual(eye + lens, all.high));
    return is_at_side && overlap(box, all) && !is_within;
}

}  // namespace

Features begun_anywhere(Features features, const Scene& scene) {
    features.observer_in_medium = features.transmission && hollow_objects(scene).maximum > 0;
    return features;
}

bool may_begin_inside(const Scene& scene, const Pyramid& world) {
    for (size_t i = 0; i < scene.objects.size(); ++i) {
        const Object& object = scene.objects[i];
        const bool has_inside = !shows_voxels(model_of(scene, object).surface);
        if (!object.visible || !object.potentially_visible || !has_inside ||
            !transmits(scene, object))
            continue;
        const bool is_known = !world.object_boxes.empty() && !is_instanced(scene, object);
        if (!is_known || may_begin_in(world.object_boxes[i], scene, world.frame)) return true;
    }
    return false;
}

void add_medium_set(const Scene& scene, const Pyramid& world, Features& features) {
    if (!features.transmission) return;
    const int media = max_overlapping(scene, world, features);
    features.media = std::min(media, kMaxMedia);
    features.medium_set_capped = media > kMaxMedia;
    const std::vector<uint32_t> hollow = hollow_objects(scene).flags;
    for (size_t i = 0; i < world.object_boxes.size(); ++i)
        features.observer_in_medium |=
            hollow[i] == 1 && (is_instanced(scene, scene.objects[i]) ||
                               may_begin_in(world.object_boxes[i], scene, world.frame));
}

}  // namespace voxelume
