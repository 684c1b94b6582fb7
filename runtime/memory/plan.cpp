// SPDX-License-Identifier: Apache-2.0
#include "runtime/memory/plan.hpp"

#include <algorithm>

#include "kernels/shared/matte.h"
#include "runtime/assets/model_frame.hpp"
#include "runtime/grid/world_frame.hpp"
#include "runtime/memory/following_memory.hpp"
#include "runtime/memory/frame_memory.hpp"
#include "runtime/scene/predicates.hpp"
#include "runtime/scene/rendered_channels.hpp"

namespace voxelume {
namespace {

// Bytes of main memory for a brick of the world's lattice (slots and states), for a brick of a
// model's lattice while its grid is made, and for a triangle.
constexpr double kWorldTable = 5, kModelTable = 12, kTriangleBytes = 36;

/// Bytes of main memory for a voxel that a volumetric image lists.
constexpr double kVolumeVoxelBytes = 33;

/// Small buffers, and voxels that estimates miss where all else is counted exactly: at most 1.4 %
/// in the scenes of scenes/ (glass_bunny).
constexpr double kUncounted = 1.02;

/// The plan of a grid from its expected and minimum counts; the largest buffer is that of the
/// minimum.
GridPlan grid_plan(const CountedGrid& expected, const CountedGrid& minimum) {
    GridPlan grid{.model = expected.model,
                  .object = expected.object,
                  .frame = expected.counts.frame,
                  .triangles = expected.counts.triangles,
                  .voxels = double(expected.counts.voxels),
                  .bricks = double(expected.counts.bricks),
                  .made_bytes = expected.made_bytes,
                  .kept_bytes = expected.kept_bytes};
    grid.minimum = {double(minimum.counts.voxels), minimum.made_bytes, minimum.kept_bytes};
    grid.largest = described_buffer(minimum.largest_buffer, minimum.largest_bytes);
    return grid;
}

/// Refuses names of groups that don't exist, before any frame is rendered.
void check_groups(const Scene& scene, AssetStore& meshes) {
    for (const Object& object : scene.objects)
        if (may_be_shown(scene, object))
            materials_of_groups(object, meshes.groups_of(scene.models[size_t(object.model)]));
}

/// The bytes of main memory. An image and a volumetric image are there twice while they are
/// written.
double host_bytes(const Scene& scene, const ScenePlan& plan, const FrameMemory& memory) {
    double bytes =
        kWorldTable * brick_table(plan.world) + plan.medium.host_bytes + memory.light_host_bytes;
    if (scene.render.shows_image) bytes += 2 * image_bytes(scene.render);
    if (scene.render.shows_volume) bytes += 2 * kVolumeVoxelBytes * memory.volume_voxels;
    for (const GridPlan& grid : plan.grids)
        bytes += double(grid.triangles) * kTriangleBytes + kModelTable * brick_table(grid.frame);
    return bytes;
}

/// The larger of an image and a volumetric image, of those that are wanted.
double shown_of(const RenderSettings& render, double image, double volume) {
    return std::max(render.shows_image ? image : 0, render.shows_volume ? volume : 0);
}

}  // namespace

double pixel_bytes(const ImageChannels& channels) {
    return 4.0 * (4 * int(channels.color) + 3 * int(channels.variance) + int(channels.depth) +
                  int(channels.distance) + 3 * int(channels.position) + 3 * int(channels.normal));
}

double image_bytes(const RenderSettings& render) {
    const double pixels = double(render.size.x) * double(render.size.y);
    const ImageChannels channels = rendered_channels(render);
    const int ids = int(channels.object) + int(channels.material);
    const int mattes = int(channels.object_matte) + int(channels.material_matte);
    return (pixel_bytes(channels) + 4.0 * ids + 8.0 * VXL_MATTE_RANKS * mattes) * pixels;
}

double ScenePlan::run_bytes(size_t frames, double memory) const {
    const double both = std::max(peak_bytes(), following_bytes);
    return frames > 1 && both <= memory ? both : peak_bytes();
}

double ScenePlan::peak_bytes() const {
    return std::max({voxelize_bytes, place_bytes, index_bytes, shown_bytes});
}

double rendering_bytes(const ScenePlan& plan, double device_bytes, const DeviceInfo& device) {
    return kDriverBytes + plan.host_bytes + (device.kind == DeviceKind::cpu ? device_bytes : 0.0);
}

GridPlan plan_model(const Model& model, const Mesh& mesh) {
    const MeshSummary summary = summary_of(mesh);
    const GridFrame frame = model_frame(model, &summary);
    const Device device = Device::counting({});
    const auto counted = [&](const SurfaceArea& area) {
        return count_mesh(device, mesh_grid(model, summary, frame, area));
    };
    return grid_plan(counted(summary.area), counted(summary.min_area));
}

ScenePlan plan_scene(const Scene& scene, AssetStore& meshes, const DeviceInfo& device) {
    SolidExtents solids;
    return plan_scene(scene, meshes, device, solids);
}

ScenePlan plan_scene(const Scene& scene, AssetStore& meshes, const DeviceInfo& device,
                     SolidExtents& solids) {
    check_groups(scene, meshes);
    ScenePlan plan;
    plan.world = world_frame(scene.world);
    plan.medium = plan_density(scene.world, has_scattering(scene));
    ObjectCounts objects(scene, meshes, solids);
    const FrameMemory expected =
        walk_frame(scene, meshes, objects, plan.medium, Estimate::expected, device);
    const FrameMemory minimum =
        walk_frame(scene, meshes, objects, plan.medium, Estimate::minimum, device);
    for (size_t i = 0; i < expected.grids.size(); ++i)
        plan.grids.push_back(grid_plan(expected.grids[i], minimum.grids[i]));
    plan.voxels = double(expected.world.voxels);
    plan.bricks = double(expected.world.bricks);
    plan.voxelize_bytes = kUncounted * expected.voxelize;
    plan.place_bytes = kUncounted * expected.place;
    plan.index_bytes = kUncounted * expected.index;
    plan.image_bytes = kUncounted * expected.image;
    plan.volume_bytes = kUncounted * expected.volume;
    plan.shown_bytes = shown_of(scene.render, plan.image_bytes, plan.volume_bytes);
    plan.world_bytes = expected.pyramid;
    plan.dilated_occupancy_bytes = expected.dilated_occupancy;
    plan.rays = expected.rays;
    plan.foreseen = expected.foreseen;
    plan.min_image_bytes = minimum.image;
    plan.min_volume_bytes = minimum.volume;
    const double min_shown = shown_of(scene.render, minimum.image, minimum.volume);
    plan.min_bytes = std::min(std::max(minimum.built(), min_shown), plan.peak_bytes());
    plan.min_with_next = minimum.place + minimum.index + min_shown;
    plan.following_bytes = kUncounted * walk_following(scene, meshes, objects, plan.medium, device);
    plan.largest = described_buffer(minimum.largest_buffer, minimum.largest_bytes);
    plan.host_bytes = host_bytes(scene, plan, expected);
    return plan;
}

}  // namespace voxelume
