// SPDX-License-Identifier: Apache-2.0
// Smooth unions, intersections and differences against the analytic tracer: edges between their
// parts are as sharp as their voxels let them be.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <glm/geometric.hpp>
#include <random>
#include <string>
#include <vector>

#include "runtime/render/renderer.hpp"
#include "runtime/scene_file/read_scene.hpp"
#include "tests/pictures/pair_scenes.hpp"
#include "tests/support/exhaustive.hpp"
#include "tests/support/test_device.hpp"

namespace voxelume {
namespace {

/// The implicit function of a shape, negative inside.
using ImplicitShape = std::function<double(const glm::dvec3&)>;

double ball_value(const glm::dvec3& p, const glm::dvec3& centre, const glm::dvec3& radii) {
    const glm::dvec3 q = (p - centre) / radii;
    return glm::dot(q, q) - 1;
}

double ring_value(const glm::dvec3& p) {
    return std::hypot(std::hypot(p.x, p.z) - 0.7, p.y) - 0.2;
}

double common_value(double a, double b) {
    return std::max(a, b);
}

double bitten_value(double body, double bite) {
    return std::max(body, -bite);
}

/// A solid of rounded parts, and its function.
struct CombinedSolid {
    std::string name;
    std::string keys;
    ImplicitShape shape;
    bool has_inner_edges = true;  ///< some are seen in front of the solid itself
};

const std::vector kCombinedSolids = {
    CombinedSolid{"ring and balls", R"("shape": "union", "parts": [
              {"shape": "torus", "radius": 0.7, "tube": 0.2},
              {"shape": "union", "position": [0, 0.05, 0], "parts": [
                  {"shape": "sphere", "radius": 0.6, "position": [0.12, 0, 0.2]},
                  {"shape": "sphere", "radius": 0.4, "position": [-0.5, 0.2, 0.3]}]}])",
                  [](const glm::dvec3& p) {
                      return std::min({ring_value(p),
                                       ball_value(p, {0.12, 0.05, 0.2}, glm::dvec3(0.6)),
                                       ball_value(p, {-0.5, 0.25, 0.3}, glm::dvec3(0.4))});
                  }},
    CombinedSolid{"lens", R"("shape": "intersection", "parts": [
              {"shape": "sphere", "radius": 0.9, "position": [-0.35, 0.1, 0]},
              {"shape": "sphere", "radius": 0.8, "position": [0.4, 0.05, 0.2]}])",
                  [](const glm::dvec3& p) {
                      return common_value(ball_value(p, {-0.35, 0.1, 0}, glm::dvec3(0.9)),
                                          ball_value(p, {0.4, 0.05, 0.2}, glm::dvec3(0.8)));
                  }},
    CombinedSolid{"bowl with a wall of a third of a voxel", R"("shape": "difference", "parts": [
              {"shape": "sphere", "radius": 0.9}, {"shape": "sphere", "radius": 0.875},
              {"shape": "sphere", "radius": 0.6, "position": [0.3, 0.7, 0.4]}])",
                  [](const glm::dvec3& p) {
                      const double hollow =
                          std::min(ball_value(p, glm::dvec3(0), glm::dvec3(0.875)),
                                   ball_value(p, {0.3, 0.7, 0.4}, glm::dvec3(0.6)));
                      return common_value(ball_value(p, glm::dvec3(0), glm::dvec3(0.9)), -hollow);
                  },
                  false},
    CombinedSolid{
        "bitten ball with a ring", R"("shape": "union", "parts": [
              {"shape": "torus", "radius": 0.7, "tube": 0.2},
              {"shape": "difference", "parts": [
                  {"shape": "ellipsoid", "radii": [0.7, 0.9, 0.6]},
                  {"shape": "sphere", "radius": 0.5, "position": [0.3, 0.7, 0.3]},
                  {"shape": "sphere", "radius": 0.4, "position": [-0.3, 0.6, 0.4]}]}])",
        [](const glm::dvec3& p) {
            const double left = common_value(-ball_value(p, {0.3, 0.7, 0.3}, glm::dvec3(0.5)),
                                             -ball_value(p, {-0.3, 0.6, 0.4}, glm::dvec3(0.4)));
            return std::min(ring_value(p),
                            common_value(ball_value(p, glm::dvec3(0), {0.7, 0.9, 0.6}), left));
        }},
    CombinedSolid{
        "two bitten balls and a lens", R"("shape": "union", "parts": [
              {"shape": "difference", "position": [-0.3, 0, 0], "parts": [
                  {"shape": "sphere", "radius": 0.6},
                  {"shape": "sphere", "radius": 0.4, "position": [-0.1, 0.4, 0.35]}]},
              {"shape": "difference", "position": [0.4, 0.1, 0.1], "parts": [
                  {"shape": "sphere", "radius": 0.5},
                  {"shape": "sphere", "radius": 0.3, "position": [0.1, 0.3, 0.3]}]},
              {"shape": "intersection", "position": [0, -0.35, 0.4], "parts": [
                  {"shape": "sphere", "radius": 0.5, "position": [-0.2, 0, 0]},
                  {"shape": "sphere", "radius": 0.5, "position": [0.2, 0, 0]}]}])",
        [](const glm::dvec3& p) {
            const double left = bitten_value(ball_value(p, {-0.3, 0, 0}, glm::dvec3(0.6)),
                                             ball_value(p, {-0.4, 0.4, 0.35}, glm::dvec3(0.4)));
            const double right = bitten_value(ball_value(p, {0.4, 0.1, 0.1}, glm::dvec3(0.5)),
                                              ball_value(p, {0.5, 0.4, 0.4}, glm::dvec3(0.3)));
            const double lens = common_value(ball_value(p, {-0.2, -0.35, 0.4}, glm::dvec3(0.5)),
                                             ball_value(p, {0.2, -0.35, 0.4}, glm::dvec3(0.5)));
            return std::min({left, right, lens});
        }},
    CombinedSolid{
        "ball without two rings of bites", R"("shape": "difference", "parts": [
              {"shape": "union", "parts": [
                  {"shape": "difference", "parts": [
                      {"shape": "sphere", "radius": 0.9},
                      {"shape": "sphere", "radius": 0.5, "position": [0.2, 0.6, 0.5]}]},
                  {"shape": "sphere", "radius": 0.35, "position": [0.25, 0.5, 0.45]}]},
              {"shape": "difference", "position": [-0.5, 0.2, 0.6], "parts": [
                  {"shape": "sphere", "radius": 0.4},
                  {"shape": "union", "parts": [
                      {"shape": "sphere", "radius": 0.25, "position": [-0.05, 0, 0.1]},
                      {"shape": "difference", "parts": [
                          {"shape": "sphere", "radius": 0.2, "position": [0.2, 0.1, 0.1]},
                          {"shape": "sphere", "radius": 0.12, "position": [0.25, 0.15, 0.2]}]}]}]}])",
        [](const glm::dvec3& p) {
            const auto ball = [&](const glm::dvec3& centre, double radius) {
                return ball_value(p, centre, glm::dvec3(radius));
            };
            const double body = bitten_value(ball(glm::dvec3(0), 0.9), ball({0.2, 0.6, 0.5}, 0.5));
            const double kept =
                bitten_value(ball({-0.3, 0.3, 0.7}, 0.2), ball({-0.25, 0.35, 0.8}, 0.12));
            const double bite = bitten_value(ball({-0.5, 0.2, 0.6}, 0.4),
                                             std::min(ball({-0.55, 0.2, 0.7}, 0.25), kept));
            return bitten_value(std::min(body, ball({0.25, 0.5, 0.45}, 0.35)), bite);
        }}};

