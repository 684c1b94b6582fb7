// SPDX-License-Identifier: Apache-2.0
// voxels of the layout `lattice` -> samples on the surface in each, whose mean light it shows.
#pragma once

#include "runtime/opencl/program.hpp"
#include "runtime/stages/display/display_lattice.hpp"

namespace voxelume {

/// Of each voxel, for its samples: the normal at its probe point, and sums of light.
struct SampleSums {
    Buffer<float> normals;  ///< 3 for each voxel, one after another; 0 where no surface was met
    Buffer<float> sums;     ///< 4 for each: of colours times opacities, and of opacities
};

SampleSums allocate_sample_sums(const Device& device, size_t voxels);

/// The kernels of display_samples.cl.
class DisplaySampleStage {
  public:
    /// `samples` of each voxel that is shown, at least 2.
    DisplaySampleStage(const Device& device, const Features& features, const Camera& camera,
                       const VolumeFrame& frame, const Pyramid& world, uint32_t samples,
                       const ShownVoxels& shown);

    /// Keeps the normals at the points of voxels `first` .. first+count-1 of the `targets`, or of
    /// all voxels without them. The batch's rays were aimed there and are lit.
    void keep_normals(const RayBatch& batch, const Buffer<uint32_t>& targets, uint32_t first,
                      uint32_t count);

    /// Lights the samples batch by batch, and gives the voxels their means.
    void light(const LightRays& light_rays, const Environment& environment,
               const Buffer<float4>& views, RayBatch& batch, ShownVoxels& shown);

    uint64_t rays() const { return rays_; }  ///< number of rays aimed so far

  private:
    void light_batch(const LightRays& light_rays, const Environment& environment, RayBatch& batch,
                     const ShownVoxels& shown, uint32_t first, uint32_t count);

    Camera camera_;
    DisplayLattice lattice_;
    bool transmission_;
    const Pyramid& world_;
    uint32_t samples_;
    SampleSums sums_;
    Program program_;
    Kernel normals_, aim_, add_, mix_;
    uint64_t rays_ = 0;
};

}  // namespace voxelume
