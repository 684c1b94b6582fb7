// SPDX-License-Identifier: Apache-2.0
#include "runtime/memory/frame_memory.hpp"

#include <algorithm>
#include <optional>

#include "runtime/analysis/scene_features.hpp"
#include "runtime/grid/pyramid_bytes.hpp"
#include "runtime/grid/world_frame.hpp"
#include "runtime/memory/count/count_display.hpp"
#include "runtime/memory/count/count_image.hpp"
#include "runtime/memory/count/count_sources.hpp"
#include "runtime/scene/first_samples.hpp"
#include "runtime/stages/trace/ray_arrays.hpp"
#include "runtime/stages/trace/sight.hpp"

namespace voxelume {
namespace {

class FrameWalk {
  public:
    FrameWalk(const Scene& scene, AssetStore& meshes, ObjectCounts& objects,
              const DensityPlan& medium, Estimate estimate, const DeviceInfo& device)
        : device_(counting_like(device)),
          scene_(scene),
          meshes_(meshes),
          objects_(objects),
          medium_(medium),
          estimate_(estimate),
          grids_(device_, scene, meshes, objects, estimate) {}

    FrameMemory run() {
        Pyramid world = form();
        world.object_boxes = objects_.boxes();
        world.clear = medium_.is_zero;
        memory_.pyramid = double(bytes_of(world));
        show(world);
        return std::move(memory_);
    }

  private:
    /// Follows WorldBuilder::form.
    Pyramid form() {
        const CountedInstances instances = grids_.instances();
        SourceMeshes sources = count_sources(device_, scene_, meshes_);
        const CountedPyramid placed = form_placed();
        std::vector<ModelPyramid> kept;
        Pyramid joined =
            count_joining(device_, instances.listed, placed.pyramid, instances.models, kept);
        joined.sources = std::move(sources);
        joined.cube_steps = count_cube_steps(device_, scene_, meshes_, objects_.boxes());
        joined.order = count_order(device_, scene_);
        memory_.index = height();
        memory_.largest_buffer = device_.counters().largest_buffer;
        memory_.largest_bytes = double(device_.counters().largest_bytes);
        return joined;
    }

    /// The world without instances.
    CountedPyramid form_placed() {
        const std::vector<PlacedObject> objects = grids_.placed();
        memory_.voxelize = height();
        memory_.world = objects_.world(estimate_);
        device_.counters().largest_bytes = 0;
        CountedWorld world =
            count_placing(device_, objects, world_frame(scene_.world), memory_.world);
        world.painters.clear();
        memory_.place = height();
        memory_.grids = grids_.all();
        for (CountedGrid& grid : memory_.grids) grid.grid.reset();
        grids_.forget_if([](const CountedGrid&) { return true; });
        return count_index(device_, world, memory_.world);
    }

    /// Follows Renderer::image.
    void show(const Pyramid& world) {
        const size_t depth = estimate_ == Estimate::minimum ? 1 : SIZE_MAX;
        height();
        memory_.volume_voxels = count_volume(device_, scene_, world, medium_, estimate_);
        memory_.volume = height();
        const Features features = features_of(scene_, world);
        // Only building the world tells whether parts of solids share voxels.
        if (estimate_ == Estimate::expected &&
            std::ranges::none_of(memory_.grids, [](auto& grid) { return grid.counts.parts > 1; }))
            memory_.foreseen = foreseen_image(scene_, world);
        const ImageMemory image = count_image(device_, scene_, world, medium_, depth);
        std::optional<Buffer<uint8_t>> hits;
        if (const double bytes = retained_hits(features); bytes > 0)
            hits.emplace(device_, "hits", size_t(bytes));
        memory_.image = height();
        memory_.light_host_bytes =
            image.emitter_host_bytes + image.sky_host_bytes + image.light_tree_host_bytes;
        memory_.dilated_occupancy = double(
            (image.dilated_occupancy.sectors.size() + image.dilated_occupancy.bricks.size()) * 4);
        memory_.rays = ray_bytes(features, ray_counts(device_, scene_, features));
    }

    /// The bytes of retained hits, from which passes of the light are rendered.
    double retained_hits(const Features& features) const {
        const RenderSettings render = retained_settings(scene_);
        if (estimate_ == Estimate::minimum || !render.channels.has_passes() ||
            render.noise.is_given() || render.all_samples > 0)
            return 0;
        const double rays = 16.0 * tile_count(render.size.x, render.size.y) * render.samples;
        const double bytes = rays * sight_bytes(features);
        return bytes <= kMaxPassHitBytes ? bytes : 0;
    }

    /// The maximum bytes in use since the last call.
    double height() {
        DeviceCounters& counters = device_.counters();
        const auto bytes = double(counters.peak_bytes);
        counters.peak_bytes = counters.bytes_in_use;
        return bytes;
    }

    const Device device_;
    const Scene& scene_;
    AssetStore& meshes_;
    ObjectCounts& objects_;
    const DensityPlan& medium_;
    Estimate estimate_;
    CountedGrids grids_;
    FrameMemory memory_;
};

}  // namespace

Device counting_like(const DeviceInfo& device) {
    DeviceInfo counted;
    counted.batch_rays = device.batch_rays;
    return Device::counting(counted);
}

double FrameMemory::built() const {
    return std::max({voxelize, place, index});
}

FrameMemory walk_frame(const Scene& scene, AssetStore& meshes, ObjectCounts& objects,
                       const DensityPlan& medium, Estimate estimate, const DeviceInfo& device) {
    return FrameWalk(scene, meshes, objects, medium, estimate, device).run();
}

}  // namespace voxelume
