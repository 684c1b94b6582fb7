// SPDX-License-Identifier: Apache-2.0
// Smooth solids of random trees of balls against their functions.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <random>
#include <string>
#include <vector>

#include "tests/pictures/solids/solid_truth.hpp"
#include "tests/support/exhaustive.hpp"

namespace voxelume {
namespace {

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

}  // namespace
}  // namespace voxelume
