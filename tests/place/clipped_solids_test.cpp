// SPDX-License-Identifier: Apache-2.0
// Exact solids that reach past the world's bounds look solid: the bounds cut them, and the cut is
// surface.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <glm/geometric.hpp>
#include <glm/vector_relational.hpp>
#include <string>

#include "runtime/render/renderer.hpp"
#include "runtime/scene_file/read_scene.hpp"
#include "tests/support/shared_device.hpp"

namespace voxelume {
namespace {

/// A solid in the world, and the same as a formula: points in it.
struct ClippedCase {
    const char* name;
    const char* model;
    const char* object;
    std::function<bool(const glm::dvec3&)> holds;
};

constexpr glm::dvec3 kWorldLow{-0.7, -0.5, -0.6}, kWorldHigh{0.7, 0.5, 0.6};

const std::array kClippedCases = {
    ClippedCase{"slab", R"("shape": "slab", "thickness": 0.37)", R"("position": [0, -0.2, 0])",
                [](const glm::dvec3& p) { return std::abs(p.y + 0.2) < 0.185; }},
    ClippedCase{"turned slab", R"("shape": "slab", "thickness": 0.37)", R"("turn": [0, 0, 30])",
                [](const glm::dvec3& p) {
                    const double at = M_PI / 6;
                    return std::abs(p.y * std::cos(at) - p.x * std::sin(at)) < 0.185;
                }},
    ClippedCase{
        "ball", R"("shape": "sphere", "radius": 0.5)", R"("position": [0.55, 0.31, -0.42])",
        [](const glm::dvec3& p) { return glm::length(p - glm::dvec3(0.55, 0.31, -0.42)) < 0.5; }},
    ClippedCase{"box with a hole",
                R"("shape": "difference", "parts": [{"shape": "box", "size": [2, 0.6, 0.7]},
 {"shape": "cylinder", "radius": 0.21, "height": 3, "turn": [0, 0, 90]}])",
                "\"position\": [0, 0, 0]", [](const glm::dvec3& p) {
                    return std::abs(p.y) < 0.3 && std::abs(p.z) < 0.35 &&
                           std::hypot(p.y, p.z) > 0.21;
                }}};

constexpr int kClippedPixels = 64;
constexpr glm::dvec3 kClippedEye{1.9, 1.4, -2.3};

Image clipped_picture(const ClippedCase& c) {
    RenderReport report;
    Scene scene = parse_scene(fmt::format(R"({{"voxelume": 1,
"world": {{"voxel_size": 0.05, "bounds": {{"min": [-0.7, -0.5, -0.6], "max": [0.7, 0.5, 0.6]}}}},
"materials": {{"m": {{"color": [1, 1, 1]}}}},
"models": {{"s": {{{}, "surface": "exact"}}}},
"objects": [{{"model": "s", "material": "m", {}}}],
"observer": {{"position": [1.9, 1.4, -2.3], "look_at": [0, 0, 0],
 "display": {{"shape": "pyramid", "angles": [40, 40]}}}},
"render": {{"size": [{}, {}], "samples": 1}}}})",
                                          c.model, c.object, kClippedPixels, kClippedPixels),
                              "test.json", {});
    scene.render.channels.distance = true;
    return render(shared_device(), scene, report);
}

/// The first point on a ray that is in the solid and in the world; 0 for none.
double first_clipped(const ClippedCase& c, const glm::dvec3& way) {
    constexpr double kStep = 1.0 / 512;
    const auto inside = [&](double t) {
        const glm::dvec3 p = kClippedEye + way * t;
        return glm::all(glm::greaterThan(p, kWorldLow)) && glm::all(glm::lessThan(p, kWorldHigh)) &&
               c.holds(p);
    };
    for (double t = 1.5; t < 5; t += kStep) {
        if (!inside(t)) continue;
        double before = t - kStep, behind = t;
        for (int i = 0; i < 30; ++i) {
            const double middle = 0.5 * (before + behind);
            (inside(middle) ? behind : before) = middle;
        }
        return behind;
    }
    return 0;
}

TEST(ClippedSolids, LookSolidWhereTheWorldEnds) {
    const glm::dvec3 ahead = glm::normalize(-kClippedEye);
    const glm::dvec3 right = glm::normalize(glm::cross(ahead, glm::dvec3(0, 1, 0)));
    const glm::dvec3 up = glm::cross(right, ahead);
    const double slope = std::tan(20 * M_PI / 180);
    for (const ClippedCase& c : kClippedCases) {
        const Image image = clipped_picture(c);
        int wrong = 0, met = 0;
        double largest = 0;
        for (int v = 0; v < kClippedPixels; ++v)
            for (int u = 0; u < kClippedPixels; ++u) {
                const double x = slope * (2.0 * u + 1 - kClippedPixels) / kClippedPixels;
                const double y = slope * (kClippedPixels - 2.0 * v - 1) / kClippedPixels;
                const glm::dvec3 way = glm::normalize(ahead + right * x + up * y);
                const double expected = first_clipped(c, way);
                const double alpha = double(image.planes.at("A")[size_t(v * kClippedPixels + u)]);
                wrong += (alpha > 0) != (expected > 0);
                if (!(alpha > 0) || !(expected > 0)) continue;
                ++met;
                const auto distance =
                    double(image.planes.at("distance")[size_t(v * kClippedPixels + u)]);
                largest = std::max(largest, std::abs(distance - expected));
            }
        SCOPED_TRACE(
            fmt::format("{}: {} wrong of {}, off by {:.2e} m", c.name, wrong, met, largest));
        EXPECT_GT(met, 400);
        EXPECT_LE(wrong, 3);  // where a ray is in the solid for less than the oracle's step
        EXPECT_LT(largest, 2e-5);
    }
}

}  // namespace
}  // namespace voxelume
