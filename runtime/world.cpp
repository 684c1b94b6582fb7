#include "runtime/world.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <glm/common.hpp>
#include <map>
#include <memory>

#include "runtime/error.hpp"
#include "runtime/io/mesh_reader.hpp"
#include "runtime/stages/index.hpp"
#include "runtime/stages/place.hpp"
#include "runtime/stages/solid_bounds.hpp"
#include "runtime/stages/voxelize.hpp"
#include "runtime/stages/voxelize_solid.hpp"

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

/// The voxel edges of a model whose bounds are `extent`, metres.
glm::dvec3 voxel_edge(const Model& model, const glm::dvec3& extent) {
    if (model.resolution == 0) return model.voxel_size;
    const double longest = std::max({extent.x, extent.y, extent.z});
    if (!(longest > 0))
        throw Error(ErrorKind::input,
                    "{}: the model has no extent, so `resolution` can't give a "
                    "voxel size: give `voxel_size` instead",
                    model.where);
    return glm::dvec3(longest / model.resolution);
}

glm::dvec3 extent_of(const Mesh& mesh) {
    glm::dvec3 low(INFINITY), high(-INFINITY);
    for (const glm::uvec3& triangle : mesh.triangles) {
        for (int corner = 0; corner < 3; ++corner) {
            low = glm::min(low, glm::dvec3(mesh.positions[triangle[corner]]));
            high = glm::max(high, glm::dvec3(mesh.positions[triangle[corner]]));
        }
    }
    return high - low;
}

/// Voxelizes models once each, and exact objects one by one in the world's frame.
class ObjectMaker {
  public:
    ObjectMaker(const Device& device, const Scene& scene, WorldReport& report)
        : device_(device), scene_(scene), report_(report), voxelizer_(device) {}

    PlacedObject make(uint32_t number) {
        const Object& object = scene_.objects[number];
        const Model& model = scene_.models[size_t(object.model)];
        PlacedObject placed;
        placed.world_from_object = object.world_from_object;
        placed.object = number;
        placed.priority = object.priority;
        placed.set = model.set;
        placed.in_world_frame = model.surface == Surface::exact;
        for (const int material : materials_of_groups(object, group_names(model)))
            placed.material_of_group.push_back(uint32_t(material));
        placed.grid = placed.in_world_frame ? exact_grid(object, model) : grid_of(model);
        return placed;
    }

  private:
    const std::vector<std::string>& group_names(const Model& model) {
        static const std::vector<std::string> none;
        return model.solid ? none : mesh_of(model).group_names;
    }

    const Mesh& mesh_of(const Model& model) {
        const auto [entry, added] = meshes_.try_emplace(model.mesh);
        if (added) {
            Stopwatch watch(report_.load_seconds);
            entry->second = read_mesh(model.mesh);
            report_.triangles += entry->second.triangles.size();
            watch.stop();
        }
        return entry->second;
    }

    const BrickGrid* grid_of(const Model& model) {
        const auto found = grids_.find(&model);
        if (found != grids_.end()) return &found->second;
        const Mesh* mesh = model.solid ? nullptr : &mesh_of(model);
        Stopwatch watch(report_.voxelize_seconds);
        BrickGrid grid = mesh ? voxelized(*mesh, model) : voxelized(*model.solid, model);
        device_.finish();
        watch.stop();
        return &grids_.emplace(&model, std::move(grid)).first->second;
    }

    BrickGrid voxelized(const Mesh& mesh, const Model& model) {
        const GridFrame frame = frame_around(mesh, voxel_edge(model, extent_of(mesh)));
        return voxelizer_.voxelize(mesh, glm::dmat4(1), frame, {model.surface, model.set});
    }

    BrickGrid voxelized(const Solid& solid, const Model& model) {
        const SolidBounds reach = {model.reach.min, model.reach.max};
        const glm::dmat4 identity(1);
        const SolidBounds box = bounds(solid, identity, reach);
        const GridFrame frame =
            frame_around(solid, identity, voxel_edge(model, box.max - box.min), 4, reach);
        return voxelize_solid(device_, solid, identity, frame, {model.surface, model.set});
    }

    const BrickGrid* exact_grid(const Object& object, const Model& model) {
        const Mesh* mesh = model.solid ? nullptr : &mesh_of(model);
        Stopwatch watch(report_.voxelize_seconds);
        const GridFrame frame = world_frame(scene_.world);
        const VoxelizeOptions options = {model.surface, model.set};
        BrickGrid grid =
            mesh ? voxelizer_.voxelize(*mesh, object.world_from_object, frame, options)
                 : voxelize_solid(device_, *model.solid, object.world_from_object, frame, options);
        device_.finish();
        watch.stop();
        exact_grids_.push_back(std::make_unique<BrickGrid>(std::move(grid)));
        return exact_grids_.back().get();
    }

    const Device& device_;
    const Scene& scene_;
    WorldReport& report_;
    Voxelizer voxelizer_;
    std::map<std::filesystem::path, Mesh> meshes_;
    std::map<const Model*, BrickGrid> grids_;
    std::vector<std::unique_ptr<BrickGrid>> exact_grids_;
};

/// Whether any part of the object can lie inside the world, as far as can be told without its mesh.
bool is_in_reach(const Scene& scene, const Object& object) {
    const Model& model = scene.models[size_t(object.model)];
    const SolidBounds reach = {model.reach.min, model.reach.max};
    if (reach.is_empty()) return false;
    return !model.solid || !bounds(*model.solid, glm::dmat4(1), reach).is_empty();
}

}  // namespace

GridFrame world_frame(const World& world) {
    return {world.bounds.min, world.voxel_size, world.voxels};
}

Pyramid form_world(const Device& device, const Scene& scene, WorldReport& report) {
    ObjectMaker maker(device, scene, report);
    std::vector<PlacedObject> placed;
    for (uint32_t number = 0; number < scene.objects.size(); ++number)
        if (is_in_reach(scene, scene.objects[number])) placed.push_back(maker.make(number));

    Stopwatch place_watch(report.place_seconds);
    const BrickGrid world = place(device, placed, world_frame(scene.world));
    device.finish();
    place_watch.stop();

    Stopwatch index_watch(report.index_seconds);
    Pyramid pyramid = build_index(device, world);
    device.finish();
    index_watch.stop();
    return pyramid;
}

}  // namespace voxelume
