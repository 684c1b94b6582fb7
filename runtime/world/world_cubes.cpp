// SPDX-License-Identifier: Apache-2.0
#include "runtime/world/world_cubes.hpp"

#include <algorithm>
#include <optional>

#include "runtime/analysis/object_boxes.hpp"
#include "runtime/analysis/placed_objects.hpp"
#include "runtime/assets/voxel_model_file.hpp"
#include "runtime/assets/voxel_paint.hpp"
#include "runtime/base/error.hpp"
#include "runtime/base/main_memory.hpp"
#include "runtime/grid/brick_cells.hpp"
#include "runtime/grid/world_frame.hpp"
#include "runtime/io/voxel_art/cube_list.hpp"
#include "runtime/memory/plan.hpp"
#include "runtime/scene/fitted.hpp"
#include "runtime/scene/predicates.hpp"
#include "runtime/stages/place/placed_world.hpp"
#include "runtime/world/grid_cache.hpp"

namespace voxelume {
namespace {

/// Refuses a file whose surface isn't cubes.
void refuse_field(const Model& model) {
    if (model.voxels.empty() || model.given) return;
    const std::optional<Surface> found = surface_of_voxel_model(model.voxels);
    const bool is_level_set = model.voxels.extension() == ".vdb" && stores_distances(model.surface);
    if ((!found || shows_voxels(*found)) && !is_level_set) return;
    throw Error(ErrorKind::input,
                "{}: {} has a surface that is {}, of which no cubes can be made: voxelize what it "
                "was made from with --surface cubes",
                model.where, model.voxels.filename().string(),
                kind_of(found.value_or(Surface::smooth)).name);
}

void show_as_cubes(Scene& scene) {
    scene.render.shows_image = scene.render.shows_volume = false;
    for (Model& model : scene.models) {
        refuse_field(model);
        model.surface = Surface::cubes;
        model.is_surface_open = false;
        model.normals = CubeNormals::faces;
        model.shading = {};
    }
    for (Object& object : scene.objects) object.placement = Placement::world;
}

/// Gives the world, and the models that become cubes in it, voxels of this edge.
void resize_voxels(double edge, Scene& scene) {
    World& world = scene.world;
    const glm::dvec3 factor = edge / world.voxel_size;
    world.voxel_size = glm::dvec3(edge);
    count_voxels(world);
    for (Model& model : scene.models)
        if (!model.is_sized) model.voxel_size *= factor;
}

/// Throws Error::limit if main memory can't hold `bricks`: their colours, the numbers of their
/// materials, and two more copies of the colours while a file is written.
void check_room(const World& world, uint32_t bricks) {
    constexpr double kBytes = 4.0 * sizeof(uint32_t) * kVoxelsPerBrick;
    const double needed = kBytes * bricks, there = double(main_memory());
    if (needed <= there) return;
    throw Error(
        ErrorKind::limit,
        "{}: as cubes of {:.4g} m the scene needs {} of main memory, of which there is {}: "
        "use larger voxels, or leave out what is large, as `voxelize --without ground` does",
        world.where, world.voxel_size.x, bytes_text(needed), bytes_text(there));
}

/// Reads a buffer and frees it.
template <class Element>
std::vector<Element> taken(Buffer<Element>& buffer) {
    std::vector<Element> elements = buffer.read();
    buffer = {};
    return elements;
}

VoxelModel cubes_of(const Device& device, const Scene& scene, AssetStore& meshes) {
    check_tables(scene, device.info());
    check_memory(scene, plan_scene(scene, meshes, device.info()), device.info());
    GridCache grids(device, meshes);
    std::vector<SharedGrid> shown;
    const PlacedGridSource grid_of = [&](const Object& object, const Model& model,
                                         const ObjectLattice& lattice) {
        return grids.grid_of(object, model, lattice, transmits(scene, object));
    };
    const std::vector<PlacedObject> objects =
        placed_objects(scene, meshes, object_boxes(scene, meshes), grid_of, shown);
    PlacedWorld world = place_world(device, objects, world_frame(scene.world));
    BrickGrid& grid = world.voxels;
    check_room(scene.world, grid.brick_count);
    VoxelModel model;
    model.frame = grid.frame;
    model.slots = taken(grid.slots);
    model.coordinates = taken(grid.coordinates);
    model.occupancy = taken(grid.occupancy);
    model.colors = taken(grid.colors);
    model.attributes = taken(grid.attributes);
    paint_voxels(scene.materials, grid.attribute, model);
    return model;
}

}  // namespace

VoxelModel world_cubes(const Device& device, Scene scene, AssetStore meshes, CubeSize size) {
    show_as_cubes(scene);
    if (size.edge > 0) resize_voxels(size.edge, scene);
    VoxelModel model = cubes_of(device, scene, meshes);
    if (size.edge > 0 || size.resolution == 0) return model;
    const glm::dvec3 sides = glm::dvec3(size_of_cubes(model)) * model.frame.voxel_edge;
    resize_voxels(std::max({sides.x, sides.y, sides.z}) / size.resolution, scene);
    return cubes_of(device, scene, meshes);
}

}  // namespace voxelume
