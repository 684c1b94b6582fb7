// SPDX-License-Identifier: Apache-2.0
// The contents of an ideal image of a subject, pixel by pixel.
#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <vector>

#include "runtime/verify/analytic/pixel_contour.hpp"
#include "runtime/verify/bench/bench_subject.hpp"

namespace voxelume {

struct BenchTruth {
    glm::ivec2 size{0};
    glm::dvec3 eye{0};
    std::vector<glm::dvec3> directions;            ///< per pixel, through its centre
    std::vector<std::optional<AnalyticHit>> hits;  ///< per pixel, for the ray through its centre
    PixelContour silhouette;                       ///< border of the hits
    std::vector<glm::dvec3> radiance;  ///< per pixel, mean of its light; empty for subjects without
                                       ///< light
};

/// Computes the truth on all threads of the processor.
///
/// A pixel's light is the mean over its square by 4 x 4 rays, and by 8 x 8 where those differ by
/// more than 1/64 of a unit.
BenchTruth bench_truth(const BenchSubject& subject, glm::ivec2 size);

}  // namespace voxelume
