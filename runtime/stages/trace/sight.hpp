// SPDX-License-Identifier: Apache-2.0
// observer -> rays: one sight ray for every sample of every pixel.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "kernels/shared/scene.h"
#include "runtime/grid/grid_frame.hpp"
#include "runtime/opencl/program.hpp"
#include "runtime/scene/scene.hpp"
#include "runtime/stages/features.hpp"
#include "runtime/stages/ray_batch.hpp"

namespace voxelume {

/// The observer's camera for kernels, in the voxels of the world.
Camera camera_of(const Scene& scene, const GridFrame& world);

/// The distance between the rays of neighbouring pixels at the middle of the world, in voxels.
double voxels_a_pixel(const Scene& scene, const Camera& camera, const GridFrame& world);

/// Without `scattered_sight`, the positions of the samples in each pixel: x and y, in [0, 1) except
/// for filters that are wider than a pixel. A single sample is the centre; several are the R2
/// sequence of Roberts 2018, which fills a square evenly for any number of samples, denser where
/// the filter is higher.
std::vector<float> sample_offsets(int samples, int first = 0,
                                  const ReconstructionFilter& filter = {});

/// For features with `scattered_sight`: VXL_FILTER_STEPS + 1 positions from a pixel's left side,
/// before which its filter has even shares of its weight, from none to all.
std::vector<float> filter_positions(const ReconstructionFilter& filter);

/// The number of tiles of 4 x 4 pixels that cover an image.
uint32_t tile_count(int width, int height);

/// The kernel of sight.cl: the paper's block 2.
class SightStage {
  public:
    SightStage(const Device& device, const Features& features, const Camera& camera,
               const ReconstructionFilter& filter = {});

    /// Sets another observer's camera for the rays from here on; the number of samples stays.
    void look(const Camera& camera) { camera_ = camera; }

    /// From now on tiles consist of the listed pixels, 16 each: by their numbers along the image's
    /// rows, or VXL_NO_PIXEL.
    void choose(const Device& device, std::span<const uint32_t> pixels);

    /// Casts the rays of `tiles` tiles from `first_tile` on, 16 * samples each. Returns their
    /// number.
    uint32_t cast(const PyramidShape& world, uint32_t first_tile, uint32_t tiles, RayBatch& batch);

  private:
    Camera camera_;
    Buffer<float> offsets_;
    std::optional<Buffer<uint32_t>> pixels_;  ///< if set, only these pixels are cast
    Program program_;
    Kernel cast_;
};

}  // namespace voxelume