/// `cells`: the world's voxels along an axis.
std::string parts_scene(const CombinedSolid& parts, int cells, const char* placement) {
    return pair_scene(2.6 / cells,
                      fmt::format(R"("a": {{{}, "surface": "smooth", "resolution": {}}})",
                                  parts.keys, cells * 3 / 4),
                      fmt::format(R"({{"model": "a", "placement": "{}"}})", placement));
}

/// How far a picture's surface is from where its solid is, in voxels.
struct EdgeErrors {
    size_t shown = 0;  ///< pixels that show the solid, as they should
    size_t edge = 0;   ///< pixels beside an edge between two parts
    size_t wrong = 0;  ///< pixels that show the solid, or the ground behind it, and shouldn't
    double at_edge = 0, elsewhere = 0;  ///< RMS
};

/// What a ray meets by the solid's function.
struct SeenSolid {
    double t = INFINITY;
    glm::dvec3 normal{0};
    bool is_hit() const { return t < INFINITY; }
};

class SolidTruth {
  public:
    SolidTruth(const Observer& observer, ImplicitShape shape) : observer_(observer), shape_(shape) {
        for (int y = -1; y <= kPairSize.y; ++y)
            for (int x = -1; x <= kPairSize.x; ++x) seen_.push_back(trace(direction(x, y)));
    }

    glm::dvec3 direction(int x, int y) const { return direction_at(observer_, {x + 0.5, y + 0.5}); }
    const SeenSolid& at(int x, int y) const {
        return seen_[size_t(y + 1) * (kPairSize.x + 2) + size_t(x + 1)];
    }

    /// Whether a neighbour's surface is turned away from that at (x,y) by more than roundness does.
    bool is_at_edge(int x, int y) const {
        for (const glm::ivec2 step : {glm::ivec2(1, 0), {-1, 0}, {0, 1}, {0, -1}}) {
            const SeenSolid& beside = at(x + step.x, y + step.y);
            if (beside.is_hit() && glm::dot(beside.normal, at(x, y).normal) < 0.8) return true;
        }
        return false;
    }
    /// Whether the solid's outline, or that of a part before another, is within a pixel.
    bool is_at_outline(int x, int y) const {
        for (int j = -1; j <= 1; ++j)
            for (int i = -1; i <= 1; ++i)
                if (!(std::abs(at(x + i, y + j).t - at(x, y).t) < 0.15)) return true;
        return false;
    }

