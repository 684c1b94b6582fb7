// SPDX-License-Identifier: Apache-2.0
#include "runtime/image/image_difference.hpp"

#include <gmock/gmock.h>

#include <limits>

#include "runtime/base/error.hpp"

namespace voxelume {

namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();
constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

ChannelDifference difference_of(const std::vector<float>& a, const std::vector<float>& b) {
    const int width = static_cast<int>(a.size());
    return compare_images({width, 1, {{"Z", a}}, {}, {}}, {width, 1, {{"Z", b}}, {}, {}})
        .channels.at(0);
}

}  // namespace

TEST(ImageDifference, MatchesErrorsComputedByHand) {
    const ChannelDifference d = difference_of({1.0f, 3.0f, 5.0f, 0.0f}, {1.0f, 0.99f, 1.0f, 0.0f});
    EXPECT_EQ(d.channel, "Z");
    EXPECT_EQ(d.largest, 4.0);
    EXPECT_NEAR(d.rmse, 2.2383095, 1e-6);  // sqrt((2.01² + 4²) / 4)
    EXPECT_NEAR(d.mae, 1.5025, 1e-6);      // (2.01 + 4) / 4
    EXPECT_NEAR(d.mrse, 4.931209, 1e-5);   // (2.01² + (4 / 1.01)²) / 4
    EXPECT_EQ(d.differing, 2u);
    EXPECT_EQ(d.unmatched, 0u);
}

TEST(ImageDifference, EqualInfinitiesAndNansDoNotDiffer) {
    const ChannelDifference d = difference_of({kInfinity, kNan, -0.0f}, {kInfinity, kNan, 0.0f});
    EXPECT_EQ(d.differing, 0u);
    EXPECT_EQ(d.unmatched, 0u);
    EXPECT_EQ(d.rmse, 0.0);
}

TEST(ImageDifference, AHitAgainstAMissIsUnmatchedAndNotInTheErrors) {
    const ChannelDifference d =
        difference_of({kInfinity, 2.0f, kNan, -kInfinity}, {3.0f, 2.5f, 1.0f, kInfinity});
    EXPECT_EQ(d.unmatched, 3u);
    EXPECT_EQ(d.differing, 4u);
    EXPECT_EQ(d.rmse, 0.5);
}

TEST(ImageDifference, IdsAreOnlyCounted) {
    const Image a{3, 1, {}, {{"objectId", {1, 2, 3}}}, {}};
    const Image b{3, 1, {}, {{"objectId", {1, 4000000000u, 4}}}, {}};
    const ChannelDifference d = compare_images(a, b).channels.at(0);
    EXPECT_EQ(d.differing, 2u);
    EXPECT_EQ(d.largest, 0.0);
}

TEST(ImageDifference, IdsOfCryptomatteAreOnlyCountedToo) {
    const auto image = [](float id) {
        Image made{2, 1, {}, {}, {}};
        made.planes["Matte.R"] = made.planes["Matte00.R"] = std::vector<float>{id, 2};
        made.planes["Matte00.G"] = std::vector<float>{0.5f, 1};
        made.attributes["cryptomatte/1234567/name"] = "Matte";
        return made;
    };
    const ImageDifference d = compare_images(image(1e30f), image(1e-30f));
    ASSERT_EQ(d.channels.size(), 3u);
    EXPECT_GT(d.channels[0].rmse, 1e29);  // Matte.R is a picture for people
    EXPECT_EQ(d.channels[1].channel, "Matte00.G");
    EXPECT_EQ(d.channels[1].differing, 0u);
    EXPECT_EQ(d.channels[2].channel, "Matte00.R");
    EXPECT_EQ(d.channels[2].rmse, 0);
    EXPECT_EQ(d.channels[2].differing, 1u);
    EXPECT_EQ(d.channels[2].above, 1u);
    EXPECT_EQ(difference_image(image(1e30f), image(1e-30f)).planes.at("Matte00.R")[0], 1.0f);
}

TEST(ImageDifference, PixelsAboveAThresholdAreCountedOnceAcrossChannels) {
    const Image a{4, 1, {{"R", {0, 0.5f, 0.25f, kNan}}, {"Z", {1, 1, 1, 1}}}, {}, {}};
    const Image b{4, 1, {{"R", {0, 0.75f, 1.25f, 2}}, {"Z", {1, 3, 1.25f, 1}}}, {}, {}};
    const auto above = [&](double threshold, const std::vector<std::string>& channels) {
        const ImageDifference d = compare_images(a, b, {channels, threshold});
        std::vector<uint64_t> counts{d.above};
        for (const ChannelDifference& channel : d.channels) counts.push_back(channel.above);
        return counts;
    };
    using Counts = std::vector<uint64_t>;
    EXPECT_EQ(above(0, {}), (Counts{3, 3, 2}));
    EXPECT_EQ(above(0.25, {}), (Counts{3, 2, 1}));  // 0.25 itself isn't above
    EXPECT_EQ(above(1, {}), (Counts{2, 1, 1}));
    EXPECT_EQ(above(9, {}), (Counts{1, 1, 0}));  // what isn't finite is above everything
    EXPECT_EQ(above(0.25, {"Z"}), (Counts{1, 1}));
    EXPECT_EQ(compare_images(a, b).pixels, 4u);
    EXPECT_THROW(compare_images(a, b, {{"z"}, 0}), Error);
}

TEST(ImageDifference, ItsPictureHasDistancesAndMarks) {
    const Image a{
        3, 1, {{"R", {1, 0.25f, kInfinity}}, {"A", {1, 1, 1}}}, {{"objectId", {1, 2, 3}}}, {}};
    const Image b{3, 1, {{"R", {1, 0.75f, 2}}, {"Z", {1, 1, 1}}}, {{"objectId", {1, 7, 3}}}, {}};
    const Image picture = difference_image(a, b);
    ASSERT_EQ(picture.planes.size(), 2u);
    EXPECT_EQ(picture.planes.at("R"), (Plane<float>{0, 0.5f, 65504}));
    EXPECT_EQ(picture.planes.at("objectId"), (Plane<float>{0, 1, 0}));
    EXPECT_TRUE(picture.id_planes.empty());
}

TEST(ImageDifference, ChannelsOfOneImageAreNamed) {
    const Image a{1, 1, {{"R", {1}}, {"A", {1}}}, {}, {}};
    const Image b{1, 1, {{"R", {1}}, {"Z", {1}}}, {{"objectId", {1}}}, {}};
    const ImageDifference d = compare_images(a, b);
    EXPECT_EQ(d.channels.size(), 1u);
    EXPECT_THAT(d.only_in_a, testing::ElementsAre("A"));
    EXPECT_THAT(d.only_in_b, testing::ElementsAre("Z", "objectId"));
}

}  // namespace voxelume
