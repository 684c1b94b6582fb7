// How far an image lies from the solid that it shows.
#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <optional>
#include <vector>

#include "runtime/bench/analytic_ray.hpp"
#include "runtime/bench/bench_scene.hpp"
#include "runtime/image.hpp"

namespace voxelume {

/// What ideal rays through the pixels' centres meet.
struct BenchTruth {
    struct Segment {
        glm::dvec2 a, b;  ///< pixels from the upper left corner
    };

    glm::ivec2 size{0};
    glm::dvec3 eye{0};
    std::vector<glm::dvec3> directions;            ///< per pixel
    std::vector<std::optional<AnalyticHit>> hits;  ///< per pixel
    std::vector<Segment> silhouette;               ///< where hits end, between pixels' centres
    double silhouette_length = 0;                  ///< pixels
};

BenchTruth bench_truth(const BenchSolid& solid, glm::ivec2 size);

struct BenchErrors {
    uint64_t compared = 0;  ///< pixels hit by both, incidence cosine at least kLeastCosine
    double depth_rms = 0;   ///< metres along the ray
    double depth_max = 0;
    double normal_rms = 0;       ///< degrees
    double silhouette_mean = 0;  ///< pixels: area hit by only one of both over the true length
    double silhouette_max = 0;   ///< pixels: farthest such pixel's centre from the true silhouette
};

/// Depth errors grow with 1/cosine to no bound, so hits flatter than this count as silhouettes.
inline constexpr double kLeastCosine = 0.3;

/// Compares an image's planes A, P and N with the truth; both have one size.
BenchErrors measure_errors(const BenchTruth& truth, const Image& image);

}  // namespace voxelume
