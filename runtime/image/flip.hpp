// SPDX-License-Identifier: Apache-2.0
// FLIP: how different two images look to somebody who flips between them.
//
// Source: Andersson, Nilsson, Akenine-Möller, Oskarsson, Åström, Fairchild: "FLIP: A Difference
// Evaluator for Alternating Images", 2020, with the metric for low dynamic range.
#pragma once

#include <vector>

#include "runtime/image/image.hpp"

namespace voxelume {

/// The resolution for an observer 0.7 m from a display of 3,840 pixels on 0.7 m, as in the paper.
inline constexpr double kPixelsPerDegree = 67.0206;

/// Returns one value per pixel, row 0 at the top: 0 for pixels that look alike, up to 1. The planes
/// R, G and B are linear Rec. 709 and are clamped to 0..1. Both images have the same size.
std::vector<float> flip_map(const Image& image, const Image& reference,
                            double pixels_per_degree = kPixelsPerDegree);

double mean_flip(const Image& image, const Image& reference,
                 double pixels_per_degree = kPixelsPerDegree);

}  // namespace voxelume
