// SPDX-License-Identifier: Apache-2.0
// scene -> S: every object voxelized, placed, and indexed for rays. The paper's block 1.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "runtime/base/warning.hpp"
#include "runtime/grid/grid.hpp"
#include "runtime/scene/scene.hpp"
#include "runtime/stages/index/index.hpp"
#include "runtime/stages/place/placed_world.hpp"
#include "runtime/world/grid_cache.hpp"
#include "runtime/world/instances.hpp"
#include "runtime/world/source_meshes.hpp"

namespace voxelume {

struct ScenePlan;

/// The relation of a frame's world to that of the frame before.
enum class WorldChange : uint8_t {
    none,       ///< the same world
    instances,  ///< the same voxels; instances have moved
    built       ///< rebuilt, from kept parts where possible
};

/// The time and work of building the world, for people and tests.
struct WorldReport {
    double load_seconds = 0;      ///< reading model files
    double voxelize_seconds = 0;  ///< includes waiting for the device
    double place_seconds = 0;
    double index_seconds = 0;
    double keep_seconds = 0;  ///< writing models and the world to the cache on disk
    uint64_t triangles = 0;
    uint64_t meshes_read = 0;
    uint64_t culled = 0;          ///< visible objects that no ray can meet, which aren't voxelized
    uint64_t voxelized = 0;       ///< models and exact objects that were voxelized
    uint64_t from_cache = 0;      ///< number of those whose voxels were in the model cache
    uint64_t painted_bricks = 0;  ///< bricks of the world that were painted
    WorldChange change = WorldChange::built;
    bool is_from_cache = false;  ///< true if an earlier run built it
    bool lacks_room = false;     ///< true if memory doesn't suffice to keep what the next frame may
                                 ///< use
    InstanceReport instances;
    std::vector<Warning> warnings;
};

/// S on a device.
struct BuiltWorld {
    Pyramid pyramid;
    uint64_t version = 0;  ///< equal versions are equal worlds
};

/// Builds the worlds of successive frames, each time only the parts that differ from the frame
/// before.
///
/// Models' grids, the world's bricks and its pyramid are kept as long as frames show them, if the
/// device has memory for their minimum size. Moving instances then only need new maps. A frame
/// shows the same, bit for bit, whatever came before it.
class WorldBuilder {
  public:
    /// With `follows` = false no second frame follows the first, and nothing is retained. Meshes
    /// that `meshes` holds already, or whose voxels are in its cache, are not read.
    explicit WorldBuilder(const Device& device, bool follows = true,
                          AssetStore meshes = AssetStore())
        : device_(device),
          follows_(follows),
          meshes_(std::move(meshes)),
          indexer_(device),
          models_(device),
          sources_(device) {}

    /// Builds S from the scene's objects. Models that no object shows inside the world are not
    /// read.
    ///
    /// The plan is made and checked first (runtime/memory/plan.hpp), so a world that doesn't fit
    /// costs nothing. `retained` has a value per model. Grids and pyramids of retained models are
    /// kept while no object shows them, in an eighth of the device's memory if a frame and the next
    /// leave that much, and no longer after a world took all memory. Their meshes stay in main
    /// memory, in at most that many bytes. Throws Error::input for a damaged model, Error::scene
    /// for a placement or group name that doesn't fit, Error::limit for a world for which the
    /// device's memory doesn't suffice.
    BuiltWorld build(const Scene& scene, WorldReport& report,
                     const std::vector<bool>& retained = {});

    /// True if the last world that was built, or attempted, keeps memory for the next frame. That
    /// may be more memory than is left for the frame itself.
    bool keeps() const { return keeps_; }

  private:
    /// The data from which the kept world was built, if it depends on nothing else of a scene
    /// except the placements of its instances.
    struct Origin {
        World world;
        std::vector<Model> models;
        std::vector<Object> objects;
        std::vector<bool> transmits;  ///< for each material
        std::vector<bool> instanced;  ///< for each object
        friend bool operator==(const Origin&, const Origin&) = default;
    };

    static Origin origin_of(const Scene& scene);
    BuiltWorld rebuilt_world(const Scene& scene, const Origin& origin, WorldReport& report,
                             const std::vector<bool>& retained);
    uint64_t room_to_retain(const ScenePlan& plan, WorldReport& report);
    BuiltWorld kept_world(const Scene& scene, WorldReport& report);
    /// The parameters of building a world.
    struct Task {
        const Scene& scene;
        const std::vector<bool>& retained;
        bool keeps;     ///< true to keep parts for the next frame
        uint64_t room;  ///< bytes on the device for retained models
        WorldReport& report;
    };
    /// The world's voxels as read from the cache on disk.
    struct ReadWorld {
        std::string key;
        Pyramid pyramid;
    };
    std::optional<ReadWorld> read_world(const std::vector<std::string>& keys);
    Pyramid kept_or_new_world(const Task& task, Indexer& indexer);
    Pyramid new_world(const Task& task, Indexer& indexer);
    Pyramid placed_and_indexed(const Task& task, const std::vector<PlacedObject>& objects,
                               std::vector<SharedGrid> shown, Indexer& indexer);
    void forget_sources(const Task& task);

    Device device_;
    bool follows_;
    bool keeps_ = false;
    bool retains_ = true;  ///< true if models that aren't shown are retained
    AssetStore meshes_;
    double load_seconds_ = 0;  ///< time of meshes_ that is already reported
    uint64_t meshes_read_ = 0;
    std::optional<GridCache> grids_;
    std::vector<SharedGrid> shown_;  ///< the grids to which the placer's objects point
    std::optional<ReadWorld> read_;
    std::optional<WorldPlacer> placer_;
    Indexer indexer_;
    std::optional<Origin> origin_;
    InstanceModels models_;
    SourceMeshCache sources_;
    std::vector<InstancePlace> instance_places_;
    InstanceReport instances_;
    BuiltWorld world_;
    Density density_;  ///< the medium's density for which world_.pyramid.clear is set
};

/// The world of a single frame.
Pyramid build_world(const Device& device, const Scene& scene, WorldReport& report);

}  // namespace voxelume
