// lit sight rays -> P in the layout `rays`, voxel by voxel along each ray.
#pragma once

#include "runtime/opencl/program.hpp"
#include "runtime/stages/display_frame.hpp"
#include "runtime/stages/features.hpp"
#include "runtime/stages/ray_batch.hpp"

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

/// Kernels of display_rays.cl, and what they keep of each sight ray. The paper's blocks 2 and 3.
class DisplayRaysStage {
  public:
    /// `sight` casts the frame's rays: as wide and high as it, one sample each.
    DisplayRaysStage(const Device& device, const Features& features, const Sight& sight,
                     const VolumeFrame& frame, const Medium& medium, const Space& space);

    /// Keeps lit rays 0 .. count-1 of the batch, which begin at ray `first_ray` of the display.
    void keep(const PyramidShape& world, const RayBatch& batch, uint32_t first_ray, uint32_t count);

    /// The voxels of all rays, once every ray is kept.
    VoxelArrays voxels();

  private:
    Device device_;
    Sight sight_;
    DisplaySteps steps_;
    float near_depth_;
    Space space_;
    uint32_t total_;  ///< places for rays
    Buffer<uint32_t> hit_steps_, objects_;
    Buffer<float> depths_, colors_;
    Buffer<float> spans_;  ///< only in a world with a medium
    Program program_;
    Kernel measure_, count_, place_, fill_;
};

}  // namespace voxelume
