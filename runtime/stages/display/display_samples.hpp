// SPDX-License-Identifier: Apache-2.0
// voxels of the layout `lattice` -> samples on the surface in each voxel, which shows their mean
// light.
#pragma once

#include "runtime/opencl/program.hpp"
#include "runtime/stages/display/display_lattice.hpp"
#include "runtime/stages/display/needed_samples.hpp"

namespace voxelume {

/// The sums of samples: for each voxel 3 numbers of a normal and 4 of light, the sums of colours
/// times weights, and of weights; for each ray of a batch its weight.
struct SampleSums {
    Buffer<float> normals, light, weights;
    Buffer<float> turns;     ///< for each sample
    Buffer<float> of_batch;  ///< like `light`, for each ray of a batch
};

/// Without `by_need` the last one is empty.
SampleSums allocate_sample_sums(const Device& device, size_t voxels, uint32_t rays, int samples,
                                bool by_need);

/// What lights a display's samples.
struct SampleLighting {
    const LightRays& rays;
    const SpaceMedium& medium;
    const Buffer<float4>& views;
    NeededSamples needed;  ///< empty: all voxels have the stage's number of samples
    std::function<void(double part)> progress;  ///< called with the part that is done, batch by
                                                ///< batch
};

/// The kernels of display_samples.cl. A voxel may hold several surfaces. Each surface crosses lines
/// along the axis that it faces most, and has a probe point on these.
class DisplaySampleStage {
  public:
    /// `samples` is the number for each surface in a voxel, at least 2.
    DisplaySampleStage(const Device& device, const Features& features, const Camera& camera,
                       const VolumeFrame& frame, const Pyramid& world, int samples);

    /// Lights the samples batch by batch, and stores their means in the voxels. With
    /// `clears_others` voxels without samples have object 0 afterwards.
    void light(const SampleLighting& with, RayBatch& batch, ShownVoxels& shown, bool clears_others);

    uint64_t rays() const { return rays_; }  ///< number of rays aimed so far

  private:
    /// The surfaces that face an axis.
    struct Facing {
        const ShownVoxels& shown;
        const ProbePoints& points;
    };
    /// Voxels from `first` on, whose sums begin with number `first_sum` of `sums`.
    struct Part {
        const Facing& facing;
        uint32_t first, count;
        uint32_t first_sum;
        const Buffer<float>& sums;
    };
    /// Samples from number `first` on, which are spread over each surface.
    struct Samples {
        uint32_t first, count;
    };
    void light_facing(const SampleLighting& with, RayBatch& batch, const Facing& facing);
    void find_normals(const SampleLighting& with, RayBatch& batch, const Part& part);
    void light_samples(const SampleLighting& with, RayBatch& batch, const Part& part,
                       const Samples& samples);
    void light_needed(const SampleLighting& with, RayBatch& batch, const Part& part);
    void aim(const SampleLighting& with, RayBatch& batch, const Part& part, const SampleAim& at);
    void add(const SampleLighting& with, RayBatch& batch, const Part& part,
             const SampledRays& rays);

    Device device_;
    Camera camera_;
    DisplayLattice lattice_;
    bool transmission_;
    const Pyramid& world_;
    uint32_t samples_;
    SampleSums sums_;
    std::vector<float> means_;  ///< of needed samples: four for each voxel
    Program program_;
    Kernel normals_, aim_, add_, mix_;
    uint64_t rays_ = 0;
    double done_ = 0, all_ = 1;  ///< voxels, once for each axis that surfaces face
};

}  // namespace voxelume
