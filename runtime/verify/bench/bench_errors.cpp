// SPDX-License-Identifier: Apache-2.0
#include "runtime/verify/bench/bench_errors.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include "runtime/image/flip.hpp"

namespace voxelume {
namespace {

/// The angle between two vectors in degrees, accurate to the last bits also for small angles.
double angle_between(const glm::dvec3& a, const glm::dvec3& b) {
    return glm::degrees(std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b)));
}

/// The three planes of a vector.
class VectorPlanes {
  public:
    VectorPlanes(const Image& image, const char* name)
        : x_(image.planes.at(std::string(name) + ".X")),
          y_(image.planes.at(std::string(name) + ".Y")),
          z_(image.planes.at(std::string(name) + ".Z")) {}
    glm::dvec3 operator[](size_t pixel) const { return {x_[pixel], y_[pixel], z_[pixel]}; }

  private:
    const Plane<float>&x_, &y_, &z_;
};

void measure_light(const BenchTruth& truth, const Image& image, BenchErrors& errors) {
    Image ideal{truth.size.x, truth.size.y, {}, {}, {}};
    double squares = 0;
    constexpr const char* kNames[] = {"R", "G", "B"};
    for (int channel = 0; channel < 3; ++channel) {
        const Plane<float>& shown = image.planes.at(kNames[channel]);
        std::vector<float> plane;
        for (size_t pixel = 0; pixel < truth.radiance.size(); ++pixel) {
            const double value = truth.radiance[pixel][channel];
            plane.push_back(float(value));
            squares += (shown[pixel] - value) * (shown[pixel] - value);
        }
        ideal.planes[kNames[channel]] = std::move(plane);
    }
    errors.color_rmse = std::sqrt(squares / (3 * double(truth.radiance.size())));
    errors.flip = mean_flip(image, ideal);
}

}  // namespace

BenchErrors measure_errors(const BenchTruth& truth, const Image& image, double voxel_size) {
    const VectorPlanes positions(image, "P"), normals(image, "N");
    const Plane<float>& alpha = image.planes.at("A");
    BenchErrors errors;
    ContourError silhouette(truth.silhouette);
    double depth_squares = 0, normal_squares = 0, depths = 0;
    for (size_t pixel = 0; pixel < truth.hits.size(); ++pixel) {
        const std::optional<AnalyticHit>& ideal = truth.hits[pixel];
        const bool hit = alpha[pixel] > 0;
        if (hit != ideal.has_value()) {
            const size_t column = pixel % size_t(truth.size.x), row = pixel / size_t(truth.size.x);
            silhouette.add({double(column) + 0.5, double(row) + 0.5});
        }
        if (!hit || !ideal) continue;
        const glm::dvec3& direction = truth.directions[pixel];
        if (-glm::dot(direction, ideal->normal) < kMinCosine) continue;
        const double depth = glm::dot(positions[pixel] - truth.eye, direction) - ideal->t;
        if (std::abs(depth) > kSamePartVoxels * voxel_size) {
            ++errors.other_parts;
            continue;
        }
        const double angle = angle_between(normals[pixel], ideal->normal);
        depths += ideal->t;
        depth_squares += depth * depth;
        normal_squares += angle * angle;
        errors.depth_max = std::max(errors.depth_max, std::abs(depth));
        ++errors.compared;
    }
    const double count = double(std::max<uint64_t>(errors.compared, 1));
    errors.depth_rms = std::sqrt(depth_squares / count);
    errors.normal_rms = std::sqrt(normal_squares / count);
    const auto mean_depth = float(depths / count);
    errors.float_spacing = double(std::nextafter(mean_depth, INFINITY)) - double(mean_depth);
    errors.silhouette_mean = silhouette.mean();
    errors.silhouette_max = silhouette.max();
    if (!truth.radiance.empty()) measure_light(truth, image, errors);
    return errors;
}

}  // namespace voxelume
