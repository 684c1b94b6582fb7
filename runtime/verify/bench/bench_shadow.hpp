// SPDX-License-Identifier: Apache-2.0
// The edges of shadows: a bench's subject above a ground, in sunlight.
#pragma once

#include "runtime/image/image.hpp"
#include "runtime/verify/analytic/pixel_contour.hpp"
#include "runtime/verify/bench/bench_subject.hpp"

namespace voxelume {

/// The subject's scene with a ground below it, a sun, and an observer who looks down on both. The
/// ground is an exact instance, equal for all voxel sizes and surfaces.
Scene shadow_scene(const BenchSubject& subject, Surface surface, int resolution, glm::ivec2 size);

/// The ground's pixels that lie in the subject's shadow.
struct ShadowTruth {
    glm::ivec2 size{0};
    std::vector<PixelSide> sides;  ///< inside: in shadow; unknown: not the ground
    PixelContour edge;
};
ShadowTruth shadow_truth(const BenchSubject& subject, glm::ivec2 size);

struct ShadowErrors {
    double mean =
        0;           ///< pixels: ground in shadow in only one of both, divided by the edge's length
    double max = 0;  ///< pixels: farthest centre of such a pixel from the edge
};

/// Compares an image of `shadow_scene` with the truth, in the pixels that show the ground in both.
ShadowErrors measure_shadow(const ShadowTruth& truth, const Image& image);

}  // namespace voxelume
