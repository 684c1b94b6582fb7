// SPDX-License-Identifier: Apache-2.0
// A display of smooth objects that lie in each other shows what that of exact ones shows.
#include <gtest/gtest.h>

#include <set>

#include "runtime/render/volume_renderer.hpp"
#include "tests/pictures/small_scene.hpp"
#include "tests/support/test_device.hpp"

namespace voxelume {
namespace {

/// The volume that the display of a turntable shows, where all objects have this surface.
Volume shown(Surface surface) {
    Scene scene = small_scene("turntable", {96, 72}, 80);
    scene.observer.display.voxels =
        is_exhaustive() ? glm::ivec3(64, 44, 64) : glm::ivec3(40, 28, 40);
    for (Model& model : scene.models) model.surface = surface;
    for (Object& object : scene.objects) object.placement = Placement::world;
    RenderReport report;
    Volume volume = render_volume(test_device(), scene, report);
    EXPECT_EQ(report.not_finite, 0u);
    return volume;
}

/// The number of a volume's voxels that have no voxel of the other volume around them.
size_t count_lonely(const Volume& volume, const Volume& other) {
    const glm::ivec3& size = volume.frame.size;
    const std::set<uint64_t> shown(other.indices.begin(), other.indices.end());
    size_t lonely = 0;
    for (const uint64_t index : volume.indices) {
        bool has_neighbor = false;
        for (int i = 0; i < 27; ++i) {
            const int64_t step =
                i % 3 - 1 + int64_t(size.x) * (i / 3 % 3 - 1 + int64_t(size.y) * (i / 9 - 1));
            has_neighbor |= shown.contains(index + uint64_t(step));
        }
        lonely += !has_neighbor;
    }
    return lonely;
}

/// Rays of displays begin inside of objects. There a smooth surface that another one crosses may be
/// at a distance that rounds to zero, and a ray must not go in and out of both without end.
TEST(DisplayOfOverlaps, ShowsSmoothObjectsWhereItShowsExactOnes) {
    const Volume smooth = shown(Surface::smooth), exact = shown(Surface::exact);
    ASSERT_GT(exact.indices.size(), 1000u);
    // Smooth edges are rounded by a voxel.
    EXPECT_LT(count_lonely(smooth, exact), smooth.indices.size() / 200);
    EXPECT_LT(count_lonely(exact, smooth), exact.indices.size() / 200);
}

}  // namespace
}  // namespace voxelume
