// SPDX-License-Identifier: Apache-2.0
// rays -> beams: the distance over which groups of neighbouring rays share empty space.
#pragma once

#include <optional>
#include <vector>

#include "kernels/shared/scene.h"
#include "runtime/grid/grid.hpp"
#include "runtime/stages/features.hpp"
#include "runtime/stages/ray_batch.hpp"

namespace voxelume {

/// The cells that a dilated occupancy consists of: leaves for narrow groups of rays, bricks for
/// groups up to four times as wide.
enum class DilationLevel { leaves, bricks };

/// The leaves (or bricks) of a pyramid that hold voxels, and all that touch one. If a point's leaf
/// isn't among them, no surface is within 4 voxels (16 for bricks) of the point. `sectors` and
/// `bricks` are as in Pyramid, but nothing lies below the masks of leaves. For bricks, read the
/// voxels as four times as long.
struct DilatedOccupancy {
    Buffer<uint32_t> sectors, bricks;
    DilationLevel of = DilationLevel::leaves;
    std::vector<glm::ivec3> sectors_with_voxels;  ///< sectors of the pyramid with voxels
};

/// The buffers of a dilated occupancy whose table has `sectors` entries and `stored` records; and
/// those of the beams of `rays` rays.
DilatedOccupancy allocate_dilated_occupancy(const Device& device, size_t sectors, size_t stored);
Buffer<uint32_t> allocate_beams(const Device& device, uint32_t rays);

/// The dilated occupancy of a world without instances. Reads the pyramid's upper levels back; host
/// work of about 16 nanoseconds a leaf that holds voxels, 2 for a dilated occupancy of bricks.
DilatedOccupancy build_dilated_occupancy(const Device& device, const Pyramid& pyramid,
                                         DilationLevel of = DilationLevel::leaves);

/// The dilated occupancy for the rays of neighbouring pixels, each `voxels_a_pixel` wide where it
/// meets the world; none if beams would be too wide for either.
std::optional<DilationLevel> dilation_for(double voxels_a_pixel);

/// The dilated occupancy whose beams save more time for this many sight rays than they take for
/// building it and loading one more kernel; none if neither does. It is none in worlds so large
/// that rounding could come near a beam's slack, see lib/traverse/beam.h.
std::optional<DilationLevel> dilation_that_pays(const Features& features, const Pyramid& world,
                                                uint64_t rays, double voxels_a_pixel);

/// The factor from the world's coordinates to those of a dilated occupancy.
inline float scale_of(DilationLevel of) {
    return of == DilationLevel::leaves ? 1.0f : 0.25f;
}

/// The shape of a pyramid's dilated occupancy.
PyramidShape dilated_shape(const Pyramid& pyramid, DilationLevel of);

/// Runs `start_beams` of sight.cl. Beams change how long rays take, never what they meet.
class BeamStage {
  public:
    /// `dilated_occupancy` is the pyramid's.
    BeamStage(const Device& device, const Features& features, const Pyramid& pyramid,
              DilatedOccupancy dilated_occupancy);

    /// Sends one beam for every 16 of the rays 0 .. count-1, and writes how far each came to
    /// `batch.beams`. The beams are valid for these rays only.
    void start(RayBatch& batch, uint32_t count);

    uint64_t sent() const { return sent_; }
    /// The number of beams whose rays meet nothing and end at once. Waits for the device.
    uint64_t cleared() const;

  private:
    Device device_;
    PyramidShape shape_;
    DilatedOccupancy dilated_occupancy_;
    uint64_t sent_ = 0;
    Buffer<uint32_t> cleared_;
    Program program_;
    Kernel start_;
};

}  // namespace voxelume
