// SPDX-License-Identifier: Apache-2.0
// scene -> what rendering it takes: the grids of every step and their memory, before any is taken.
//
// An estimate: surfaces are counted by runtime/geometry/surface_extent.hpp, bytes by what the
// stages store for each brick, voxel, triangle, ray and pixel (listed in plan_grid.hpp,
// plan_stages.cpp and ray_arrays.cpp).
#pragma once

#include <string>
#include <vector>

#include "runtime/assets/asset_store.hpp"
#include "runtime/memory/plan_grid.hpp"
#include "runtime/opencl/device.hpp"
#include "runtime/stages/medium/density_grid.hpp"
#include "runtime/stages/trace/ray_arrays.hpp"

namespace voxelume {

struct ScenePlan {
    std::vector<GridPlan> grids;
    GridFrame world;
    double voxels = 0;  ///< surface voxels of the world
    double bricks = 0;

    // device memory at the height of each stage
    double voxelize_bytes = 0;
    double place_bytes = 0;
    double index_bytes = 0;
    double image_bytes = 0;
    double volume_bytes = 0;  ///< instead of the last: of the display's volumetric image

    double world_bytes = 0;  ///< the pyramid's, part of the last two
    double dilated_occupancy_bytes =
        0;                  ///< of the grid that beams of rays are sent through, part of the last
    RayBytes rays;          ///< of which the most are part of the last
    DensityPlan medium;     ///< part of the last one
    double host_bytes = 0;  ///< tables, meshes and the image in main memory

    /// At the height of all stages, and of the world's buffers but those of its tables and medium,
    /// at least: what objects take that can't lie in each other's bricks. No more than that is
    /// refused before it is tried.
    double min_bytes = 0;
    double min_image_bytes = 0;  ///< of the last one, the same way
    double min_with_next = 0;    ///< of bytes_with_next, the same way
    BufferPlan largest;

    double peak_bytes() const;

    /// While the next frame's world is built beside a frame that is rendered and all that is kept
    /// of both; 0 for a scene that stands still.
    double following_bytes = 0;
    /// What a run of so many frames takes of a device of such a memory: what is kept between frames
    /// is given up where it has no room.
    double run_bytes(size_t frames, double memory) const;
    /// Where grids, bricks and the pyramid stay while the next world is formed beside them.
    double bytes_with_next() const { return place_bytes + index_bytes + image_bytes; }
};

/// Plans the voxelization of one mesh. Throws as model_frame does.
GridPlan plan_model(const Model& model, const Mesh& mesh);

/// Throws Error::limit, opened by the model's place, when a plan for it doesn't fit.
void check_model(const Model& model, const GridPlan& plan, const DeviceInfo& device);

/// Plans a scene; reads the meshes that the world shows, unless the store knows enough of them.
///
/// Throws as AssetStore, model_frame and materials_of_groups do, and Error::limit for a lattice
/// with more bricks than can be numbered.
ScenePlan plan_scene(const Scene& scene, AssetStore& meshes);

/// Refuses lattices whose tables can't be numbered, or are larger than the device's memory, before
/// any mesh is read. Throws Error::limit.
void check_tables(const Scene& scene, const DeviceInfo& device);

/// Throws Error::limit, saying what is too large and what to do, when a plan doesn't fit.
void check_memory(const Scene& scene, const ScenePlan& plan, const DeviceInfo& device);

/// Bytes for each pixel in the largest buffer of an image.
double pixel_bytes(const ImageChannels& channels);

/// Bytes of the device for an image.
double image_bytes(const RenderSettings& render);

/// "400x360x320"
std::string size_text(const glm::ivec3& size);

/// "1.5 GB", three digits at most.
std::string bytes_text(double bytes);

}  // namespace voxelume
