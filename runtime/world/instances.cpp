// SPDX-License-Identifier: Apache-2.0
#include "runtime/world/instances.hpp"

#include <algorithm>
#include <chrono>
#include <utility>

#include "runtime/base/error.hpp"
#include "runtime/grid/pyramid_bytes.hpp"
#include "runtime/scene/predicates.hpp"
#include "runtime/stages/instance/instance_pools.hpp"
#include "runtime/stages/instance/instances.hpp"

namespace voxelume {

void InstanceModels::forget_unused(const ListedInstances& listed, uint64_t room) {
    for (Kept& kept : std::exchange(kept_, {})) {
        const bool is_listed = std::ranges::find(listed.grids, kept.grid) != listed.grids.end();
        const uint64_t bytes = is_listed ? 0 : bytes_of(kept.model.pyramid);
        if (!is_listed && (kept.grid.use_count() == 1 || bytes > room)) continue;
        room -= bytes;
        kept_.push_back(std::move(kept));
    }
}

Pyramid InstanceModels::join(const Scene& scene, const ListedInstances& listed, Pyramid world,
                             InstanceReport& report) {
    const std::vector<Kept> before = std::exchange(kept_, {});
    for (const Kept& kept : before) {
        const bool is_listed = std::ranges::find(listed.grids, kept.grid) != listed.grids.end();
        if (!is_listed) kept_.push_back(kept);
    }
    if (listed.list.empty()) return world;
    const auto start = std::chrono::steady_clock::now();
    std::vector<ModelPyramid> models;
    for (const SharedGrid& grid : listed.grids) {
        const auto found = std::ranges::find(before, grid, &Kept::grid);
        if (found == before.end()) ++report.indexed;
        models.push_back(found == before.end() ? index_model(device_, *grid) : found->model);
        kept_.push_back({grid, models.back()});
        report.voxels += models.back().pyramid.voxel_count;
        report.bytes += bytes_of(models.back().pyramid);
    }
    Pyramid joined = join_models(device_, world, models);
    set_instances(device_, listed.list, listed.materials, joined);
    move_instances(device_, scene, joined);
    device_.finish();
    report.instances = static_cast<uint32_t>(joined.instances.list.size());
    report.models = static_cast<uint32_t>(models.size());
    report.seconds =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    return joined;
}

std::vector<InstancePlace> instance_places(const Scene& scene, const Pyramid& world) {
    std::vector<InstancePlace> places;
    places.reserve(world.instances.list.size());
    for (const Instance& instance : world.instances.list)
        places.push_back({instance.object, scene.objects[instance.object].world_from_object});
    return places;
}

uint32_t count_moved(const std::vector<InstancePlace>& before,
                     const std::vector<InstancePlace>& now) {
    uint32_t moved = 0;
    auto old = before.begin();
    for (const InstancePlace& place : now) {
        while (old != before.end() && old->object < place.object) ++old;
        moved += old == before.end() || *old != place;
    }
    return moved;
}

void leave_out_places_of_instances(const Scene& scene, std::vector<Model>& models,
                                   std::vector<Object>& objects) {
    std::vector<bool> is_baked(models.size(), false);
    for (size_t number = 0; number < objects.size(); ++number) {
        if (is_instanced(scene, scene.objects[number]))
            objects[number].world_from_object = glm::dmat4(1);
        else
            is_baked[size_t(objects[number].model)] = true;
    }
    for (size_t model = 0; model < models.size(); ++model)
        if (!is_baked[model]) models[model].extent = {};
}

void move_instances(const Device& device, const Scene& scene, Pyramid& world) {
    std::vector<glm::dmat4> maps;
    maps.reserve(scene.objects.size());
    for (const Object& object : scene.objects) maps.push_back(object.world_from_object);
    place_instances(device, maps, world);
}

}  // namespace voxelume
