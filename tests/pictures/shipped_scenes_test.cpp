// SPDX-License-Identifier: Apache-2.0
// Every scene in scenes/, small and coarse, has its golden bits, and its file has only finite
// values.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "runtime/io/image/exr.hpp"
#include "runtime/render/renderer.hpp"
#include "tests/oracles/image_hash.hpp"
#include "tests/pictures/golden_hash.hpp"
#include "tests/pictures/small_scene.hpp"
#include "tests/support/file_fixture.hpp"
#include "tests/support/test_device.hpp"

namespace voxelume {
namespace {

constexpr double kMaxVoxels = 128;  // along an axis of the world

class ShippedScenes : public FileTest, public testing::WithParamInterface<std::string> {};

TEST_P(ShippedScenes, HaveTheirGoldenBitsAndOnlyFiniteValuesInTheFile) {
    const Scene scene = small_scene(GetParam(), {96, 72}, kMaxVoxels);
    RenderReport report;
    const Image rendered = render(test_device(), scene, report);
    EXPECT_EQ(report.not_finite, 0u);
    expect_golden(GetParam(), oracle::image_hash(rendered));
    write_exr(folder / "scene.exr", rendered);
    const Image image = read_exr(folder / "scene.exr");
    ASSERT_EQ(image.width, 96);
    ASSERT_EQ(image.height, 72);
    ASSERT_GE(image.planes.size(), 11u);
    for (const auto& [name, plane] : image.planes) {
        ASSERT_EQ(plane.size(), 96u * 72u) << name;
        size_t not_finite = 0;
        for (size_t i = 0; i < plane.size(); ++i) {
            const bool nothing_there =
                name == "Z" && plane[i] == INFINITY && image.id_planes.at("objectId")[i] == 0;
            not_finite += !std::isfinite(plane[i]) && !nothing_there;
        }
        EXPECT_EQ(not_finite, 0u) << name;
    }
    const Plane<float>& shown = image.planes.at("A");
    EXPECT_GT(std::ranges::count_if(shown, [](float a) { return a > 0; }), 500);
}

TEST(ShippedScenesList, IsThatOfTheFolder) {
    const std::vector<std::string> names = shipped_scenes();
    EXPECT_GE(names.size(), 6u);
    EXPECT_TRUE(std::ranges::count(names, "whitted"));
}

INSTANTIATE_TEST_SUITE_P(Scenes, ShippedScenes, testing::ValuesIn(shipped_scenes()),
                         [](const auto& name) {
                             std::string word = name.param;
                             std::ranges::replace_if(
                                 word, [](unsigned char c) { return !std::isalnum(c); }, '_');
                             return word;
                         });

}  // namespace
}  // namespace voxelume
