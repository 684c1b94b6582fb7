// SPDX-License-Identifier: Apache-2.0
// The matrices that turn gradients in the world's voxels into those in the voxels that soft cubes
// were resampled from: hand-computed.
#include "runtime/analysis/cube_steps.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <string>

#include "runtime/analysis/object_boxes.hpp"
#include "runtime/scene_file/read_scene.hpp"

namespace voxelume {
namespace {

/// The steps of a box in a world of voxels of 0.1 x 0.1 x 0.2 m, behind an object without any.
std::vector<float> steps_of_box(const std::string& voxel_size, const std::string& object,
                                const std::string& normals = "surface") {
    const Scene scene = parse_scene(fmt::format(R"({{"voxelume": 1,
"world": {{"voxel_size": [0.1, 0.1, 0.2], "bounds": {{"min": [-2, -2, -2], "max": [2, 2, 2]}}}},
"models": {{"plain": {{"shape": "sphere", "radius": 0.4, "surface": "cubes"}},
           "soft": {{"shape": "box", "size": [0.7, 0.5, 0.9], "surface": "cubes",
                    "voxel_size": {}, "normals": "{}"}}}},
"objects": [{{"model": "plain", "turn": [20, 0, 0]}}, {{"model": "soft", {}}}],
"observer": {{"position": [0, 0, 5], "display": {{"shape": "pyramid"}}}}}})",
                                                voxel_size, normals, object),
                                    "steps.json", {});
    AssetStore meshes;
    return cube_steps(scene, meshes, object_boxes(scene, meshes));
}

TEST(CubeSteps, AreNoneWhereEachVoxelOfTheWorldIsOneOfTheModel) {
    const std::string as_world = "[0.1, 0.1, 0.2]";
    EXPECT_TRUE(steps_of_box(as_world, R"("placement": "world")").empty());
    EXPECT_TRUE(
        steps_of_box(as_world, R"("placement": "world", "position": [0.03, 0, 0.1])").empty());
    EXPECT_TRUE(steps_of_box(as_world, R"("placement": "world", "turn": [0, 0, 90])").empty());
    EXPECT_TRUE(steps_of_box(as_world, R"("placement": "world", "scale": [-1, 1, 1])").empty());
    const std::string turned = R"("placement": "world", "turn": [30, 0, 0])";
    EXPECT_TRUE(steps_of_box(as_world, turned, "faces").empty());
    EXPECT_TRUE(steps_of_box(as_world, R"("placement": "instance", "turn": [30, 0, 0])").empty());
    EXPECT_FALSE(steps_of_box(as_world, turned).empty());
}

/// One of the model's voxels along its x lies along 3 of the world's, a gradient in which is a
/// third of that in the model's.
TEST(CubeSteps, GrowWithTheModelsVoxels) {
    const std::vector<float> steps =
        steps_of_box("[0.3, 0.05, 0.2]", R"("placement": "world", "position": [0.2, 0, 0])");
    ASSERT_EQ(steps.size(), 18u);
    const std::vector<float> expected = {0, 0, 0, 0, 0, 0, 0, 0, 0, 3, 0, 0, 0, 0.5f, 0, 0, 0, 1};
    for (size_t i = 0; i < steps.size(); ++i) EXPECT_NEAR(steps[i], expected[i], 1e-6) << i;
}

/// Turned about z by 90 degrees, the model's x is the world's y, and its y the world's -x.
TEST(CubeSteps, FollowTheObjectsMap) {
    const std::vector<float> steps =
        steps_of_box("[0.3, 0.05, 0.2]", R"("placement": "world", "turn": [0, 0, 90], "scale": 2)");
    ASSERT_EQ(steps.size(), 18u);
    const std::vector<float> expected = {0, 6, 0, -1, 0, 0, 0, 0, 2};
    for (size_t i = 0; i < 9; ++i) EXPECT_NEAR(steps[9 + i], expected[i], 1e-6) << i;
}

}  // namespace
}  // namespace voxelume
