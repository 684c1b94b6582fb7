// lit sight rays -> P in the layout `rays`, voxel by voxel along each ray.
#pragma once

#include "runtime/opencl/program.hpp"
#include "runtime/stages/display/display_frame.hpp"
#include "runtime/stages/features.hpp"
#include "runtime/stages/medium/density_grid.hpp"
#include "runtime/stages/ray_batch.hpp"
#include "runtime/stages/trace/scatter.hpp"

namespace voxelume {

/// The voxels of P on a device: arrays as long as each other, ascending in `indices`. 32 bytes
/// each.
struct VoxelArrays {
    size_t count = 0;  ///< the arrays may be longer
    Buffer<uint64_t> indices;
    Buffer<float> colors;  ///< 3 each, one after another
    Buffer<float> opacities;
    Buffer<float> depths;
    Buffer<uint32_t> objects;
};

/// Arrays for `count` voxels. Throws Error::limit for more than can be numbered.
VoxelArrays allocate_voxels(const Device& device, uint64_t count);

/// Reads the voxels into a volume. Waits for the device.
void read_voxels(const VoxelArrays& voxels, Volume& volume);

/// What is kept of each sight ray.
struct DisplayRayArrays {
    Buffer<uint32_t> hit_steps, objects;
    Buffer<float> depths, colors;
    Buffer<float> spans;  ///< only in a world with a medium
};
DisplayRayArrays allocate_display_rays(const Device& device, uint32_t rays, bool has_medium);

/// The records of a layer of surfaces along sight rays: VXL_LAYER_WORDS words, `count` apart.
struct LayerRecords {
    size_t count = 0;
    std::vector<uint32_t> words;
    /// Density times metres of entry n in step k, at `first_amount[n] + k - first_step[n]`; empty
    /// in a medium of density 1. Entry n's end where those of n+1 begin.
    std::vector<float> amounts;
    std::vector<size_t> first_amount;
    std::vector<uint32_t> first_step;
};

/// Kernels of display_rays.cl, and what they keep of each sight ray. The paper's blocks 2 and 3.
class DisplayRaysStage {
  public:
    /// `camera` casts the frame's rays: as wide and high as it, one sample each.
    DisplayRaysStage(const Device& device, const Features& features, const Camera& camera,
                     const VolumeFrame& frame, const Medium& medium,
                     const Environment& environment);

    /// Keeps lit rays 0 .. count-1 of the batch, which begin at ray `first_ray` of the display.
    void keep(const PyramidShape& world, const RayBatch& batch, uint32_t first_ray, uint32_t count);

    /// A layer of surfaces, the nearest first: which entries of a batch that begins at ray
    /// `first_ray`, and where the light of their rays is.
    struct Layer {
        const RayBatch& entries;
        uint32_t count;
        bool is_first;
        const NodeLight& nodes;
        uint32_t first_ray;
    };
    /// Instead of `keep` where light comes from several surfaces along a ray (`transmission`), or a
    /// medium that differs from voxel to voxel (`medium_grid`).
    void keep_layer(const Pyramid& world, const DensityGrid* density, const Layer& layer);
    bool has_layers() const { return has_layers_; }

    /// Puts the voxels of all rays into the volume, once every ray is kept.
    void read(Volume& volume);

  private:
    VoxelArrays voxels();

    Device device_;
    void measure_density(const Pyramid& world, const DensityGrid& density, const Layer& layer,
                         LayerRecords& records);

    bool has_layers_, transmission_;
    Camera camera_;
    DisplaySteps steps_;
    float near_depth_;
    Environment environment_;
    uint32_t total_;  ///< places for rays
    DisplayRayArrays rays_;
    Buffer<float> seen_;  ///< of the batch's nodes before a layer: light, coverage
    std::vector<LayerRecords> layers_;
    Program program_;
    Kernel measure_, layer_, density_, count_, place_, fill_;
};

}  // namespace voxelume
