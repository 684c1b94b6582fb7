// SPDX-License-Identifier: Apache-2.0
#include "runtime/world/world.hpp"

#include <algorithm>
#include <atomic>
#include <utility>

#include "runtime/analysis/culling.hpp"
#include "runtime/analysis/model_last_uses.hpp"
#include "runtime/analysis/object_boxes.hpp"
#include "runtime/analysis/placed_objects.hpp"
#include "runtime/base/error.hpp"
#include "runtime/base/stopwatch.hpp"
#include "runtime/grid/pyramid_bytes.hpp"
#include "runtime/grid/world_frame.hpp"
#include "runtime/memory/plan.hpp"
#include "runtime/scene/predicates.hpp"
#include "runtime/stages/medium/density_grid.hpp"
#include "runtime/world/voxel_warnings.hpp"
#include "runtime/world/world_source.hpp"

namespace voxelume {
namespace {

/// Calls a part of building the world; its limit errors name the world's size.
template <class Part>
auto for_world(const World& world, const Part& part) {
    const std::string size = size_text(world.voxels);
    return with_limits_of(fmt::format("{}: a world of {} voxels", world.where, size), part,
                          world.where);
}

/// A number that is unique among the worlds of this process.
uint64_t new_version() {
    static std::atomic<uint64_t> last = 0;
    return ++last;
}

/// Adds the number of models that are voxelized during this object's life, and their time, to a
/// report.
class VoxelizingReport {
  public:
    VoxelizingReport(const GridCache& grids, const AssetStore& meshes, WorldReport& report)
        : grids_(grids), meshes_(meshes), report_(report), stopwatch_(report.voxelize_seconds) {
        add(-1);
    }
    ~VoxelizingReport() {
        add(1);
        stopwatch_.stop();
    }
    VoxelizingReport(const VoxelizingReport&) = delete;
    VoxelizingReport& operator=(const VoxelizingReport&) = delete;

  private:
    void add(int64_t sign) {
        report_.voxelized += uint64_t(sign) * grids_.voxelized();
        report_.from_cache += uint64_t(sign) * grids_.from_cache();
        report_.meshes_read += uint64_t(sign) * meshes_.meshes_read();
        report_.keep_seconds += double(sign) * grids_.keep_seconds();
        report_.voxelize_seconds -= double(sign) * grids_.keep_seconds();
    }

