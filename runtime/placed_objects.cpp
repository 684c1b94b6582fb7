#include "runtime/placed_objects.hpp"

#include "runtime/analysis/object_boxes.hpp"
#include "runtime/assets/model_frame.hpp"
#include "runtime/world/instances.hpp"

namespace voxelume {

std::vector<PlacedObject> placed_objects(const Scene& scene, AssetStore& meshes,
                                         std::span<const VoxelBox> boxes, const GridSource& grid_of,
                                         std::vector<SharedGrid>& grids) {
    std::vector<PlacedObject> objects;
    for (uint32_t number = 0; number < scene.objects.size(); ++number) {
        const Object& object = scene.objects[number];
        if (is_instanced(scene, object) || !is_potentially_visible(scene, object)) continue;
        if (!overlap(boxes[number], boxes[number])) continue;  // nothing of it is in the world
        const Model& model = scene.models[size_t(object.model)];
        const bool has_own_voxels = !model.voxels.empty() && !lists_primitives(model.surface);
        grids.push_back(grid_of(object, model));
        PlacedObject placed{.grid = grids.back().get(), .object = number};
        placed.in_world_frame = lists_primitives(model.surface);
        placed.world_from_object = placed.in_world_frame ? glm::dmat4(1) : object.world_from_object;
        placed.priority = object.priority;
        placed.set = has_own_voxels ? meshes.voxels(model).set : model.set;
        placed.keeps_inside =
            shows_inside(scene, object) ||
            (has_own_voxels && shows_voxels(model.surface) && transmits(scene, object));
        for (const int material : materials_of_groups(object, meshes.groups_of(model)))
            placed.material_of_group.push_back(uint32_t(material));
        objects.push_back(std::move(placed));
    }
    return objects;
}

}  // namespace voxelume