    /// How far a point that a pixel shows is from the surface, along its normal, in metres. The
    /// outlines of parts may be off by a tenth of a pixel.
    double distance(const glm::dvec3& point, const glm::dvec3& normal,
                    const glm::dvec2& pixel) const {
        constexpr double kNear = 0.005, kSlack = 0.1;  // metres, pixels
        double least = INFINITY;
        for (const glm::dvec2 step :
             {glm::dvec2(0), {kSlack, 0}, {-kSlack, 0}, {0, kSlack}, {0, -kSlack}}) {
            const glm::dvec3 d = direction_at(observer_, pixel + step);
            const double off = glm::dot(point - observer_.position, d) - trace(d).t;
            least = std::min(least, std::abs(off * glm::dot(normal, d)));
            if (least < kNear) break;
        }
        return least;
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

glm::dvec3 channel_vector(const Image& image, const char* name, size_t i) {
    const auto value = [&](const char* axis) {
        return double(image.planes.at(fmt::format("{}.{}", name, axis))[i]);
    };
    return {value("X"), value("Y"), value("Z")};
}

EdgeErrors edge_errors_of(const CombinedSolid& parts, int cells, const char* placement) {
    const Scene scene = parse_scene(parts_scene(parts, cells, placement), "parts.json", {});
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

constexpr int kLevels = 4;

/// A combination of balls and of combinations, of at most `levels` levels.
CombinedSolid random_combination(std::mt19937& random, int levels) {
    const auto in = [&](double low, double high) {
        return std::uniform_real_distribution<double>(low, high)(random);
    };
    if (levels == 0 || (levels < kLevels && random() % 4 == 0)) {
        const glm::dvec3 centre(in(-.35, .35), in(-.35, .35), in(-.35, .35));
        const double radius = in(.35, .7);
        return {"ball",
                fmt::format(R"("shape": "sphere", "radius": {}, "position": [{}, {}, {}])", radius,
                            centre.x, centre.y, centre.z),
                [=](const glm::dvec3& p) { return ball_value(p, centre, glm::dvec3(radius)); }};
    }
    static constexpr std::array kKinds = {"union", "intersection", "difference"};
    const size_t kind = random() % kKinds.size();
    std::vector<ImplicitShape> shapes;
    std::string keys;
    for (size_t i = 0, count = 2 + random() % 2; i < count; ++i) {
        const CombinedSolid part = random_combination(random, levels - 1);
        shapes.push_back(part.shape);
        keys += fmt::format("{}{{{}}}", i > 0 ? ", " : "", part.keys);
    }
    return {kKinds[kind], fmt::format(R"("shape": "{}", "parts": [{}])", kKinds[kind], keys),
            [=](const glm::dvec3& p) {
                double value = shapes[0](p);
                for (size_t i = 1; i < shapes.size(); ++i) {
                    const double next = shapes[i](p);
                    value = kind == 0   ? std::min(value, next)
                            : kind == 1 ? std::max(value, next)
                                        : std::max(value, -next);
                }
                return value;
            }};
}

TEST(SolidParts, OfAnyFormulaMeetInSharpEdges) {
    constexpr uint32_t kSeed = 15;
    std::mt19937 random(kSeed);
    size_t shown = 0;
    for (int i = 0; i < (is_exhaustive() ? 100 : 3); ++i) {
        const CombinedSolid solid = random_combination(random, kLevels);
        const EdgeErrors e = edge_errors_of(solid, 24, i % 2 == 0 ? "world" : "instance");
        const std::string what = fmt::format(
            "seed {}, solid {} ({}): {} pixels, {} at edges, rms {:.2e} voxel, "
            "elsewhere {:.2e}; {} wrong",
            kSeed, i, solid.keys, e.shown, e.edge, e.at_edge, e.elsewhere, e.wrong);
        EXPECT_EQ(e.wrong, 0u) << what;
        EXPECT_LT(e.at_edge, 0.1) << what;
        EXPECT_LT(e.elsewhere, 0.05) << what;
        shown += e.shown;
    }
    EXPECT_GT(shown, 1500u);
}

TEST(SolidParts, MeetInSharpEdges) {
    for (const CombinedSolid& parts : kCombinedSolids)
        for (const char* placement : {"world", "instance"})
            for (const int cells : {16, 32, 64, 128}) {
                if (cells > 32 && !is_exhaustive()) continue;
                const EdgeErrors e = edge_errors_of(parts, cells, placement);
                const std::string what = fmt::format(
                    "{} as {}, {} voxels: {} pixels at edges, rms {:.2e} voxel, elsewhere {:.2e}; "
                    "{} wrong",
                    parts.name, placement, cells, e.edge, e.at_edge, e.elsewhere, e.wrong);
                fmt::print("{}\n", what);
                EXPECT_GT(e.edge, parts.has_inner_edges ? 40u : 0u) << what;
                EXPECT_EQ(e.wrong, 0u) << what;
                EXPECT_LT(e.at_edge, 0.1) << what;
                EXPECT_LT(e.elsewhere, 0.05) << what;
            }
}

}  // namespace
}  // namespace voxelume
