// probe points -> P in the layout `lattice`: the voxels that are shown, and their light.
#pragma once

#include "runtime/illumination.hpp"
#include "runtime/stages/display_rays.hpp"
#include "runtime/stages/display_scan.hpp"

namespace voxelume {

/// The voxels that a lattice shows, each with the probe point that gives it its light.
struct ShownVoxels {
    VoxelArrays voxels;  ///< with `places` alone filled
    ProbePoints points;  ///< one for each voxel
};

/// Kernels of display_lattice.cl. The paper's blocks 2 and 3.
class DisplayLatticeStage {
  public:
    /// `sight` is the observer's; throws Error::limit for a lattice whose mask has no room.
    DisplayLatticeStage(const Device& device, const Features& features, const Sight& sight,
                        const VolumeFrame& frame, const Pyramid& world);

    /// Finds in which view each point is visible, as the display's visibility asks for.
    void find_views(TraceStage& trace, RayBatch& batch, std::vector<ProbePoints>& pieces);

    /// The voxels of all points that have a view.
    ShownVoxels choose(const std::vector<ProbePoints>& pieces);

    /// Lights the voxels, batch by batch.
    void light(TraceStage& trace, Illumination& illumination, const Space& space, RayBatch& batch,
               ShownVoxels& shown);

    uint64_t rays() const { return rays_; }  ///< aimed so far

  private:
    void aim(const ProbePoints& points, uint32_t search, uint32_t first, uint32_t count,
             RayBatch& batch);
    /// Points and the voxels that their light goes to; of point n to voxel n when there is no list.
    struct LightTask {
        ProbePoints points;
        Buffer<uint32_t> targets;
    };
    void light_points(Illumination& illumination, const Space& space, RayBatch& batch,
                      const LightTask& task, VoxelArrays& voxels);
    LightTask missed_points(const ShownVoxels& shown, const glm::vec3& shift);
    void search(TraceStage& trace, RayBatch& batch, ProbePoints& points, uint32_t view);

    Device device_;
    Sight sight_;
    DisplayLattice lattice_;
    Visibility visibility_;
    const Pyramid& world_;
    Buffer<float4> views_;
    uint32_t groups_;
    Buffer<uint32_t> mask_;  ///< one bit for every voxel of the lattice
    Program program_;
    Kernel aim_, note_, mark_, count_, list_, choose_, keep_;
    uint64_t rays_ = 0;
};

}  // namespace voxelume
