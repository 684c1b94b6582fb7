// SPDX-License-Identifier: Apache-2.0
// Smooth meshes that solids cut, against functions: edges of the cut are sharp.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "tests/pictures/solids/solid_truth.hpp"
#include "tests/support/file_fixture.hpp"
#include "tests/support/test_meshes.hpp"

namespace voxelume {
namespace {

class CutMeshes : public FileTest {};

TEST_F(CutMeshes, HaveSharpEdges) {
    write_obj(folder / "ball.obj", ball({0, 0, 0}, 0.9, 256, 128));
    const CombinedSolid bitten{
        "bitten mesh",
        R"("mesh": "ball.obj", "cut": [
              {"shape": "sphere", "radius": 0.5, "position": [0.3, 0.6, 0.5]},
              {"shape": "difference", "parts": [
                  {"shape": "sphere", "radius": 0.5, "position": [-0.3, 0.2, 0.8]},
                  {"shape": "sphere", "radius": 0.2, "position": [-0.4, 0.3, 0.7]}]}])",
        [](const glm::dvec3& p) {
            const double ring = bitten_value(ball_value(p, {-0.3, 0.2, 0.8}, glm::dvec3(0.5)),
                                             ball_value(p, {-0.4, 0.3, 0.7}, glm::dvec3(0.2)));
            return bitten_value(ball_value(p, glm::dvec3(0), glm::dvec3(0.9)),
                                std::min(ball_value(p, {0.3, 0.6, 0.5}, glm::dvec3(0.5)), ring));
        }};
    for (const char* placement : {"world", "instance"})
        for (const int cells : {16, 32}) {
            const EdgeErrors e = edge_errors_of(bitten, cells, placement, folder);
            const std::string what = fmt::format(
                "{} as {}, {} voxels: {} pixels at edges, rms {:.2e} voxel, elsewhere {:.2e}; {} "
                "wrong",
                bitten.name, placement, cells, e.edge, e.at_edge, e.elsewhere, e.wrong);
            fmt::print("{}\n", what);
            EXPECT_GT(e.edge, 40u) << what;
            EXPECT_EQ(e.wrong, 0u) << what;
            EXPECT_LT(e.at_edge, 0.05) << what;
            EXPECT_LT(e.elsewhere, 0.02) << what;
        }
}

}  // namespace
}  // namespace voxelume
