// SPDX-License-Identifier: Apache-2.0
// The image of an absorbing pool whose water is cut by the world's sides, against an analytic
// tracer.
#include "runtime/scene_file/read_scene.hpp"
#include "tests/pictures/analytic_image_scenes.hpp"
#include "tests/support/analytic_comparison.hpp"

namespace voxelume {
namespace {

TEST(ObserverInMediumImage, WaterThatRaysBeginInAbsorbsFromTheirStartOn) {
    Scene scene = parse_scene(kPoolScene, "test.json", {});
    resize(scene, {172, 133});
    expect_analytic_image(scene, 1e-5, 1e-3);
}

}  // namespace
}  // namespace voxelume
