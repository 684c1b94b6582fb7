// SPDX-License-Identifier: Apache-2.0
#include "runtime/verify/bench/bench_truth.hpp"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace voxelume {
namespace {

/// The light of a pixel over a square grid of rays.
struct PixelLight {
    glm::dvec3 mean{0};
    double spread = 0;  ///< maximum minus minimum, of the channel where this is largest
};

PixelLight pixel_light(const Radiance& radiance, const Scene& scene, glm::dvec2 pixel, int side) {
    PixelLight light;
    glm::dvec3 low(INFINITY), high(-INFINITY);
    for (int j = 0; j < side; ++j)
        for (int i = 0; i < side; ++i) {
            const glm::dvec2 at = pixel + (glm::dvec2(i, j) + 0.5) / double(side);
            const glm::dvec3 value =
                radiance(scene.observer.position, sight_direction(scene, at.x, at.y));
            low = glm::min(low, value), high = glm::max(high, value);
            light.mean += value / double(side * side);
        }
    const glm::dvec3 spread = high - low;
    light.spread = std::max({spread.x, spread.y, spread.z});
    return light;
}

glm::dvec3 pixel_radiance(const Radiance& radiance, const Scene& scene, glm::dvec2 pixel) {
    constexpr int kRays = 4, kManyRays = 8;
    constexpr double kMaxSpread = 1.0 / 64;
    const PixelLight light = pixel_light(radiance, scene, pixel, kRays);
    return light.spread <= kMaxSpread ? light.mean
                                      : pixel_light(radiance, scene, pixel, kManyRays).mean;
}

}  // namespace

BenchTruth bench_truth(const BenchSubject& subject, glm::ivec2 size) {
    const Scene scene = subject.scene(Surface::exact, 64, size);
    const size_t pixels = size_t(size.x) * size_t(size.y);
    BenchTruth truth;
    truth.size = size;
    truth.eye = scene.observer.position;
    truth.directions.resize(pixels);
    truth.hits.resize(pixels);
    if (subject.radiance) truth.radiance.resize(pixels);
    for_rows(size.y, [&](int row) {
        for (int column = 0; column < size.x; ++column) {
            const size_t pixel = size_t(row) * size_t(size.x) + size_t(column);
            truth.directions[pixel] = sight_direction(scene, column + 0.5, row + 0.5);
            truth.hits[pixel] = subject.first_hit(truth.eye, truth.directions[pixel]);
            if (subject.radiance)
                truth.radiance[pixel] =
                    pixel_radiance(subject.radiance, scene, glm::dvec2(column, row));
        }
    });
    std::vector<PixelSide> sides;
    sides.reserve(truth.hits.size());
    for (const auto& hit : truth.hits)
        sides.push_back(hit ? PixelSide::inside : PixelSide::outside);
    truth.silhouette = contour_of(size, sides, [&](const glm::dvec2& pixel) {
        return subject.first_hit(truth.eye, sight_direction(scene, pixel.x, pixel.y)).has_value();
    });
    return truth;
}

}  // namespace voxelume
