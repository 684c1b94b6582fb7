// SPDX-License-Identifier: Apache-2.0
// The walks of stress.cl and the hits of trace.cl, for rays in fixed point.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "runtime/opencl/program.hpp"
#include "runtime/stages/trace/beam.hpp"
#include "runtime/stages/trace/trace.hpp"
#include "runtime/verify/exact/exact_snap.hpp"

namespace voxelume {

/// The components of rays as kernels take them, `stride` values apart, with infinite `t_end`.
/// Entries behind the last ray are idle.
std::vector<float> ray_components(const FixedGrid& grid, std::span<const FixedRay> rays,
                                  uint32_t stride);

/// The number of entries for `count` rays: a multiple of 16.
inline uint32_t ray_stride(size_t count) {
    return uint32_t((count + 15) / 16 * 16);
}

class DeviceWalks {
  public:
    explicit DeviceWalks(const Device& device);

    /// Enqueues the walks of rays. digests() waits for them.
    void start(const FixedGrid& grid, std::span<const FixedRay> rays, Steps steps,
               uint32_t maximum);
    std::vector<WalkDigest> digests() const;

    /// The first `maximum` cells of one ray's walk.
    std::vector<EnteredCell> cells(const FixedGrid& grid, const FixedRay& ray, Steps steps,
                                   uint32_t maximum);

    /// The rays after snapping; empty for those that pass by the grid.
    std::vector<std::optional<FixedRay>> snap(const FixedGrid& grid,
                                              std::span<const FloatRay> rays);

  private:
    Device device_;
    Program cells_, blocks_;
    Buffer<uint32_t> digests_;
    uint32_t count_ = 0;
};

/// A brick grid of cubes at the set voxels of a frame.
BrickGrid cubes_of(const Device& device, const VoxelBits& voxels, const GridFrame& frame);

class DeviceHits {
  public:
    DeviceHits(const Device& device, const Pyramid& pyramid);

    void start(const FixedGrid& grid, std::span<const FixedRay> rays);
    /// Enqueues the hits of rays behind beams, one along every 16 of them, as for sight rays of
    /// frames.
    void start_along_beams(const FixedGrid& grid, std::span<const FixedRay> rays);
    /// The hits of the rays started last; empty for a miss.
    std::vector<std::optional<EnteredCell>> hits() const;

  private:
    void upload(const FixedGrid& grid, std::span<const FixedRay> rays);

    Device device_;
    const Pyramid& pyramid_;
    TraceStage stage_;
    std::optional<BeamStage> beams_;
    RayBatch batch_;
    uint32_t count_ = 0;
};

}  // namespace voxelume
