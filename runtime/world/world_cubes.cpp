// SPDX-License-Identifier: Apache-2.0
#include "runtime/world/world_cubes.hpp"

#include "runtime/analysis/object_boxes.hpp"
#include "runtime/analysis/placed_objects.hpp"
#include "runtime/assets/voxel_paint.hpp"
#include "runtime/grid/world_frame.hpp"
#include "runtime/memory/plan.hpp"
#include "runtime/scene/fitted.hpp"
#include "runtime/stages/place/placed_world.hpp"
#include "runtime/world/grid_cache.hpp"

namespace voxelume {
namespace {

void show_as_cubes(Scene& scene) {
    for (Model& model : scene.models) {
        model.surface = Surface::cubes;
        model.is_surface_open = false;
        model.normals = CubeNormals::faces;
        model.shading = {};
    }
    for (Object& object : scene.objects) object.placement = Placement::world;
}

/// Gives the world voxels of the size, and the models those that become such.
void resize_voxels(CubeSize size, Scene& scene) {
    World& world = scene.world;
    const double edge = size.edge > 0         ? size.edge
                        : size.resolution > 0 ? longest_side(world.bounds) / size.resolution
                                              : 0;
    if (edge <= 0) return;
    const glm::dvec3 factor = edge / world.voxel_size;
    world.voxel_size = glm::dvec3(edge);
    count_voxels(world);
    for (Model& model : scene.models)
        if (!model.is_sized) model.voxel_size *= factor;
}

}  // namespace

VoxelModel world_cubes(const Device& device, Scene scene, AssetStore meshes, CubeSize size) {
    resize_voxels(size, scene);
    show_as_cubes(scene);
    check_tables(scene, device.info());
    check_memory(scene, plan_scene(scene, meshes), device.info());
    GridCache grids(device, meshes);
    std::vector<SharedGrid> shown;
    const PlacedGridSource grid_of = [&](const Object& object, const Model& model,
                                         const ObjectLattice& lattice) {
        return grids.grid_of(object, model, lattice);
    };
    const std::vector<PlacedObject> objects =
        placed_objects(scene, meshes, object_boxes(scene, meshes), grid_of, shown);
    const PlacedWorld world = place_world(device, objects, world_frame(scene.world));
    const BrickGrid& grid = world.voxels;
    VoxelModel model;
    model.frame = grid.frame;
    model.slots = grid.slots.read();
    model.coordinates = grid.coordinates.read();
    model.occupancy = grid.occupancy.read();
    model.colors = grid.colors.read();
    model.attributes = grid.attributes.read();
    paint_voxels(scene.materials, grid.attribute, model);
    return model;
}

}  // namespace voxelume
