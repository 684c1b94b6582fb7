// SPDX-License-Identifier: Apache-2.0
// Faces that lie in the border between blocks of a checker.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "runtime/render/renderer.hpp"
#include "runtime/scene_file/read_scene.hpp"
#include "tests/support/shared_device.hpp"

namespace voxelume {
namespace {

// Rounding put each pixel's place above or below the border, and the floor was noise.
TEST(CheckerBorder, AFaceInItShowsTheUpperBlocks) {
    for (const char* placement : {"world", "instance"}) {
        const Scene scene = parse_scene(fmt::format(R"({{"voxelume": 1,
"world": {{"voxel_size": 0.05, "bounds": {{"min": [-2, -0.3, -2], "max": [2, 1, 2]}},
          "ambient": [1, 1, 1]}},
"models": {{"floor": {{"shape": "box", "size": [3.7, 0.2, 3.7]}}}},
"materials": {{"tiles": {{"color": [0.9, 0.9, 0.9],
                        "checker": {{"color": [0.1, 0.1, 0.4], "size": 0.5}}}}}},
"objects": [{{"model": "floor", "material": "tiles", "position": [0, -0.1, 0],
             "placement": "{}"}}],
"lights": [],
"observer": {{"position": [0.5, 1.2, 3], "look_at": [0, 0, 0],
             "display": {{"shape": "pyramid", "angle": 50}}}},
"render": {{"size": [80, 60]}}}})",
                                                    placement),
                                        "floor.json", {});
        RenderReport report;
        const Image image = render(shared_device(), scene, report);
        size_t seen = 0, wrong = 0;
        for (size_t i = 0; i < image.planes.at("R").size(); ++i) {
            if (image.id_planes.at("objectId")[i] == 0 || image.planes.at("N.Y")[i] < 0.9f)
                continue;
            const double x = double(image.planes.at("P.X")[i]) / 0.5;
            const double z = double(image.planes.at("P.Z")[i]) / 0.5;
            if (std::abs(x - std::round(x)) < 1e-3 || std::abs(z - std::round(z)) < 1e-3) continue;
            const bool is_second = std::llround(std::floor(x) + std::floor(z)) % 2 != 0;
            ++seen;
            wrong += is_second != (image.planes.at("R")[i] < 0.5f);
        }
        EXPECT_GT(seen, 2000u);
        EXPECT_EQ(wrong, 0u) << placement;
    }
}

}  // namespace
}  // namespace voxelume
