// rays -> beams: how far groups of neighbouring rays run through empty space together.
#pragma once

#include "kernels/shared/scene.h"
#include "runtime/grid.hpp"
#include "runtime/stages/features.hpp"
#include "runtime/stages/ray_batch.hpp"

namespace voxelume {

/// A pyramid's leaves that hold voxels, and all leaves that touch one: where a point's leaf isn't
/// among them, no surface is within 4 voxels of it. `sectors` and `bricks` as in Pyramid, but
/// nothing lies below the masks of leaves.
struct Halo {
    Buffer<uint32_t> sectors, bricks;
};

/// The halo of a world without instances. Reads the pyramid's upper levels back; host work of about
/// 0.3 microseconds a brick.
Halo build_halo(const Device& device, const Pyramid& pyramid);

/// Whether so many sight rays save more time by beams than these take: building the halo, loading
/// one more kernel. In larger worlds rounding could come near a beam's slack, see lib/beam.h.
bool beams_pay(const Features& features, const Pyramid& world, uint64_t rays);

/// `start_beams` of sight.cl. Beams change how long rays take, never what they meet.
class BeamStage {
  public:
    /// `halo` is the pyramid's.
    BeamStage(const Device& device, const Features& features, const Pyramid& pyramid, Halo halo);

    /// Sends one beam along every 16 of the rays 0 .. count-1 and leaves in `batch.beams` how far
    /// it came. The beams are those of these rays only.
    void start(RayBatch& batch, uint32_t count);

    uint64_t sent() const { return sent_; }
    /// Those whose rays meet nothing, and end at once; waits for the device.
    uint64_t cleared() const;

  private:
    Device device_;
    PyramidShape shape_;
    Halo halo_;
    uint64_t sent_ = 0;
    Buffer<uint32_t> cleared_;
    Program program_;
    Kernel start_;
};

}  // namespace voxelume