    const GridCache& grids_;
    const AssetStore& meshes_;
    WorldReport& report_;
    Stopwatch stopwatch_;
};

}  // namespace

WorldBuilder::Origin WorldBuilder::origin_of(const Scene& scene) {
    Origin origin{{}, scene.models, scene.objects, {}, {}};
    origin.world.bounds = scene.world.bounds;
    origin.world.voxels = scene.world.voxels;
    origin.world.voxel_size = scene.world.voxel_size;
    for (const Material& material : scene.materials)
        origin.transmits.push_back(transmits(material));
    for (const Object& object : scene.objects)
        origin.instanced.push_back(is_instanced(scene, object));
    leave_out_places_of_instances(scene, origin.models, origin.objects);
    return origin;
}

/// The world of the frame before, with its instances moved to their current placements.
BuiltWorld WorldBuilder::kept_world(const Scene& scene, WorldReport& report) {
    if (density_ != scene.world.medium.density) {
        density_ = scene.world.medium.density;
        world_.pyramid.clear = has_no_medium(scene.world);
    }
    report.triangles = meshes_.triangles();
    report.instances = instances_;
    report.instances.seconds = 0;
    report.instances.indexed = 0;
    std::vector<InstancePlace> places = instance_places(scene, world_.pyramid);
    report.instances.moved = count_moved(instance_places_, places);
    report.change = report.instances.moved == 0 ? WorldChange::none : WorldChange::instances;
    if (report.change == WorldChange::none) return world_;
    Stopwatch moving(report.instances.seconds);
    move_instances(device_, scene, world_.pyramid);
    instance_places_ = std::move(places);
    world_.version = new_version();
    moving.stop();
    return world_;
}

BuiltWorld WorldBuilder::build(const Scene& scene, WorldReport& report,
                               const std::vector<bool>& retained) {
    report.culled = uint64_t(std::ranges::count_if(
        scene.objects, [](const Object& o) { return o.visible && !o.potentially_visible; }));
    const Origin origin = origin_of(scene);
    if (origin_ == origin) return kept_world(scene, report);
    try {
        return rebuilt_world(scene, origin, report, retained);
    } catch (const Error& error) {
        const bool makes_room = grids_ && grids_->retained_bytes() > 0;
        if (error.kind() != ErrorKind::limit || !makes_room) throw;
    }
    retains_ = false;
    placer_.reset();
    shown_.clear();
    grids_->forget_unused(scene, {}, 0);
    report.instances = {};
    return rebuilt_world(scene, origin, report, retained);
}

/// Decides whether the world is kept for the next frame. Returns the number of bytes of models that
/// may be retained.
uint64_t WorldBuilder::room_to_retain(const ScenePlan& plan, WorldReport& report) {
    const double memory = double(device_.info().memory);
    keeps_ = follows_ && plan.min_with_next < memory;
    report.lacks_room = follows_ && !keeps_;
    if (!keeps_ || !retains_) return 0;
    const double spare = std::max(memory - plan.bytes_with_next(), 0.0);
    return std::min(uint64_t(spare), device_.info().memory / kRetainedPart);
}

BuiltWorld WorldBuilder::rebuilt_world(const Scene& scene, const Origin& origin,
                                       WorldReport& report, const std::vector<bool>& retained) {
    origin_.reset();
    world_.pyramid = {};
    keeps_ = false;
    // An exception leaves these empty, so that the next call keeps nothing.
    Indexer indexer = std::exchange(indexer_, Indexer(device_));
    InstanceModels models = std::exchange(models_, InstanceModels(device_));
    check_placements(scene);
    check_tables(scene, device_.info());
    const ScenePlan plan = plan_scene(scene, meshes_, device_.info());
    check_memory(scene, plan, device_.info());
    compile_ahead(device_, scene.render, plan.foreseen);
    report.load_seconds = meshes_.load_seconds() - load_seconds_;
    report.meshes_read = meshes_.meshes_read() - meshes_read_;
    report.triangles = meshes_.triangles();
    const uint64_t room = room_to_retain(plan, report);
    if (!grids_) grids_.emplace(device_, meshes_);
    ListedInstances listed;
    SourceMeshes sources;
    {
        const VoxelizingReport voxelizing(*grids_, meshes_, report);
        listed = list_instances(scene, meshes_, [&](const Object& object, const Model& model) {
            return grids_->own_grid_of(model, transmits(scene, object));
        });
        sources = sources_.meshes_of(scene, meshes_, listed);
        if (!keeps_) sources_.forget();
    }
    std::vector<VoxelBox> boxes = object_boxes(scene, meshes_);
    BuiltWorld built{kept_or_new_world({scene, retained, keeps_, room, report}, indexer),
                     world_.version = new_version()};
    load_seconds_ = meshes_.load_seconds(), meshes_read_ = meshes_.meshes_read();
    Stopwatch indexing(report.index_seconds);
    models.forget_unused(listed, keeps_ ? room - grids_->retained_bytes() : 0);
    for_world(scene.world, [&] {
        built.pyramid = models.join(scene, listed, std::move(built.pyramid), report.instances);
    });
    add_empty_instances(scene, built.pyramid.instances, report.warnings);
    std::vector<InstancePlace> places = instance_places(scene, built.pyramid);
    report.instances.moved = count_moved(instance_places_, places);
    instance_places_ = std::move(places);
    built.pyramid.cube_steps = cube_steps_on(device_, scene, meshes_, boxes);
    built.pyramid.order = coincidence_order_on(device_, scene);
    built.pyramid.object_boxes = std::move(boxes);
    built.pyramid.sources = std::move(sources);
    built.pyramid.clear = plan.medium.is_zero;
    device_.finish();
    indexing.stop();
    if (keeps_) {
        world_.pyramid = built.pyramid;
        density_ = scene.world.medium.density;
        indexer_ = std::move(indexer);
        models_ = std::move(models);
        instances_ = report.instances;
        origin_ = origin;
    }
    return built;
}

/// The first of these worlds that is in the cache and fits the device.
std::optional<WorldBuilder::ReadWorld> WorldBuilder::read_world(
    const std::vector<std::string>& keys) {
    for (const std::string& key : keys) {
        try {
            if (auto kept = meshes_.cache().world(device_, key)) return ReadWorld{key, *kept};
        } catch (const Error& error) {
            const bool is_wide = key != keys.front();
            if (error.kind() != ErrorKind::limit || !is_wide) throw;
        }
    }
    return std::nullopt;
}

/// The world's voxels from an earlier run, if possible with only the potentially visible objects;
/// else new voxels, which are written to the cache for later runs.
Pyramid WorldBuilder::kept_or_new_world(const Task& task, Indexer& indexer) {
    const std::vector<std::string> keys =
        placer_ ? std::vector<std::string>() : world_sources(task.scene, meshes_);
    if (keys.empty()) return new_world(task, indexer);
    Stopwatch reading(task.report.index_seconds);
    if (read_ && std::ranges::find(keys, read_->key) == keys.end()) read_.reset();
    task.report.is_from_cache = !read_;
    if (!read_) read_ = for_world(task.scene.world, [&] { return read_world(keys); });
    reading.stop();
    if (read_) {
        Pyramid world = read_->pyramid;
        if (read_->key != keys.front()) leave_out_culled(task.scene, world);
        if (!task.keeps) read_.reset();
        forget_sources(task);
        return world;
    }
    task.report.is_from_cache = false;
    Pyramid world = new_world(task, indexer);
    if (!task.report.warnings.empty()) return world;  // a cached world couldn't repeat the warnings
    const double seconds = task.report.place_seconds + task.report.index_seconds;
    Stopwatch keeping(task.report.keep_seconds);
    meshes_.cache().keep(keys.front(), world, seconds);
    keeping.stop();
    add_large_world(task.scene.world, bytes_of(world), seconds, meshes_.cache(),
                    task.report.warnings);
    return world;
}

Pyramid WorldBuilder::new_world(const Task& task, Indexer& indexer) {
    WorldReport& report = task.report;
    read_.reset();
    std::vector<SharedGrid> shown;
    std::vector<PlacedObject> objects;
    {
        const VoxelizingReport voxelizing(*grids_, meshes_, report);
        const PlacedGridSource grid_of = [&](const Object& object, const Model& model,
                                             const ObjectLattice& lattice) {
            return grids_->grid_of(object, model, lattice, transmits(task.scene, object));
        };
        objects =
            placed_objects(task.scene, meshes_, object_boxes(task.scene, meshes_), grid_of, shown);
    }
    add_empty_objects(task.scene, objects, report.warnings);
    Pyramid world = for_world(task.scene.world, [&] {
        return placed_and_indexed(task, objects, std::move(shown), indexer);
    });
    if (world.voxel_count == 0) add_all_objects(task.scene, objects, report.warnings);
    return world;
}

/// Places and indexes objects. `shown` are the objects' grids.
Pyramid WorldBuilder::placed_and_indexed(const Task& task, const std::vector<PlacedObject>& objects,
                                         std::vector<SharedGrid> shown, Indexer& indexer) {
    Stopwatch placing(task.report.place_seconds);
    if (!placer_) placer_.emplace(device_);
    const PlacedWorld world = placer_->place(objects, world_frame(task.scene.world));
    device_.finish();
    task.report.painted_bricks = placer_->painted_bricks();
    shown_ = std::move(shown);
    forget_sources(task);
    placing.stop();

    Stopwatch indexing(task.report.index_seconds);
    Pyramid pyramid = indexer.index(world, placer_ ? placer_->changed_bricks() : nullptr);
    device_.finish();
    indexing.stop();
    return pyramid;
}

/// Frees the sources that weren't used in this frame, except retained models. If the task keeps
/// nothing for the next frame, all are freed.
void WorldBuilder::forget_sources(const Task& task) {
    grids_->forget_unused(task.scene, task.retained, task.room);
    uint64_t room = device_.info().memory / kRetainedPart;  // for a CPU, meshes use the same memory
    for (size_t model = 0; model < task.retained.size(); ++model)
        if (task.retained[model]) meshes_.retain(task.scene.models[model], room);
    meshes_.forget_unused();
    if (task.keeps) return;
    placer_.reset();
    shown_.clear();
    grids_.reset();
    meshes_ = AssetStore(meshes_.cache());
}

Pyramid build_world(const Device& device, const Scene& scene, WorldReport& report) {
    return WorldBuilder(device, false).build(scene, report).pyramid;
}

}  // namespace voxelume
