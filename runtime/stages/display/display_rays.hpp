// SPDX-License-Identifier: Apache-2.0
// lit sight rays -> P in the layout `rays`, voxel by voxel along each ray.
#pragma once

#include <optional>

#include "runtime/opencl/program.hpp"
#include "runtime/stages/display/display_frame.hpp"
#include "runtime/stages/features.hpp"
#include "runtime/stages/medium/space_medium.hpp"
#include "runtime/stages/ray_batch.hpp"
#include "runtime/stages/trace/scatter.hpp"

namespace voxelume {

/// The voxels of P on a device: arrays of equal length, ascending in `indices`. A voxel takes 32
/// bytes.
struct VoxelArrays {
    size_t count = 0;  ///< the arrays may be longer
    Buffer<uint64_t> indices;
    Buffer<float> colors;  ///< 3 for each voxel, one after another
    Buffer<float> opacities;
    Buffer<float> depths;
    Buffer<uint32_t> objects;
};

/// VXL_VOXEL_PARAMETERS of kernels.
void bind(KernelArguments& to, const VoxelArrays& voxels);

/// The arrays for `count` voxels. Throws Error::limit for more voxels than can be numbered.
VoxelArrays allocate_voxels(const Device& device, uint64_t count);

/// Reads the voxels into a volume. Waits for the device.
void read_voxels(const VoxelArrays& voxels, Volume& volume);

/// The records of a layer of surfaces along sight rays: VXL_LAYER_WORDS words, each `count` apart.
struct LayerRecords {
    size_t count = 0;
    std::vector<uint32_t> words;
    /// The density times metres of entry n in step k, at `first_amount[n] + k - first_step[n]`;
    /// empty in a medium of density 1. The amounts of entry n end where those of n+1 begin.
    std::vector<float> amounts;
    /// The light that the medium adds in these steps if nothing covers them; only where its colour
    /// varies.
    std::vector<glm::vec3> lights;
    std::vector<size_t> first_amount;
    std::vector<uint32_t> first_step;
};

/// The data of each sight ray for its voxels; an array has `total` slots of one or more components.
struct RayDepths {
    Buffer<uint32_t> steps;    ///< step of the surface met, VXL_NO_STEP for none
    Buffer<float> depths;      ///< depth of the surface, metres
    Buffer<uint32_t> objects;  ///< object number plus 1, 0 for none
    Buffer<float> colors;      ///< 3: the light along the ray
    Buffer<float> spans;       ///< VXL_SPAN_COMPONENTS; only in a world with a medium
    uint32_t total = 0;        ///< slots for rays
};

RayDepths allocate_ray_depths(const Device& device, const Features& features, uint32_t total);

/// VXL_DEPTHS_PARAMETERS of kernels.
void bind(KernelArguments& to, const RayDepths& depths);

/// The number of tiles of 4 x 4 rays that make a batch, up to `tiles`. Those of rays that go
/// through surfaces in global light are limited, since main memory holds the light of each ray in
/// each layer.
uint32_t display_batch_tiles(const Device& device, const Features& features, uint32_t tiles);

/// Kernels of display_rays.cl or, for layers, display_layers.cl, and the data that they store for
/// each sight ray. The paper's blocks 2 and 3.
class DisplayRaysStage {
  public:
    /// `camera` casts the frame's rays. It has the frame's width and height and one sample per
    /// pixel.
    DisplayRaysStage(const Device& device, const Features& features, const Camera& camera,
                     const VolumeFrame& frame, const Medium& medium,
                     const Environment& environment);

    /// Stores rays 0 .. count-1 of the batch, which are lit; the batch begins at ray `first_ray` of
    /// the display.
    void keep(const PyramidShape& world, const RayBatch& batch, uint32_t first_ray, uint32_t count);

    /// A layer of surfaces, the nearest first: entries of a batch that begins at ray `first_ray`,
    /// and the light of their rays.
    struct Layer {
        const RayBatch& entries;
        uint32_t count;
        bool is_first;
        const NodeLight& nodes;
        uint32_t first_ray;
    };
    /// Stores a layer. It is called instead of `keep` if light comes from several surfaces along a
    /// ray (`transmission`), or through a medium whose density varies (`medium_grid`).
    void keep_layer(const Pyramid& world, const DensityGrid* density, const Layer& layer);
    bool has_layers() const { return has_layers_; }

    /// Writes the voxels of all rays to the volume, after every ray was stored.
    void read(Volume& volume);

  private:
    VoxelArrays voxels();

    Device device_;
    void measure_density(const Pyramid& world, const DensityGrid& density, const Layer& layer,
                         LayerRecords& records);

    bool has_layers_;
    bool adds_layers_;  ///< nodes hold the sum of all layers so far
    bool medium_colors_;
    Camera camera_;
    DisplaySteps steps_;
    float near_depth_;
    Environment environment_;
    RayDepths rays_;
    Buffer<float> seen_;  ///< light and coverage of the batch's nodes before a layer
    std::vector<LayerRecords> layers_;
    Program program_;
    std::optional<Kernel> measure_, count_, place_, fill_;  ///< without layers
    std::optional<Kernel> layer_, density_;                 ///< with layers
};

}  // namespace voxelume
