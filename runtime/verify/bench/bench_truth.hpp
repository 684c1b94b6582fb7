// What an ideal image of a subject shows, pixel by pixel.
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
    std::vector<std::optional<AnalyticHit>> hits;  ///< per pixel, likewise
    PixelContour silhouette;                       ///< where hits end
    std::vector<glm::dvec3> radiance;  ///< per pixel, its mean; empty for subjects without light
};

/// Computed on all the processor's threads.
///
/// A pixel's light is the mean over its square by 4 x 4 rays, and by 8 x 8 where those differ by
/// more than 1/64 of a unit.
BenchTruth bench_truth(const BenchSubject& subject, glm::ivec2 size);

}  // namespace voxelume
