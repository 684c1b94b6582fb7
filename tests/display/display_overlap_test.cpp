// SPDX-License-Identifier: Apache-2.0
// A display of smooth objects that lie in each other shows what that of exact ones shows.
#include <gtest/gtest.h>

#include <algorithm>
#include <iterator>

#include "runtime/render/volume_renderer.hpp"
#include "tests/support/display_fixture.hpp"
#include "tests/support/test_device.hpp"

namespace voxelume {
namespace {

/// `keys` are those of the display's layout.
Volume shown(const std::string& surface, const std::string& keys) {
    const Scene scene = parsed(fmt::format(R"({{"voxelume": 1,
        "world": {{"voxel_size": 0.03, "bounds": {{"min": [-1, -1, -1], "max": [1, 1, 1]}}}},
        "materials": {{"copper": {{"color": [0.8, 0.42, 0.22]}},
                      "film": {{"color": [0.5, 0.7, 1], "opacity": 0.25}}}},
        "models": {{"ring": {{"shape": "torus", "radius": 0.5, "tube": 0.15, "surface": "{0}"}},
                   "bubble": {{"shape": "sphere", "radius": 0.37, "surface": "{0}"}}}},
        "objects": [{{"model": "ring", "material": "copper", "turn": [30, 75, 0]}},
                    {{"model": "bubble", "material": "film", "position": [0.21, 0.31, -0.12]}}],
        "lights": [{{"type": "point", "position": [-1.6, 2.4, -1.8], "intensity": 14}}],
        "observer": {{"position": [0, 0, -3], "look_at": [0, 0, 0],
            "display": {{"shape": "box", "size": [2, 2, 2], "near": 2, {1},
                        "voxels": [67, 67, 67]}}}}}})",
                                           surface, keys));
    RenderReport report;
    Volume volume = render_volume(test_device(), scene, report);
    EXPECT_EQ(report.not_finite, 0u);
    return volume;
}

/// Rays of displays begin inside of objects. There a smooth surface that another one crosses may be
/// at a distance that rounds to zero, and the ray must not take it for the next one for ever.
TEST(DisplayOfOverlaps, ShowsSmoothObjectsWhereItShowsExactOnes) {
    for (const char* keys :
         {R"("layout": "rays")", R"("layout": "lattice", "visibility": "outside")"}) {
        SCOPED_TRACE(keys);
        const Volume smooth = shown("smooth", keys), exact = shown("exact", keys);
        ASSERT_GT(exact.indices.size(), 1000u);
        std::vector<uint64_t> both;
        std::ranges::set_intersection(smooth.indices, exact.indices, std::back_inserter(both));
        // The surfaces are a few hundredths of a voxel apart, which moves them into the next one.
        EXPECT_GT(double(both.size()), 0.97 * double(exact.indices.size()));
        EXPECT_GT(double(both.size()), 0.97 * double(smooth.indices.size()));
    }
}

}  // namespace
}  // namespace voxelume
