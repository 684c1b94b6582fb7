// SPDX-License-Identifier: Apache-2.0
// Compares pictures of combined solids with the implicit functions of their shapes.
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <functional>
#include <glm/geometric.hpp>
#include <string>
#include <utility>
#include <vector>

#include "runtime/render/renderer.hpp"
#include "runtime/scene_file/read_scene.hpp"
#include "tests/pictures/touching/pair_scenes.hpp"
#include "tests/support/test_device.hpp"

namespace voxelume {

/// The implicit function of a shape, negative inside.
using ImplicitShape = std::function<double(const glm::dvec3&)>;

inline double ball_value(const glm::dvec3& p, const glm::dvec3& centre, const glm::dvec3& radii) {
    const glm::dvec3 q = (p - centre) / radii;
    return glm::dot(q, q) - 1;
}

inline double common_value(double a, double b) {
    return std::max(a, b);
}

inline double bitten_value(double body, double bite) {
    return std::max(body, -bite);
}

/// A solid of rounded parts, and its function.
struct CombinedSolid {
    std::string name;
    std::string keys;
    ImplicitShape shape;
    bool has_inner_edges = true;  ///< some are seen in front of the solid itself
};

/// `cells`: the world's voxels along an axis.
inline std::string parts_scene(const CombinedSolid& parts, int cells, const char* placement) {
    return pair_scene(2.6 / cells,
                      fmt::format(R"("a": {{{}, "surface": "smooth", "resolution": {}}})",
                                  parts.keys, cells * 3 / 4),
                      fmt::format(R"({{"model": "a", "placement": "{}"}})", placement));
}

/// The errors of a picture's surface against the solid, in voxels.
struct EdgeErrors {
    size_t shown = 0;  ///< pixels that show the solid, as they should
    size_t edge = 0;   ///< pixels next to an edge between two parts
    size_t wrong = 0;  ///< pixels that show the solid, or the ground behind it, and shouldn't
    double at_edge = 0, elsewhere = 0;  ///< RMS
};

/// The point where a ray meets the solid's implicit function.
struct SeenSolid {
    double t = INFINITY;
    glm::dvec3 normal{0};
    bool is_hit() const { return t < INFINITY; }
};

class SolidTruth {
  public:
    SolidTruth(const Observer& observer, ImplicitShape shape)
        : observer_(observer), shape_(std::move(shape)) {
        for (int y = -1; y <= kPairSize.y; ++y)
            for (int x = -1; x <= kPairSize.x; ++x) seen_.push_back(trace(direction(x, y)));
    }

    glm::dvec3 direction(int x, int y) const { return direction_at(observer_, {x + 0.5, y + 0.5}); }
    const SeenSolid& at(int x, int y) const {
        return seen_[size_t(y + 1) * (kPairSize.x + 2) + size_t(x + 1)];
    }

    /// True if a neighbour's surface faces away from that at (x,y) by more than curvature explains.
    bool is_at_edge(int x, int y) const {
        for (const glm::ivec2 step : {glm::ivec2(1, 0), {-1, 0}, {0, 1}, {0, -1}}) {
            const SeenSolid& neighbour = at(x + step.x, y + step.y);
            if (neighbour.is_hit() && glm::dot(neighbour.normal, at(x, y).normal) < 0.8)
                return true;
        }
        return false;
    }
    /// True if the solid's outline, or the outline of a part in front of another, is within a
    /// pixel.
    bool is_at_outline(int x, int y) const {
        for (int j = -1; j <= 1; ++j)
            for (int i = -1; i <= 1; ++i)
                if (!(std::abs(at(x + i, y + j).t - at(x, y).t) < 0.15)) return true;
        return false;
    }

    /// The distance of a point that a pixel shows from the surface, along its normal, in metres.
    /// The outlines of parts may be off by a tenth of a pixel.
    double distance(const glm::dvec3& point, const glm::dvec3& normal,
                    const glm::dvec2& pixel) const {
        constexpr double kNear = 0.005, kSlack = 0.1;  // metres, pixels
        double minimum = INFINITY;
        for (const glm::dvec2 step :
             {glm::dvec2(0), {kSlack, 0}, {-kSlack, 0}, {0, kSlack}, {0, -kSlack}}) {
            const glm::dvec3 d = direction_at(observer_, pixel + step);
            const double off = glm::dot(point - observer_.position, d) - trace(d).t;
            minimum = std::min(minimum, std::abs(off * glm::dot(normal, d)));
            if (minimum < kNear) break;
        }
        return minimum;
    }

  private:
    double value(const glm::dvec3& direction, double t) const {
        return shape_(observer_.position + t * direction);
    }

    SeenSolid trace(const glm::dvec3& direction) const {
        constexpr double kFirst = 2, kLast = 5.5, kStep = 1 / 256.0;
        for (double t = kFirst; t < kLast; t += kStep) {
            if (value(direction, t + kStep) >= 0) continue;
            double low = t, high = t + kStep;
            for (int i = 0; i < 40; ++i)
                (value(direction, (low + high) / 2) < 0 ? high : low) = (low + high) / 2;
            return {low, normal_at(observer_.position + low * direction)};
        }
        return {};
    }

    glm::dvec3 normal_at(const glm::dvec3& p) const {
        glm::dvec3 gradient(0);
        for (int axis = 0; axis < 3; ++axis) {
            glm::dvec3 step(0);
            step[axis] = 1e-6;
            gradient[axis] = shape_(p + step) - shape_(p - step);
        }
        return glm::normalize(gradient);
    }

    Observer observer_;
    ImplicitShape shape_;
    std::vector<SeenSolid> seen_;
};

inline glm::dvec3 channel_vector(const Image& image, const char* name, size_t i) {
    const auto value = [&](const char* axis) {
        return double(image.planes.at(fmt::format("{}.{}", name, axis))[i]);
    };
    return {value("X"), value("Y"), value("Z")};
}

inline EdgeErrors edge_errors_of(const CombinedSolid& parts, int cells, const char* placement,
                                 const std::filesystem::path& folder = {}) {
    const Scene scene =
        parse_scene(parts_scene(parts, cells, placement), folder / "parts.json", {});
    const SolidTruth truth(scene.observer, parts.shape);
    RenderReport report;
    const Image image = render(test_device(), scene, report);
    EdgeErrors errors;
    double at_edge = 0, elsewhere = 0;
    size_t count = 0;
    for (int y = 0; y < kPairSize.y; ++y)
        for (int x = 0; x < kPairSize.x; ++x) {
            const size_t i = size_t(y) * kPairSize.x + size_t(x);
            const SeenSolid& seen = truth.at(x, y);
            const bool is_shown = image.id_planes.at("objectId")[i] != 0;
            if (is_shown != seen.is_hit()) {
                errors.wrong += truth.is_at_outline(x, y) ? 0 : 1;
                continue;
            }
            if (!is_shown || truth.is_at_outline(x, y)) continue;
            const double off = truth.distance(channel_vector(image, "P", i),
                                              channel_vector(image, "N", i), {x + 0.5, y + 0.5}) /
                               scene.world.voxel_size.x;
            const bool is_edge = truth.is_at_edge(x, y);
            ++errors.shown;
            errors.edge += is_edge;
            (is_edge ? at_edge : elsewhere) += off * off;
            count += !is_edge;
        }
    errors.at_edge = std::sqrt(at_edge / double(std::max<size_t>(errors.edge, 1)));
    errors.elsewhere = std::sqrt(elsewhere / double(std::max<size_t>(count, 1)));
    return errors;
}

}  // namespace voxelume
