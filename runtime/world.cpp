#include "runtime/world.hpp"

#include <chrono>
#include <map>
#include <memory>

#include "runtime/model_grid.hpp"
#include "runtime/plan.hpp"
#include "runtime/stages/index.hpp"
#include "runtime/stages/place.hpp"

namespace voxelume {
namespace {

/// Adds the time until `stop` to a sum of seconds.
class Stopwatch {
  public:
    explicit Stopwatch(double& seconds) : seconds_(seconds) {}
    void stop() {
        seconds_ += std::chrono::duration<double>(Clock::now() - start_).count();
        start_ = Clock::now();
    }

  private:
    using Clock = std::chrono::steady_clock;
    double& seconds_;
    Clock::time_point start_ = Clock::now();
};

/// Voxelizes models once each, and exact objects one by one in the world's frame.
class ObjectMaker {
  public:
    ObjectMaker(const Device& device, const Scene& scene, MeshStore& meshes, WorldReport& report)
        : scene_(scene), meshes_(meshes), report_(report), voxelizer_(device, meshes) {}

    PlacedObject make(uint32_t number) {
        const Object& object = scene_.objects[number];
        const Model& model = scene_.models[size_t(object.model)];
        PlacedObject placed;
        placed.world_from_object = object.world_from_object;
        placed.object = number;
        placed.priority = object.priority;
        placed.set = is_voxels(model) ? meshes_.voxels(model).set : model.set;
        placed.in_world_frame = model.surface == Surface::exact;
        placed.keeps_inside =
            shows_inside(scene_, object) ||
            (is_voxels(model) && model.surface == Surface::cubes && transmits(scene_, object));
        for (const int material : materials_of_groups(object, meshes_.groups_of(model)))
            placed.material_of_group.push_back(uint32_t(material));
        placed.grid = placed.in_world_frame ? exact_grid(object, model) : grid_of(model);
        return placed;
    }

  private:
    const BrickGrid* grid_of(const Model& model) {
        const auto found = grids_.find(&model);
        if (found != grids_.end()) return &found->second;
        Stopwatch watch(report_.voxelize_seconds);
        BrickGrid grid = voxelizer_.in_own_frame(model);
        watch.stop();
        return &grids_.emplace(&model, std::move(grid)).first->second;
    }

    const BrickGrid* exact_grid(const Object& object, const Model& model) {
        Stopwatch watch(report_.voxelize_seconds);
        exact_grids_.push_back(std::make_unique<BrickGrid>(voxelizer_.in_frame(
            model, object.world_from_object, world_frame(scene_.world), object.where)));
        watch.stop();
        return exact_grids_.back().get();
    }

    const Scene& scene_;
    MeshStore& meshes_;
    WorldReport& report_;
    ModelVoxelizer voxelizer_;
    std::map<const Model*, BrickGrid> grids_;
    std::vector<std::unique_ptr<BrickGrid>> exact_grids_;
};

/// The world's bricks. The models' own grids go when it returns.
BrickGrid place_objects(const Device& device, const Scene& scene, MeshStore& meshes,
                        WorldReport& report) {
    ObjectMaker maker(device, scene, meshes, report);
    std::vector<PlacedObject> placed;
    for (uint32_t number = 0; number < scene.objects.size(); ++number)
        if (is_in_reach(scene, scene.objects[number]) &&
            !is_instanced(scene, scene.objects[number]))
            placed.push_back(maker.make(number));
    Stopwatch watch(report.place_seconds);
    BrickGrid world = place(device, placed, world_frame(scene.world));
    device.finish();
    watch.stop();
    return world;
}

}  // namespace

Pyramid form_world(const Device& device, const Scene& scene, WorldReport& report) {
    check_placements(scene);
    check_tables(scene, device.info());
    MeshStore meshes;
    check_memory(scene, plan_scene(scene, meshes), device.info());
    report.load_seconds = meshes.load_seconds();
    report.triangles = meshes.triangles();
    const BrickGrid world = place_objects(device, scene, meshes, report);

    Stopwatch watch(report.index_seconds);
    Pyramid pyramid = build_index(device, world);
    device.finish();
    watch.stop();
    return add_instances(device, scene, meshes, std::move(pyramid), report.instances);
}

}  // namespace voxelume
