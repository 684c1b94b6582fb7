// SPDX-License-Identifier: Apache-2.0
// The moments that samples show while a shutter is open.
#include "runtime/scene/shutter.hpp"

#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "runtime/scene_file/read_scene.hpp"

namespace voxelume {
namespace {

using testing::ElementsAre;

/// A ball that moves from frame 1 to 3.
Scene open_scene(double shutter, int samples) {
    nlohmann::json text = nlohmann::json::parse(R"({"voxelume": 1,
"world": {"voxel_size": 0.5, "bounds": {"min": [-2, -2, -2], "max": [2, 2, 2]}},
"models": {"ball": {"shape": "sphere", "radius": 1}}, "objects": [{"name": "a", "model": "ball"}],
"observer": {"position": [0, 0, -9], "display": {"shape": "pyramid", "angle": 40}},
"animation": {"frames": 4, "tracks": [{"target": "objects.a.position",
    "keys": [{"frame": 1, "value": [0, 0, 0]}, {"frame": 3, "value": [1, 0, 0]}]}]}})");
    text["observer"]["shutter"] = shutter;
    text["render"]["samples"] = samples;
    return parse_scene(text.dump(), "s.json", {});
}

TEST(Shutter, SamplesHalveWhatOthersLeave) {
    const Scene scene = open_scene(0.5, 8);
    std::vector<double> moments;
    for (int sample = 0; sample < 8; ++sample) moments.push_back(moment_of(scene, 2, sample));
    EXPECT_THAT(moments, ElementsAre(2, 2.25, 2.125, 2.375, 2.0625, 2.3125, 2.1875, 2.4375));
    EXPECT_THAT(moments_of(scene, 2),
                ElementsAre(2, 2.0625, 2.125, 2.1875, 2.25, 2.3125, 2.375, 2.4375));
    EXPECT_THAT(some_moments_of(scene, 2), ElementsAre(2, 2.25, 2.4375));
}

TEST(Shutter, TheLastSampleOfThemAllIsBeforeItCloses) {
    EXPECT_LT(moment_of(open_scene(0.5, 4096), 1, 4095), 1.5);
    EXPECT_EQ(moment_of(open_scene(0.5, 4096), 1, 4095), 1.5 - 0.5 / 4096);
}

TEST(Shutter, OneMomentIsThatOfAllWhereNothingMovesOrSeveralAreNotSeen) {
    EXPECT_FALSE(has_moments(open_scene(0, 8)));
    EXPECT_FALSE(has_moments(open_scene(0.5, 1)));
    Scene volume = open_scene(0.5, 8);
    volume.render.shows_image = false;
    EXPECT_FALSE(has_moments(volume));
    EXPECT_THAT(moments_of(volume, 2), ElementsAre(2));
    EXPECT_FALSE(is_blurred(open_scene(0.5, 8), 3));
    EXPECT_TRUE(is_blurred(open_scene(0.5, 8), 2));
    EXPECT_EQ(worlds_of(open_scene(0, 8), 1), 1u);
    EXPECT_EQ(worlds_of(open_scene(0.5, 8), 1), 2u);
}

TEST(Shutter, SamplesInARowThatShowTheSameCount) {
    EXPECT_EQ(samples_at_once(open_scene(0.5, 8), 3), 8);
    EXPECT_EQ(samples_at_once(open_scene(0.5, 8), 2), 1);
    // From frame 2.75 on it stands from 3 on: three of four, those of numbers 1 to 3.
    EXPECT_EQ(samples_at_once(open_scene(1, 4), 2.75), 3);
}

}  // namespace
}  // namespace voxelume
