// SPDX-License-Identifier: Apache-2.0
#include "runtime/analysis/placed_objects.hpp"

#include <map>

#include "runtime/analysis/object_boxes.hpp"
#include "runtime/assets/model_frame.hpp"
#include "runtime/base/error.hpp"
#include "runtime/scene/predicates.hpp"

namespace voxelume {
namespace {

constexpr double kFar = 1e9;  // metres

/// The model as an instance shows it: whole, wherever the world ends.
Model whole(Model model) {
    model.extent = {glm::dvec3(-kFar), glm::dvec3(kFar)};
    return model;
}

/// An object of the scene as it is placed, except for its grid.
PlacedObject placed_object(const Scene& scene, uint32_t number, const Model& model,
                           const ObjectLattice& lattice, AssetStore& meshes) {
    const Object& object = scene.objects[number];
    const bool has_own_voxels = !model.voxels.empty() && !lists_primitives(model.surface);
    PlacedObject placed{.object = number};
    placed.in_world_frame = lists_primitives(model.surface);
    placed.world_from_object = lattice.world_from_frame;
    placed.priority = object.priority;
    placed.set = has_own_voxels ? meshes.voxels(model).set : model.set;
    placed.keeps_inside = keeps_inside(scene, object, model);
    for (const int material : materials_of_groups(object, meshes.groups_of(model)))
        placed.material_of_group.push_back(uint32_t(material));
    return placed;
}

}  // namespace

bool keeps_inside(const Scene& scene, const Object& object, const Model& model) {
    return shows_inside(scene, object) ||
           (!model.voxels.empty() && shows_voxels(model.surface) && transmits(scene, object));
}

std::vector<PlacedObject> placed_objects(const Scene& scene, AssetStore& meshes,
                                         std::span<const VoxelBox> boxes,
                                         const PlacedGridSource& grid_of,
                                         std::vector<SharedGrid>& grids) {
    ObjectLattices lattices(scene, meshes);
    std::vector<PlacedObject> objects;
    for (uint32_t number = 0; number < scene.objects.size(); ++number) {
        const Object& object = scene.objects[number];
        if (is_instanced(scene, object) || !is_potentially_visible(scene, object)) continue;
        if (!overlap(boxes[number], boxes[number])) continue;  // nothing of it is in the world
        const Model& model = scene.models[size_t(object.model)];
        const ObjectLattice lattice = lattices.of(object, boxes[number]);
        objects.push_back(placed_object(scene, number, model, lattice, meshes));
        grids.push_back(grid_of(object, model, lattice));
        objects.back().grid = grids.back().get();
        const std::optional<Model> part = thin_part_of(model);
        if (!part) continue;
        const ObjectLattice in_world = world_lattice(scene, object);
        objects.push_back(placed_object(scene, number, *part, in_world, meshes));
        grids.push_back(grid_of(object, *part, in_world));
        objects.back().grid = grids.back().get();
    }
    return objects;
}

ListedInstances list_instances(const Scene& scene, AssetStore& meshes, const GridSource& grid_of) {
    ListedInstances listed;
    std::map<std::pair<int, bool>, uint32_t> numbers;
    const auto add_instance = [&](const Object& object, uint32_t number, const Model& model) {
        const auto [entry, added] = numbers.emplace(std::pair(object.model, model.is_thin_part),
                                                    static_cast<uint32_t>(listed.grids.size()));
        if (added) listed.grids.push_back(grid_of(object, whole(model)));
        if (listed.grids[entry->second]->transparent)
            throw Error(ErrorKind::scene,
                        "{}: some voxels of its model let light through, and rays go through "
                        "cubes of the world only; give it \"placement\": \"world\"",
                        object.where);
        const std::vector<int> groups = materials_of_groups(object, meshes.groups_of(model));
        listed.list.push_back({.object = number,
                               .model = entry->second,
                               .first_material = static_cast<uint32_t>(listed.materials.size()),
                               .material_count = static_cast<uint32_t>(groups.size())});
        for (const int material : groups)
            listed.materials.push_back(static_cast<uint32_t>(material));
    };
    for (uint32_t number = 0; number < scene.objects.size(); ++number) {
        const Object& object = scene.objects[number];
        if (!object.visible || !object.potentially_visible || !is_instanced(scene, object))
            continue;
        const Model& model = scene.models[size_t(object.model)];
        add_instance(object, number, model);
        if (const std::optional<Model> part = thin_part_of(model))
            add_instance(object, number, *part);
    }
    return listed;
}

}  // namespace voxelume
