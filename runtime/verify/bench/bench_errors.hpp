// SPDX-License-Identifier: Apache-2.0
// The differences between an image and the truth of its subject.
#pragma once

#include <cstdint>

#include "runtime/image/image.hpp"
#include "runtime/verify/bench/bench_truth.hpp"

namespace voxelume {

struct BenchErrors {
    uint64_t compared = 0;  ///< pixels that both hit, with an incidence cosine of at least
                            ///< kMinCosine
    double depth_rms = 0;   ///< metres along the ray
    double depth_max = 0;
    double float_spacing = 0;    ///< metres between floats at the mean of the compared depths
    double normal_rms = 0;       ///< degrees
    double silhouette_mean = 0;  ///< pixels: area that only one of both hits, divided by the true
                                 ///< length
    double silhouette_max = 0;   ///< pixels: farthest centre of such a pixel from the true
                                 ///< silhouette
    uint64_t other_parts = 0;    ///< pixels that show a part before or behind the true one
    double color_rmse = 0;       ///< RMSE of linear R, G and B against the pixel's mean; 0 without
                                 ///< light
    double flip = 0;             ///< mean of the FLIP map, 0..1; 0 without light
};

/// Depth errors grow with 1/cosine without bound, so flatter hits than this count as silhouettes.
inline constexpr double kMinCosine = 0.3;

/// A hit that is farther from the true one than this many voxels is on another part of the surface:
/// an outline inside the figure has moved. A cube's corner at kMinCosine is 5.8 voxels away.
inline constexpr double kSamePartVoxels = 6;

/// Compares an image's planes A, P and N, and R, G and B where there is light, with the truth. Both
/// have the same size.
BenchErrors measure_errors(const BenchTruth& truth, const Image& image, double voxel_size);

}  // namespace voxelume
