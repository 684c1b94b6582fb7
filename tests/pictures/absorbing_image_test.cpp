// SPDX-License-Identifier: Apache-2.0
// Images of absorbing objects in an absorbing medium against an analytic tracer.
#include "runtime/scene_file/read_scene.hpp"
#include "tests/pictures/analytic_image_scenes.hpp"
#include "tests/support/analytic_comparison.hpp"

namespace voxelume {
namespace {

Scene absorbing_scene(const char* text) {
    Scene scene = parse_scene(text, "test.json", {});
    resize(scene, {172, 133});
    return scene;
}

TEST(AbsorbingImage, NestedDielectricsInAMedium) {
    expect_analytic_image(absorbing_scene(kNestedScene), 1e-5, 1e-3);
}

TEST(AbsorbingImage, VeilsAndFilteredShadowsInAMedium) {
    expect_analytic_image(absorbing_scene(kVeiledScene), 1e-5, 1e-3);
}

TEST(AbsorbingImage, AMediumWhoseDensityIsAskedForVoxelByVoxel) {
    Scene scene = absorbing_scene(kVeiledScene);
    if (!is_exhaustive()) resize(scene, {115, 89});
    Scene asked = scene;
    asked.world.medium.density = BallDensity{{0, 0, 0}, 1000, 0};
    expect_image(asked, oracle::analytic_image(scene), 1e-5, 1e-3);
}

}  // namespace
}  // namespace voxelume
