// SPDX-License-Identifier: Apache-2.0
// Walls along which views of a display lead are lit as walls.
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <vector>

#include "runtime/image/volume_geometry.hpp"
#include "runtime/render/volume_renderer.hpp"
#include "tests/pictures/small_scene.hpp"
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

}  // namespace
}  // namespace voxelume
