// SPDX-License-Identifier: Apache-2.0
#include "runtime/world/voxel_warnings.hpp"

#include <fmt/format.h>

#include <glm/vector_relational.hpp>

#include "runtime/analysis/warnings/warned_object.hpp"
#include "runtime/memory/plan.hpp"

namespace voxelume {
namespace {

/// The reason why an object may have no voxel, and advice.
const char* advice_for(const Model& model) {
    if (model.solid && !model.solid->parts.empty())
        return "its parts leave nothing of each other, it is too small or thin for its voxels, or "
               "none of it lies in the world; move the parts, or try \"surface\": \"exact\"";
    if (lists_primitives(model.surface))
        return "no part of its surface lies in the world; move it, or enlarge the world's "
               "\"bounds\"";
    if (shows_voxels(model.surface) && model.set != VoxelSet::solid)
        return "none of it lies in the world; move it, or enlarge the world's \"bounds\"";
    if (model.solid)
        return "it holds the middle of no voxel, being too small or thin, or none of it lies in "
               "the world; try a smaller \"voxel_size\", or \"surface\": \"exact\"";
    return "it is thinner than its voxels, its faces turn inwards, or none of it lies in the "
           "world; try \"surface\": \"exact\"";
}

void add_empty(const Scene& scene, uint32_t number, std::vector<Warning>& warnings) {
    const Object& object = scene.objects[number];
    const Model& model = scene.models[size_t(object.model)];
    add_once({WarningKind::no_voxels, object.where,
              fmt::format("{} became no voxel, so nothing shows it: {}", title_of(object),
                          advice_for(model))},
             warnings);
}

}  // namespace

void add_empty_objects(const Scene& scene, std::span<const PlacedObject> placed,
                       std::vector<Warning>& warnings) {
    for (const PlacedObject& object : placed)
        if (object.grid->brick_count == 0) add_empty(scene, object.object, warnings);
}

void add_all_objects(const Scene& scene, std::span<const PlacedObject> placed,
                     std::vector<Warning>& warnings) {
    for (const PlacedObject& object : placed) add_empty(scene, object.object, warnings);
}

void add_empty_instances(const Scene& scene, const InstanceSet& instances,
                         std::vector<Warning>& warnings) {
    for (const Instance& instance : instances.list) {
        const InstanceModel& model = instances.models[instance.model];
        if (glm::any(glm::lessThanEqual(model.high, model.low)))
            add_empty(scene, instance.object, warnings);
    }
}

void add_large_world(const World& world, uint64_t bytes, double seconds, const ModelCache& cache,
                     std::vector<Warning>& warnings) {
    if (!cache.is_too_large(bytes, seconds)) return;
    add_once({WarningKind::world_not_cached, world.where,
              fmt::format("its voxels take {}, and the cache keeps no entry above {}, half of its "
                          "size, so each run builds them again: set VOXELUME_CACHE_MB to {} or "
                          "more",
                          bytes_text(double(bytes)), bytes_text(double(cache.max_entry_bytes())),
                          (bytes * 2 >> 20) + 1)},
             warnings);
}

}  // namespace voxelume
