#include "runtime/bench/bench_truth.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <functional>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <thread>

namespace voxelume {
namespace {

/// Tells hits from air at any point of the image.
class Outline {
  public:
    Outline(const FirstHit& first_hit, const Scene& scene) : first_hit_(first_hit), scene_(scene) {}

    bool is_hit(const glm::dvec2& pixel) const {
        return first_hit_(scene_.observer.position, sight_direction(scene_, pixel.x, pixel.y))
            .has_value();
    }

    /// Where hits end between two points, one of which is a hit.
    glm::dvec2 crossing(glm::dvec2 a, glm::dvec2 b) const {
        constexpr int kHalvings = 30;
        const bool begins = is_hit(a);
        for (int i = 0; i < kHalvings; ++i) {
            const glm::dvec2 middle = (a + b) / 2.0;
            (is_hit(middle) == begins ? a : b) = middle;
        }
        return (a + b) / 2.0;
    }

  private:
    const FirstHit& first_hit_;
    const Scene& scene_;
};

/// Adds the silhouette's pieces inside the square between four pixels' centres.
void add_segments(const Outline& outline, BenchTruth& truth, int column, int row) {
    const std::array<glm::ivec2, 4> corners = {
        {{column, row}, {column + 1, row}, {column + 1, row + 1}, {column, row + 1}}};
    std::array<glm::dvec2, 4> crossings;
    size_t count = 0;
    for (size_t i = 0; i < 4; ++i) {
        const glm::ivec2 a = corners[i], b = corners[(i + 1) % 4];
        const auto hit = [&](const glm::ivec2& p) {
            return truth.hits[size_t(p.y) * size_t(truth.size.x) + size_t(p.x)].has_value();
        };
        if (hit(a) != hit(b))
            crossings[count++] = outline.crossing(glm::dvec2(a) + 0.5, glm::dvec2(b) + 0.5);
    }
    for (size_t i = 0; i + 1 < count; i += 2) {
        truth.silhouette.push_back({crossings[i], crossings[i + 1]});
        truth.silhouette_length += glm::distance(crossings[i], crossings[i + 1]);
    }
}

/// Calls `work` with every row of an image, on all threads.
void for_rows(int rows, const std::function<void(int)>& work) {
    std::atomic<int> next = 0;
    const auto take = [&] {
        for (int row = next++; row < rows; row = next++) work(row);
    };
    std::vector<std::jthread> threads;
    for (unsigned i = 1; i < std::thread::hardware_concurrency(); ++i) threads.emplace_back(take);
    take();
}

/// Means of light over a square grid of rays in a pixel.
struct PixelLight {
    glm::dvec3 mean{0};
    double spread = 0;  ///< largest less smallest, of any channel
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
    constexpr double kMostSpread = 1.0 / 64;
    const PixelLight light = pixel_light(radiance, scene, pixel, kRays);
    return light.spread <= kMostSpread ? light.mean
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
    const Outline outline(subject.first_hit, scene);
    for (int row = 0; row + 1 < size.y; ++row)
        for (int column = 0; column + 1 < size.x; ++column)
            add_segments(outline, truth, column, row);
    return truth;
}

}  // namespace voxelume
