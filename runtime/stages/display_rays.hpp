// lit sight rays -> P in the layout `rays`, voxel by voxel along each ray.
#pragma once

#include "runtime/opencl/program.hpp"
#include "runtime/stages/display_frame.hpp"
#include "runtime/stages/features.hpp"
#include "runtime/stages/ray_batch.hpp"
#include "runtime/stages/scatter.hpp"

namespace voxelume {

/// The voxels of P on a device: arrays as long as each other, ascending in `places`. 32 bytes each.
struct VoxelArrays {
    size_t count = 0;  ///< the arrays may be longer
    Buffer<uint64_t> places;
    Buffer<float> colors;  ///< 3 each, one after another
    Buffer<float> opacities;
    Buffer<float> depths;
    Buffer<uint32_t> objects;
};

/// Arrays for `count` voxels. Throws Error::limit for more than can be numbered.
VoxelArrays allocate_voxels(const Device& device, uint64_t count);

/// Reads the voxels into a volume. Waits for the device.
void read_voxels(const VoxelArrays& voxels, Volume& volume);

/// The records of a layer of surfaces along sight rays: VXL_LAYER_WORDS words, `count` apart.
struct LayerRecords {
    size_t count = 0;
    std::vector<uint32_t> words;
};

/// Kernels of display_rays.cl, and what they keep of each sight ray. The paper's blocks 2 and 3.
class DisplayRaysStage {
  public:
    /// `sight` casts the frame's rays: as wide and high as it, one sample each.
    DisplayRaysStage(const Device& device, const Features& features, const Sight& sight,
                     const VolumeFrame& frame, const Medium& medium, const Space& space);

    /// Keeps lit rays 0 .. count-1 of the batch, which begin at ray `first_ray` of the display.
    void keep(const PyramidShape& world, const RayBatch& batch, uint32_t first_ray, uint32_t count);

    /// The same in a scene with `transmission`, where light comes from several surfaces along a
    /// ray: keeps a layer of a batch that begins at ray `first_ray`. The first layer comes first.
    void keep_layer(const PyramidShape& world, const RayBatch& entries, uint32_t count,
                    bool is_first, const NodeLight& nodes, uint32_t first_ray);

    /// Puts the voxels of all rays into the volume, once every ray is kept.
    void read(Volume& volume);

  private:
    VoxelArrays voxels();

    Device device_;
    bool transmission_;
    Sight sight_;
    DisplaySteps steps_;
    float near_depth_;
    Space space_;
    uint32_t total_;  ///< places for rays
    Buffer<uint32_t> hit_steps_, objects_;
    Buffer<float> depths_, colors_;
    Buffer<float> spans_;  ///< only in a world with a medium
    Buffer<float> seen_;   ///< of the batch's nodes before a layer: light, coverage
    std::vector<LayerRecords> layers_;
    Program program_;
    Kernel measure_, layer_, count_, place_, fill_;
};

}  // namespace voxelume
