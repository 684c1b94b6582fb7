// SPDX-License-Identifier: Apache-2.0
#include "runtime/memory/following_memory.hpp"

#include <algorithm>
#include <utility>

#include "runtime/analysis/scene_features.hpp"
#include "runtime/grid/world_frame.hpp"
#include "runtime/memory/count/count_display.hpp"
#include "runtime/memory/count/count_image.hpp"
#include "runtime/memory/count/count_sources.hpp"
#include "runtime/memory/counted_grids.hpp"
#include "runtime/memory/frame_memory.hpp"
#include "runtime/memory/plan.hpp"
#include "runtime/scene/first_samples.hpp"
#include "runtime/scene/predicates.hpp"
#include "runtime/scene/scene_animation.hpp"
#include "runtime/scene/scene_motion.hpp"
#include "runtime/stages/trace/sight.hpp"

namespace voxelume {
namespace {

/// The models and objects that the scene's tracks change.
struct Changes {
    std::vector<bool> models;   ///< for each model: true if its grids change
    std::vector<bool> objects;  ///< for each object in the world's voxels: true if it changes

    bool are_of(const CountedGrid& grid) const {
        return grid.object < 0 ? models[size_t(grid.model)] : objects[size_t(grid.object)];
    }
};

Changes changes_of(const Scene& scene) {
    Changes changes{std::vector<bool>(scene.models.size()),
                    std::vector<bool>(scene.objects.size())};
    for (const MovingPart& part : scene.motion->parts) {
        if (part.part == ScenePart::object) changes.objects[part.index] = true;
        if (part.part == ScenePart::model) changes.models[part.index] = true;
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
                  const DensityPlan& medium, const DeviceInfo& device)
        : device_(counting_like(device)),
          scene_(scene),
          meshes_(meshes),
          objects_(objects),
          medium_(medium),
          changes_(changes_of(scene)),
          grids_(device_, scene, meshes, objects, Estimate::expected) {}

    double run() {
        const CountedInstances instances = grids_.instances();
        SourceMeshes sources = count_sources(device_, scene_, meshes_);
        const std::vector<PlacedObject> placed = grids_.placed();
        const WorldCounts counts = objects_.world(Estimate::expected);
        const GridFrame frame = world_frame(scene_.world);
        CountedWorld world = count_placing(device_, placed, frame, counts);
        CountedPyramid indexed = count_index(device_, world, counts);
        std::vector<ModelPyramid> kept;
        Pyramid joined =
            count_joining(device_, instances.listed, indexed.pyramid, instances.models, kept);
        joined.sources = std::move(sources);
        joined.cube_steps = count_cube_steps(device_, scene_, meshes_, objects_.boxes());
        joined.order = count_order(device_, scene_);
        joined.object_boxes = objects_.boxes();
        joined.clear = medium_.is_zero;
        const uint64_t before = bytes_in_use(), volume = volume_height(joined);
        ImageMemory image;
        Buffer<uint8_t> hits;
        if (scene_.render.shows_image) {
            image = count_image(device_, scene_, joined, medium_, SIZE_MAX);
            hits = {device_, "hits", hit_bytes(joined)};
        }
        // Before the volumetric image is made, the image's arrays are freed except those that are
        // retained.
        Buffer<uint8_t> rest;
        const uint64_t there = bytes_in_use() - before - hits.size();
        const uint64_t freed = there - std::min(there, retained_bytes(image));
        if (volume > freed) rest = {device_, "volumetric image", size_t(volume - freed)};
        build_next(placed, world, indexed, instances.listed);
        return double(device_.counters().peak_bytes);
    }

  private:
    uint64_t bytes_in_use() const { return device_.counters().bytes_in_use; }

    /// The bytes that stay of an image besides its hits: its pixels and what its renderer retains.
    uint64_t retained_bytes(const ImageMemory& image) const {
        uint64_t words =
            image.dilated_occupancy.sectors.size() + image.dilated_occupancy.bricks.size();
        for (const Buffer<float>& beams : image.light_beams) words += beams.size();
        return 4 * words + uint64_t(image_bytes(scene_.render));
    }

    /// The maximum bytes that the volumetric image adds to the world's, if one is wanted.
    uint64_t volume_height(const Pyramid& world) const {
        if (!scene_.render.shows_volume) return 0;
        DeviceCounters& counters = device_.counters();
        const uint64_t before = std::exchange(counters.peak_bytes, counters.bytes_in_use);
        count_volume(device_, scene_, world, medium_, Estimate::expected);
        const uint64_t height = std::exchange(counters.peak_bytes, before);
        counters.peak_bytes = std::max(height, before);
        return height - counters.bytes_in_use;
    }

    /// Counts the additional memory of the next frame's world. It may be built while this frame's
    /// image is made, so both are counted together.
    void build_next(std::span<const PlacedObject> placed, CountedWorld& world,
                    CountedPyramid& indexed, const ListedInstances& listed) {
        const WorldCounts counts = objects_.world(Estimate::expected);
        const auto is_changed = [this](const CountedGrid& grid) { return changes_.are_of(grid); };
        const std::vector<BrickGrid> made = grids_.make_again(is_changed);
        PartBricks bricks = objects_.changed_bricks(changes_.objects);
        if (bricks.of_fields + bricks.of_others == 0) return;
        // An object that moves changes the bricks that it leaves and those that it comes to.
        bricks.of_others = std::min(2 * bricks.of_others, double(counts.bricks));
        if (bricks.of_others > 0) count_growth(device_, world.grid);
        const BrickGrid sources = count_repainting(device_, placed, world, bricks);
        grids_.forget_if(is_changed);
        indexed.pyramid = {};  // the image shows a copy with the instances
        const Pyramid next = count_reindexing(device_, world, counts, indexed.masks);
        std::vector<ModelPyramid> kept;
        if (!listed.list.empty()) count_joining(device_, {{}, listed.list, {}}, next, {}, kept);
    }

    size_t hit_bytes(const Pyramid& world) const {
        const Features features = features_of(scene_, world);
        const RenderSettings render = retained_settings(scene_);
        if (render.all_samples > 0) return 0;  // another moment's hits replace these
        const double rays = 16.0 * tile_count(render.size.x, render.size.y) * render.samples;
        return size_t(rays * sight_bytes(features));
    }

    const Device device_;
    const Scene& scene_;
    AssetStore& meshes_;
    ObjectCounts& objects_;
    const DensityPlan& medium_;
    Changes changes_;
    CountedGrids grids_;
};

}  // namespace

double walk_following(const Scene& scene, AssetStore& meshes, ObjectCounts& objects,
                      const DensityPlan& medium, const DeviceInfo& device) {
    return moves(scene) ? FollowingWalk(scene, meshes, objects, medium, device).run() : 0;
}

}  // namespace voxelume
