// scene -> S: every object voxelized, placed, and indexed for rays. The paper's block 1.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "runtime/grid/grid.hpp"
#include "runtime/scene/scene.hpp"
#include "runtime/stages/index/index.hpp"
#include "runtime/stages/place/place.hpp"
#include "runtime/world/grid_cache.hpp"
#include "runtime/world/instances.hpp"

namespace voxelume {

/// What a frame's world is to the frame before.
enum class WorldChange : uint8_t {
    none,       ///< the same, untouched
    instances,  ///< the same voxels; instances have moved
    built       ///< formed anew, of what parts could be kept
};

/// What forming the world took, for people and tests.
struct WorldReport {
    double load_seconds = 0;      ///< reading model files
    double voxelize_seconds = 0;  ///< waiting for the device included
    double place_seconds = 0;
    double index_seconds = 0;
    double keep_seconds = 0;  ///< writing models and the world to the cache on disk
    uint64_t triangles = 0;
    uint64_t meshes_read = 0;
    uint64_t culled = 0;          ///< objects to be seen that no ray meets: not voxelized
    uint64_t voxelized = 0;       ///< models and exact objects that were voxelized
    uint64_t from_cache = 0;      ///< those whose voxels the model cache had
    uint64_t painted_bricks = 0;  ///< of the world, that objects were painted into
    WorldChange change = WorldChange::built;
    bool is_from_cache = false;  ///< an earlier run formed it
    bool lacks_room = false;     ///< for what the next frame may use of it: memory doesn't suffice
    InstanceReport instances;
};

/// S on a device.
struct BuiltWorld {
    Pyramid pyramid;
    uint64_t version = 0;  ///< the same as long as the world is, counted by who formed it
};

/// Forms the world of one frame after another, and of each only what differs from the one before.
///
/// Models' grids, the world's bricks and its pyramid stay as long as frames show them, if the
/// device has the memory by the least that they may take; instances that move then cost no more
/// than their maps. What a frame shows is the same, bit for bit, whatever came before it.
class WorldBuilder {
  public:
    /// Where nothing `follows` the first frame, nothing is kept.
    /// Meshes that `meshes` has already, or whose voxels are in its cache, are not read.
    explicit WorldBuilder(const Device& device, bool follows = true,
                          AssetStore meshes = AssetStore())
        : device_(device),
          follows_(follows),
          meshes_(std::move(meshes)),
          indexer_(device),
          models_(device) {}

    /// Forms S from the scene's objects. Models that no object shows inside the world are not read.
    ///
    /// The plan is made and checked first (runtime/memory/plan.hpp), so a world that doesn't fit
    /// costs nothing. What was made of models that are `retained`, by their numbers, is kept while
    /// no object shows them, in an eighth of the device's memory where a frame and the next leave
    /// as much, and none of it once forming a world took all memory; their meshes stay in main
    /// memory, as many as take no more bytes than that. Throws Error::input for a damaged model,
    /// Error::scene for a placement or group name that doesn't fit, Error::limit for a world that
    /// the device has no memory for.
    BuiltWorld build(const Scene& scene, WorldReport& report,
                     const std::vector<bool>& retained = {});

    /// Whether the last world that was formed, or was to be, keeps memory for the next frame. What
    /// it takes may be more than is left for the frame itself.
    bool keeps() const { return keeps_; }

  private:
    /// What the kept world was formed from, if nothing else of a scene matters to it but where its
    /// instances are.
    struct Origin {
        World world;
        std::vector<Model> models;
        std::vector<Object> objects;
        std::vector<bool> transmits;  ///< of each material
        std::vector<bool> instanced;  ///< each object
        friend bool operator==(const Origin&, const Origin&) = default;
    };

    static Origin origin_of(const Scene& scene);
    BuiltWorld build_anew(const Scene& scene, const Origin& origin, WorldReport& report,
                          const std::vector<bool>& retained);
    BuiltWorld kept_world(const Scene& scene, WorldReport& report);
    /// What forming a world is asked for.
    struct Task {
        const Scene& scene;
        const std::vector<bool>& retained;
        bool keeps;     ///< what the next frame may use
        uint64_t room;  ///< for what is retained, in bytes of the device
        WorldReport& report;
    };
    /// The world's voxels as they were read from the cache on disk.
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
    bool retains_ = true;  ///< whether models that aren't shown are kept
    AssetStore meshes_;
    double load_seconds_ = 0;  ///< of meshes_, in reports so far
    uint64_t meshes_read_ = 0;
    std::optional<GridCache> grids_;
    std::vector<SharedGrid> shown_;  ///< that the placer's objects name
    std::optional<ReadWorld> read_;
    std::optional<Placer> placer_;
    Indexer indexer_;
    std::optional<Origin> origin_;
    InstanceModels models_;
    std::vector<InstancePlace> instance_places_;
    InstanceReport instances_;
    BuiltWorld world_;
    Density density_;  ///< of the medium, as world_.pyramid.clear has it
};

/// The world of a single frame.
Pyramid build_world(const Device& device, const Scene& scene, WorldReport& report);

}  // namespace voxelume
