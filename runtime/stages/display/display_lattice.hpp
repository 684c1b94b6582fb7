// SPDX-License-Identifier: Apache-2.0
// probe points -> P in the layout `lattice`: the voxels that are shown, and their light.
#pragma once

#include <array>
#include <functional>
#include <span>
#include <vector>

#include "runtime/stages/display/display_rays.hpp"
#include "runtime/stages/display/display_scan.hpp"

namespace voxelume {

/// The voxels that a lattice shows, each with the probe point by which it is lit.
struct ShownVoxels {
    VoxelArrays voxels;                  ///< only `indices` are filled
    ProbePoints points;                  ///< one for each voxel
    std::array<ProbePoints, 3> of_axes;  ///< each voxel's point on lines along each axis, if any
    Buffer<uint32_t> starts;             ///< the number of voxels before each group of the mask
};

/// One bit for every voxel of a lattice. Throws Error::limit where it has no room.
Buffer<uint32_t> allocate_display_mask(const Device& device, const glm::ivec3& size);

/// Traces rays 0 .. count-1 of a batch. Where surfaces let light through, also computes how much
/// all surfaces along each ray cover.
using LookAhead = std::function<void(RayBatch& batch, uint32_t count)>;

/// The rays 0 .. count-1 of a batch, for `samples` samples of each point's light from number
/// `sample` on. The first ray belongs to point number `first`, a multiple of 16; rays of sixteen
/// points come sample by sample. Light that isn't shown needs no paths beyond the surface.
struct SampledRays {
    uint32_t first, count, sample = 0;
    bool is_shown = true;
    uint32_t samples = 1;
};

/// Lights rays of a batch, and calls `sink`, unless it is empty, for each layer of surfaces.
using LightRays =
    std::function<void(RayBatch& batch, const SampledRays& rays, const LayerSink& sink)>;

/// Lights rays and calls `use` with the batch, and the light, of the nearest surfaces: those behind
/// them have voxels of their own.
template <class Use>
void light_nearest(const LightRays& light_rays, bool transmission, RayBatch& batch,
                   const SampledRays& rays, const Use& use) {
    if (!transmission) {
        light_rays(batch, rays, {});
        return use(batch, NodeLight{batch.radiance, {}, batch.stride});
    }
    light_rays(batch, rays,
               [&](const RayBatch& entries, uint32_t, bool is_first, const NodeLight& nodes) {
                   if (is_first) use(entries, nodes);
               });
}

/// The kernels of display_lattice.cl: the paper's blocks 2 and 3.
class DisplayLatticeStage {
  public:
    /// `camera` is the observer's. Throws Error::limit for a lattice whose mask is too large.
    DisplayLatticeStage(const Device& device, const Features& features, const Camera& camera,
                        const VolumeFrame& frame, const Pyramid& world);

    /// Finds a view in which each point is visible, among those that the display's visibility
    /// allows.
    void find_views(const LookAhead& look, RayBatch& batch, std::vector<ProbePoints>& pieces);

    /// True for each of these points, in lattice voxels, that is visible in one of the views that
    /// the display's visibility allows. Points without a view yet are looked at together, view by
    /// view.
    std::vector<bool> are_visible(const LookAhead& look, RayBatch& batch,
                                  std::span<const glm::vec3> points);

    /// From now on, points inside objects get no view. `note_objects` must then be the sink of the
    /// layers that `look` traces.
    void leave_out_objects(const RayBatch& batch);
    void note_objects(const RayBatch& entries, uint32_t count, bool is_first);

    /// Chooses the voxels of all points that have a view. Finds `of_axes` if `samples` is above 1.
    ShownVoxels choose(const std::vector<ProbePoints>& pieces, int samples);

    /// Finds the voxels' objects and depths, batch by batch. Also finds their light if `is_shown`
    /// is true; otherwise samples replace it.
    void light(const LookAhead& look, const LightRays& light_rays, const SpaceMedium& medium,
               RayBatch& batch, ShownVoxels& shown, bool is_shown);

    /// Lights the voxels whose objects are 0 once more.
    void light_rest(const LookAhead& look, const LightRays& light_rays, const SpaceMedium& medium,
                    RayBatch& batch, ShownVoxels& shown);

    const Buffer<float4>& views() const { return views_; }

    /// One bit for every voxel of the lattice, 1 for those that are shown.
    const Buffer<uint32_t>& mask() const { return mask_; }

    uint64_t rays() const { return rays_; }  ///< number of rays aimed so far

  private:
    ProbePoints nearest(const std::vector<ProbePoints>& pieces, const ShownVoxels& shown, int axis);
    void aim(const ProbePoints& points, uint32_t search, uint32_t first, uint32_t count,
             RayBatch& batch);
    /// Points, and the voxels that get their light. If `targets` is empty, point n lights voxel n.
    struct LightTask {
        ProbePoints points;
        Buffer<uint32_t> targets;
        bool is_shown = true;
    };
    /// Adds the light of batch rays from `first` on, which `nodes` holds, to their voxels.
    void keep(const SpaceMedium& medium, const RayBatch& batch, const NodeLight& nodes,
              const LightTask& task, uint32_t first, uint32_t count, VoxelArrays& voxels);
    void light_points(const LightRays& light_rays, const SpaceMedium& medium, RayBatch& batch,
                      const LightTask& task, VoxelArrays& voxels);
    /// The points of all voxels, read from the device when a ray misses for the first time.
    struct HostPoints {
        std::vector<float> coordinates;
        std::vector<uint32_t> views;
    };
    LightTask missed_points(const ShownVoxels& shown, const glm::vec3& shift, HostPoints& host);
    void light_missed(const LookAhead& look, const LightRays& light_rays, const SpaceMedium& medium,
                      RayBatch& batch, ShownVoxels& shown, HostPoints& host, bool is_shown);
    void search(const LookAhead& look, RayBatch& batch, ProbePoints& points, uint32_t view,
                float max_covered);

    Device device_;
    Camera camera_;
    DisplayLattice lattice_;
    Visibility visibility_;
    bool transmission_;
    const Pyramid& world_;
    Buffer<float4> views_;
    uint32_t groups_;
    Buffer<uint32_t> in_object_;  ///< flags of rays; empty: points in objects have views, too
    Buffer<uint32_t> mask_;       ///< one bit for every voxel of the lattice
    Program program_;
    Kernel aim_, objects_, note_, mark_, count_, list_, choose_, take_, keep_;
    uint64_t rays_ = 0;
};

}  // namespace voxelume
