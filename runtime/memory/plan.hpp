// SPDX-License-Identifier: Apache-2.0
// scene -> the memory for rendering it: the grids of every step, before any memory is taken.
//
// The numbers of voxels are estimates from surfaces (runtime/geometry/surface_extent.hpp and
// brick_count.hpp). Bytes follow exactly from them: the functions that allocate the stages' buffers
// run on a device that only counts.
#pragma once

#include <string>
#include <vector>

#include "runtime/analysis/image_programs.hpp"
#include "runtime/assets/asset_store.hpp"
#include "runtime/memory/count/plan_grid.hpp"
#include "runtime/opencl/device.hpp"
#include "runtime/stages/medium/density_grid.hpp"
#include "runtime/stages/trace/ray_arrays.hpp"

namespace voxelume {

class SolidExtents;
struct ScenePlan;

/// The main memory that the program, an OpenCL driver and its compiler take in addition to
/// everything that is counted: PoCL 3.1 with LLVM 15, compiling the kernels of a scene of all
/// features, takes 0.28 GB.
inline constexpr double kDriverBytes = 3e8;

/// The bytes of main memory of the process until files are written, where its device takes
/// `device_bytes`: a CPU's are main memory, too.
double rendering_bytes(const ScenePlan& plan, double device_bytes, const DeviceInfo& device);

struct ScenePlan {
    std::vector<GridPlan> grids;
    GridFrame world;
    double voxels = 0;  ///< surface voxels of the world
    double bricks = 0;

    // The maximum bytes of the device during each stage.
    double voxelize_bytes = 0;
    double place_bytes = 0;
    double index_bytes = 0;
    double image_bytes = 0;
    double volume_bytes = 0;  ///< for the display's volumetric image, instead of image_bytes
    double shown_bytes = 0;   ///< the larger of the wanted ones of these two

    double world_bytes = 0;  ///< bytes of the pyramid, part of image_bytes and volume_bytes
    double dilated_occupancy_bytes =
        0;  ///< of the grid that beams of rays are sent through, part of image_bytes
    ForeseenImage foreseen;  ///< the expected kernels of the image
    RayBytes rays;           ///< their maximum is part of image_bytes
    DensityPlan medium;      ///< part of image_bytes
    double host_bytes = 0;   ///< tables, meshes, emissive objects and the image in main memory

    /// The minimum for all stages that run, and for the world's buffers except its tables and
    /// medium: the bytes of objects that can't lie in each other's bricks. A frame is refused
    /// before it is tried only if this count exceeds the device's memory.
    double min_bytes = 0;
    double min_image_bytes = 0;   ///< minimum of image_bytes
    double min_volume_bytes = 0;  ///< minimum of volume_bytes
    double min_with_next = 0;     ///< minimum of bytes_with_next
    BufferPlan largest;

    double peak_bytes() const;

    /// The maximum while a frame is rendered and the next one's world is built, with all that is
    /// kept of both; 0 for a scene that stands still.
    double following_bytes = 0;
    /// The bytes that a run of `frames` frames takes of a device with `memory` bytes: retained
    /// buffers are freed if they don't fit.
    double run_bytes(size_t frames, double memory) const;
    /// The bytes if grids, bricks and the pyramid stay while the next world is built.
    double bytes_with_next() const { return place_bytes + index_bytes + shown_bytes; }
};

/// Plans the voxelization of one mesh. Throws as model_frame does.
GridPlan plan_model(const Model& model, const Mesh& mesh);

/// Throws Error::limit, opened by the model's place, when a plan for it doesn't fit.
void check_model(const Model& model, const GridPlan& plan, const DeviceInfo& device);

/// Plans a scene on a device; reads the meshes that the world shows, unless the store knows enough
/// of them.
///
/// Throws as AssetStore, model_frame and materials_of_groups do, and Error::limit for a lattice
/// with more bricks than can be numbered.
///
/// `solids` keep what frames with the same solids share.
ScenePlan plan_scene(const Scene& scene, AssetStore& meshes, const DeviceInfo& device,
                     SolidExtents& solids);
ScenePlan plan_scene(const Scene& scene, AssetStore& meshes, const DeviceInfo& device = {});

/// Refuses lattices whose tables can't be numbered, or are larger than the device's memory, before
/// any mesh is read. Throws Error::limit.
void check_tables(const Scene& scene, const DeviceInfo& device);

/// Throws Error::limit, saying what is too large and what to do, when a plan doesn't fit.
void check_memory(const Scene& scene, const ScenePlan& plan, const DeviceInfo& device);

/// The bytes of a pixel in the largest buffer of an image.
double pixel_bytes(const ImageChannels& channels);

/// The bytes of an image on a device.
double image_bytes(const RenderSettings& render);

/// "400x360x320"
std::string size_text(const glm::ivec3& size);

/// "1.5 GB", three digits at most.
std::string bytes_text(double bytes);

}  // namespace voxelume
