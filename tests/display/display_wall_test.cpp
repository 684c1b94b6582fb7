// SPDX-License-Identifier: Apache-2.0
// Surfaces along which views of a display lead are lit as what they are.
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <vector>

#include "runtime/image/volume_geometry.hpp"
#include "runtime/render/volume_renderer.hpp"
#include "tests/pictures/small_scene.hpp"
#include "tests/support/display_fixture.hpp"
#include "tests/support/test_device.hpp"

namespace voxelume {
namespace {

TEST(Walls, AreLitAsWallsWhereViewsLeadAlongThem) {
    RenderReport report;
    const Volume volume =
        render_volume(test_device(), small_scene("turntable", {32, 22}, 160), report);
    std::map<std::pair<int, int>, std::vector<float>> columns;  // of the plate's wall
    for (size_t i = 0; i < volume.indices.size(); ++i) {
        const glm::ivec3 cell = cell_of(volume.frame, volume.indices[i]);
        const glm::dvec3 seen = volume.frame.origin + volume.frame.edge * (glm::dvec3(cell) + 0.5);
        const glm::dvec3 p(volume.frame.world_from_observer * glm::dvec4(seen, 1));
        if (volume.objects[i] == 1 && p.y < 0.025 && std::hypot(p.x, p.z) > 0.715)
            columns[{cell.x, cell.z}].push_back(volume.colors[i].x);
    }
    ASSERT_GT(columns.size(), 200u);
    const auto uneven = std::ranges::count_if(columns, [](const auto& column) {
        const auto [low, high] = std::ranges::minmax(column.second);
        return high - low > 0.1f;
    });
    EXPECT_LT(uneven, 4);  // from above, 71 were lit as the plate's top is
}

/// A clear ball around the corner of eight voxels of a lattice.
Scene clear_ball(const std::string& keys) {
    return parsed(R"({"voxelume": 1,
"world": {"voxel_size": 0.05, "bounds": {"min": [-0.8, -0.8, -0.8], "max": [0.8, 0.8, 0.8]},
          "background": [0, 0, 0]},
"materials": {"clear": {"color": [0.4, 0.5, 0.6], "diffuse": 1, "opacity": 0.4}},
"models": {"ball": {"shape": "sphere", "radius": 0.5)" +
                  keys + R"(}},
"objects": [{"model": "ball", "material": "clear"}],
"lights": [{"type": "directional", "direction": [1, -2, 1]}],
"observer": {"position": [0, 0, -0.8], "look_at": [0, 0, 0],
             "display": {"shape": "box", "size": [1.6, 1.6, 1.6], "voxels": [32, 32, 32],
                         "layout": "lattice", "visibility": "outside"}}})");
}

// Where no ray along one view met the outline, the next view looked at the ball through its other
// side.
TEST(Outlines, OfClearBodiesOnTheLatticesPlanesAreLitFromTheirOwnSide) {
    const glm::dvec3 to_light = glm::normalize(glm::dvec3(-1, 2, -1));
    for (const char* keys : {"", R"(, "surface": "smooth")"}) {
        const Volume volume = volume_of(clear_ball(keys));
        ASSERT_GT(volume.indices.size(), 1500u);
        for (size_t i = 0; i < volume.indices.size(); ++i) {
            const glm::ivec3 cell = cell_of(volume.frame, volume.indices[i]);
            const glm::dvec3 seen =
                volume.frame.origin + volume.frame.edge * (glm::dvec3(cell) + 0.5);
            const glm::dvec3 p(volume.frame.world_from_observer * glm::dvec4(seen, 1));
            const double cosine = glm::dot(glm::normalize(p), to_light);
            if (cosine > 0.2) {
                EXPECT_GT(volume.colors[i].y, 0.02f) << keys << i;
            } else if (cosine < -0.2) {
                EXPECT_LT(volume.colors[i].y, 0.001f) << keys << i;
            }
        }
    }
}

}  // namespace
}  // namespace voxelume
