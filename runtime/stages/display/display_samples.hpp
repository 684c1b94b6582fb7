// SPDX-License-Identifier: Apache-2.0
// voxels of the layout `lattice` -> samples on the surface in each voxel, which shows their mean
// light.
#pragma once

#include "runtime/opencl/program.hpp"
#include "runtime/stages/display/display_lattice.hpp"

namespace voxelume {

/// The sums of samples: for each voxel 3 numbers of a normal and 4 of light, the sums of colours
/// times weights, and of weights; for each ray of a batch its weight.
struct SampleSums {
    Buffer<float> normals, light, weights;
};

SampleSums allocate_sample_sums(const Device& device, size_t voxels, uint32_t rays);

/// The kernels of display_samples.cl. A voxel may hold several surfaces. Each surface crosses lines
/// along the axis that it faces most, and has a probe point on these.
class DisplaySampleStage {
  public:
    /// `samples` is the number for each surface in a voxel, at least 2.
    DisplaySampleStage(const Device& device, const Features& features, const Camera& camera,
                       const VolumeFrame& frame, const Pyramid& world, int samples);

    /// Lights the samples batch by batch, and stores their means in the voxels. With
    /// `clears_others` voxels without samples have object 0 afterwards.
    void light(const LightRays& light_rays, const SpaceMedium& medium, const Buffer<float4>& views,
               RayBatch& batch, ShownVoxels& shown, bool clears_others);

    uint64_t rays() const { return rays_; }  ///< number of rays aimed so far

  private:
    /// The surfaces that face an axis.
    struct Facing {
        const ShownVoxels& shown;
        const ProbePoints& points;
    };
    void light_facing(const LightRays& light_rays, const SpaceMedium& medium,
                      const Buffer<float4>& views, RayBatch& batch, const Facing& facing);
    void add(const LightRays& light_rays, const SpaceMedium& medium, RayBatch& batch,
             const Facing& facing, const SampledRays& which);

    Device device_;
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
