// SPDX-License-Identifier: Apache-2.0
// Smooth unions, intersections and differences against the analytic tracer: edges between their
// parts are as sharp as their voxels let them be.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <vector>

#include "tests/pictures/solids/solid_truth.hpp"
#include "tests/support/exhaustive.hpp"

namespace voxelume {
namespace {

double ring_value(const glm::dvec3& p) {
    return std::hypot(std::hypot(p.x, p.z) - 0.7, p.y) - 0.2;
}

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

TEST(SolidParts, MeetInSharpEdges) {
    for (size_t i = 0; i < kCombinedSolids.size(); ++i)
        for (const char* placement : in_turn<const char*>({"world", "instance"}, i % 2))
            for (const int cells : in_turn<int>({16, 32, 64, 128}, i / 2 % 2)) {
                const CombinedSolid& parts = kCombinedSolids[i];
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
