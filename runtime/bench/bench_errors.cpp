#include "runtime/bench/bench_errors.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

namespace voxelume {
namespace {

/// Tells hits from air at any point of the image.
class Outline {
  public:
    Outline(const BenchSolid& solid, const Scene& scene) : solid_(solid), scene_(scene) {}

    bool is_hit(const glm::dvec2& pixel) const {
        return analytic_hit(solid_.solid, solid_.world_from_solid, scene_.observer.position,
                            sight_direction(scene_, pixel.x, pixel.y))
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
    const BenchSolid& solid_;
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

double distance_to(const BenchTruth::Segment& segment, const glm::dvec2& p) {
    const glm::dvec2 along = segment.b - segment.a;
    const double square = glm::dot(along, along);
    const double share =
        square > 0 ? std::clamp(glm::dot(p - segment.a, along) / square, 0.0, 1.0) : 0.0;
    return glm::distance(p, segment.a + share * along);
}

double distance_to_silhouette(const BenchTruth& truth, const glm::dvec2& p) {
    double nearest = INFINITY;
    for (const BenchTruth::Segment& segment : truth.silhouette)
        nearest = std::min(nearest, distance_to(segment, p));
    return nearest;
}

/// Degrees between two vectors, to the last bits of small ones.
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
    const std::vector<float>&x_, &y_, &z_;
};

}  // namespace

BenchTruth bench_truth(const BenchSolid& solid, glm::ivec2 size) {
    const Scene scene = bench_scene(solid, Surface::exact, 1, size);
    BenchTruth truth;
    truth.size = size;
    truth.eye = scene.observer.position;
    for (int row = 0; row < size.y; ++row) {
        for (int column = 0; column < size.x; ++column) {
            truth.directions.push_back(sight_direction(scene, column + 0.5, row + 0.5));
            truth.hits.push_back(analytic_hit(solid.solid, solid.world_from_solid, truth.eye,
                                              truth.directions.back()));
        }
    }
    const Outline outline(solid, scene);
    for (int row = 0; row + 1 < size.y; ++row)
        for (int column = 0; column + 1 < size.x; ++column)
            add_segments(outline, truth, column, row);
    return truth;
}

BenchErrors measure_errors(const BenchTruth& truth, const Image& image) {
    const VectorPlanes positions(image, "P"), normals(image, "N");
    const std::vector<float>& alpha = image.planes.at("A");
    BenchErrors errors;
    uint64_t differing = 0;
    double depth_squares = 0, normal_squares = 0;
    for (size_t pixel = 0; pixel < truth.hits.size(); ++pixel) {
        const std::optional<AnalyticHit>& ideal = truth.hits[pixel];
        const bool hit = alpha[pixel] > 0;
        if (hit != ideal.has_value()) {
            const size_t column = pixel % size_t(truth.size.x), row = pixel / size_t(truth.size.x);
            const glm::dvec2 center(double(column) + 0.5, double(row) + 0.5);
            errors.silhouette_max =
                std::max(errors.silhouette_max, distance_to_silhouette(truth, center));
            ++differing;
        }
        if (!hit || !ideal) continue;
        const glm::dvec3& direction = truth.directions[pixel];
        if (-glm::dot(direction, ideal->normal) < kLeastCosine) continue;
        const double depth = glm::dot(positions[pixel] - truth.eye, direction) - ideal->t;
        const double angle = angle_between(normals[pixel], ideal->normal);
        depth_squares += depth * depth;
        normal_squares += angle * angle;
        errors.depth_max = std::max(errors.depth_max, std::abs(depth));
        ++errors.compared;
    }
    const double count = double(std::max<uint64_t>(errors.compared, 1));
    errors.depth_rms = std::sqrt(depth_squares / count);
    errors.normal_rms = std::sqrt(normal_squares / count);
    errors.silhouette_mean = double(differing) / std::max(truth.silhouette_length, 1.0);
    return errors;
}

}  // namespace voxelume
