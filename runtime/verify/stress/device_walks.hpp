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

/// Rays' components as kernels take them, `stride` values apart, `t_end` infinite; places behind
/// the last ray are idle.
std::vector<float> ray_components(const FixedGrid& grid, std::span<const FixedRay> rays,
                                  uint32_t stride);

/// A multiple of 16 places for so many rays.
inline uint32_t ray_stride(size_t count) {
    return uint32_t((count + 15) / 16 * 16);
}

class DeviceWalks {
  public:
    explicit DeviceWalks(const Device& device);

    /// Enqueues the walks of rays; `digests` waits for them.
    void start(const FixedGrid& grid, std::span<const FixedRay> rays, Steps steps,
               uint32_t maximum);
    std::vector<WalkDigest> digests() const;

    /// The first `maximum` cells of one ray.
    std::vector<EnteredCell> cells(const FixedGrid& grid, const FixedRay& ray, Steps steps,
                                   uint32_t maximum);

    /// Rays as snapping leaves them, nothing for those that pass the grid.
    std::vector<std::optional<FixedRay>> snap(const FixedGrid& grid,
                                              std::span<const FloatRay> rays);

  private:
    Device device_;
    Program cells_, blocks_;
    Buffer<uint32_t> digests_;
    uint32_t count_ = 0;
};

/// Cubes at the voxels of a frame that are set.
BrickGrid cubes_of(const Device& device, const VoxelBits& voxels, const GridFrame& frame);

class DeviceHits {
  public:
    DeviceHits(const Device& device, const Pyramid& pyramid);

    void start(const FixedGrid& grid, std::span<const FixedRay> rays);
    /// The same behind beams along every 16 of them, as sight rays of frames go.
    void start_along_beams(const FixedGrid& grid, std::span<const FixedRay> rays);
    /// The hits of the rays started last; nothing for a miss.
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
