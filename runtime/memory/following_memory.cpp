// SPDX-License-Identifier: Apache-2.0
#include "runtime/memory/following_memory.hpp"

#include <algorithm>

#include "runtime/analysis/scene_features.hpp"
#include "runtime/grid/world_frame.hpp"
#include "runtime/memory/count_image.hpp"
#include "runtime/memory/counted_grids.hpp"
#include "runtime/scene/predicates.hpp"
#include "runtime/scene/scene_animation.hpp"
#include "runtime/scene/scene_motion.hpp"
#include "runtime/stages/trace/sight.hpp"

namespace voxelume {
namespace {

/// What the scene's tracks change.
struct Changes {
    std::vector<bool> models;   ///< of each model, whether its grids do
    std::vector<bool> objects;  ///< of each object in the world's voxels, whether it does
};

Changes changes_of(const Scene& scene) {
    Changes changes{std::vector<bool>(scene.models.size()),
                    std::vector<bool>(scene.objects.size())};
    for (const MovingPart& part : scene.motion->parts) {
        if (part.part == ScenePart::object) changes.objects[part.place] = true;
        if (part.part == ScenePart::model) changes.models[part.place] = true;
    }
    for (size_t number = 0; number < scene.objects.size(); ++number) {
        const Object& object = scene.objects[number];
        const bool changes_here = changes.objects[number] || changes.models[size_t(object.model)];
        changes.objects[number] = changes_here && !is_instanced(scene, object);
    }
    return changes;
}

class FollowingWalk {
  public:
    FollowingWalk(const Scene& scene, AssetStore& meshes, ObjectCounts& objects,
                  const DensityPlan& medium)
        : scene_(scene),
          meshes_(meshes),
          objects_(objects),
          medium_(medium),
          changes_(changes_of(scene)),
          grids_(device_, scene, meshes, objects, Estimate::expected) {}

    double run() {
        const ListedInstances listed =
            list_instances(scene_, meshes_, [this](const Object& object, const Model& model) {
                return grids_.own_grid(object, model);
            });
        std::vector<WorldCounts> models;
        for (const SharedGrid& grid : listed.grids)
            models.push_back(indexed_counts(grids_.counts_of(grid)));
        std::vector<SharedGrid> shown;
        const std::vector<PlacedObject> placed = placed_objects(
            scene_, meshes_, objects_.boxes(),
            [this](const Object& object, const Model& model, const ObjectLattice& lattice) {
                return grids_.world_grid(object, model, lattice);
            },
            shown);
        const WorldCounts counts = objects_.world(Estimate::expected);
        const GridFrame frame = world_frame(scene_.world);
        const CountedWorld world = count_placing(device_, placed, frame, counts);
        const CountedPyramid indexed = count_index(device_, world, counts);
        std::vector<ModelPyramid> kept;
        Pyramid joined = count_joining(device_, listed, indexed.pyramid, models, kept);
        joined.object_boxes = objects_.boxes();
        joined.clear = medium_.is_zero;
        const ImageMemory image = count_image(device_, scene_, joined, medium_, SIZE_MAX);
        const Buffer<uint8_t> hits(device_, "hits", hit_bytes(joined));
        build_next(world, counts, listed);
        // What two frames have at once depends on which of them is ahead.
        constexpr double kAhead = 1.15;
        return kAhead * double(device_.counters().peak_bytes);
    }

  private:
    /// Counts what the next frame's world needs in addition to all that is there.
    void build_next(const CountedWorld& world, const WorldCounts& counts,
                    const ListedInstances& listed) {
        std::vector<BrickGrid> made;
        for (const CountedGrid& grid : grids_.all())
            if (changes_.models[size_t(grid.model)] ||
                (grid.object >= 0 && changes_.objects[size_t(grid.object)]))
                made.push_back(scene_.models[size_t(grid.model)].solid
                                   ? count_solid_grid(device_, grid.counts)
                                   : count_mesh_grid(device_, grid.counts));
        const auto bricks = size_t(objects_.changed_bricks(changes_.objects));
        if (bricks == 0) return;
        count_repainting(device_, world.grid.frame, std::min(2 * bricks, counts.bricks));
        // The marks stay, and all else of the index is made again.
        const Pyramid before = allocate_indexed(device_, world, counts);
        std::vector<ModelPyramid> kept;
        if (!listed.list.empty()) count_joining(device_, {{}, listed.list, {}}, before, {}, kept);
    }

    size_t hit_bytes(const Pyramid& world) const {
        const Features features = features_of(scene_, world);
        const double rays =
            16.0 * tile_count(scene_.render.size.x, scene_.render.size.y) * scene_.render.samples;
        return size_t(rays * sight_bytes(features));
    }

    const Scene& scene_;
    AssetStore& meshes_;
    ObjectCounts& objects_;
    const DensityPlan& medium_;
    Changes changes_;
    const Device device_ = Device::counting({});
    CountedGrids grids_;
};

}  // namespace

double walk_following(const Scene& scene, AssetStore& meshes, ObjectCounts& objects,
                      const DensityPlan& medium) {
    return moves(scene) ? FollowingWalk(scene, meshes, objects, medium).run() : 0;
}

}  // namespace voxelume
