// SPDX-License-Identifier: Apache-2.0
// a light -> beams: the distances from the light within which the world is empty.
#pragma once

#include "runtime/stages/trace/beam.hpp"

namespace voxelume {

/// The grid of a light's beams through a world of `size` voxels. The beams are narrow enough for a
/// dilated occupancy whose voxels are 1 / `scale` of the world's. The grid has no columns if no
/// axis separates the light from the world, if beams would be too oblique, or if more than
/// `maximum` of them would be needed.
BeamGrid beam_grid(const LightRecord& light, const glm::ivec3& size, float scale, uint32_t maximum);

/// The number of lights that may each send the maximum number of beams; more lights together send
/// as many beams as these.
inline constexpr uint32_t kLightsOfMaxBeams = 4;

/// True if beams of lights can tell where shadow rays end: not if shadow rays accumulate
/// transmittance, nor if most of them begin on surfaces that no sight ray meets.
inline bool lights_send_beams(const Features& features) {
    return features.shadows && !features.filter && !features.global;
}

/// The grids of several lights, with at most `together` beams in all.
std::vector<BeamGrid> beam_grids(std::span<const LightRecord> lights, const glm::ivec3& size,
                                 float scale, uint32_t maximum, uint32_t together);
/// The array of a grid's beams.
Buffer<float> allocate_light_beams(const Device& device, const BeamGrid& grid);

/// True if two grids of one dilated occupancy have the same beams.
bool same_beams(const BeamGrid& a, const BeamGrid& b);

/// The maximum number of beams of one light that saves more time than it costs, for pixels of this
/// width and `rays` sight rays in all: one beam for every 16 rays that may meet the world, and at
/// most the number for the grid of a distant light.
uint32_t light_beams_that_pay(const GridFrame& world, uint64_t rays, int samples,
                              double voxels_a_pixel);

/// Runs `send_light_beams` of light_beams.cl. Beams change how long shadow rays take, never what
/// they meet.
class LightBeamStage {
  public:
    /// `dilated_occupancy` is the pyramid's.
    LightBeamStage(const Device& device, const Features& features, const Pyramid& pyramid,
                   DilatedOccupancy dilated_occupancy);

    /// Sends those beams of a grid with columns that pass sectors with voxels, where shadow rays
    /// begin. Returns the length of each beam.
    Buffer<float> send(const BeamGrid& grid);

    uint64_t sent() const { return sent_; }

  private:
    Device device_;
    glm::dvec3 size_;  // size of the world in voxels
    PyramidShape shape_;
    DilatedOccupancy dilated_occupancy_;
    uint64_t sent_ = 0;
    Program program_;
    Kernel send_;
};

}  // namespace voxelume
