// SPDX-License-Identifier: Apache-2.0
// Radiance's pictures, made byte by byte, and what is refused of damaged ones.
#include "runtime/io/image/radiance_picture.hpp"

#include <gmock/gmock.h>

#include <string>

#include "runtime/io/image/sky_picture.hpp"
#include "tests/support/file_fixture.hpp"

namespace voxelume {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

constexpr const char* kHead = "#?RADIANCE\n# made by hand\nFORMAT=32-bit_rle_rgbe\n\n";

std::span<const uint8_t> bytes_in(const std::string& text) {
    return {reinterpret_cast<const uint8_t*>(text.data()), text.size()};
}

ColorPicture parsed(const std::string& text) {
    return parse_radiance(bytes_in(text), "sky.hdr", 1000);
}

std::string radiance_objection(const std::string& text) {
    return error_of([&] { parsed(text); }).what();
}

std::string bytes(std::initializer_list<int> values) {
    std::string text;
    for (const int value : values) text += char(value);
    return text;
}

TEST(RadiancePicture, HasMantissasTimesPowersOfTwo) {
    const ColorPicture picture = parsed(kHead + std::string("-Y 1 +X 3\n") +
                                        bytes({128, 64, 0, 129, 255, 1, 2, 136, 9, 9, 9, 0}));
    EXPECT_EQ(picture.width, 3);
    EXPECT_EQ(picture.height, 1);
    EXPECT_THAT(picture.values, ElementsAre(1.0f, 0.5f, 0.0f, 255.0f, 1.0f, 2.0f, 0, 0, 0));
}

TEST(RadiancePicture, HasOldRunsOfWholePixels) {
    const ColorPicture picture =
        parsed(kHead + std::string("-Y 1 +X 5\n") + bytes({2, 3, 4, 136, 1, 1, 1, 4}));
    EXPECT_THAT(picture.values, ElementsAre(2, 3, 4, 2, 3, 4, 2, 3, 4, 2, 3, 4, 2, 3, 4));
    // The second of two lengths counts 256 fold.
    const ColorPicture longer = parsed(kHead + std::string("-Y 1 +X 260\n") +
                                       bytes({2, 3, 4, 136, 1, 1, 1, 3, 1, 1, 1, 1}));
    EXPECT_EQ(longer.values.size(), 780u);
    EXPECT_EQ(longer.values.back(), 4);
}

TEST(RadiancePicture, HasNewRunsInFourPlanes) {
    const std::string row = bytes({2,   2,  0, 8,                   //
                                   136, 7,                          // eight of 7
                                   4,   1,  2, 3, 4, 132, 9,        // four others, four of 9
                                   130, 5,  6, 1, 2, 3,   4, 5, 6,  //
                                   136, 136});
    const ColorPicture picture = parsed(kHead + std::string("+Y 2 +X 8\n") + row + row);
    for (const size_t at : {size_t{0}, size_t{24}}) {
        EXPECT_EQ(picture.values[at], 7);
        EXPECT_EQ(picture.values[at + 1], 1);
        EXPECT_EQ(picture.values[at + 2], 5);
        EXPECT_EQ(picture.values[at + 21], 7);
        EXPECT_EQ(picture.values[at + 22], 9);
        EXPECT_EQ(picture.values[at + 23], 6);
    }
}

TEST(RadiancePicture, WithRowsFromBelowIsTurnedOver) {
    const ColorPicture picture =
        parsed(kHead + std::string("+Y 2 +X 1\n") + bytes({1, 0, 0, 136, 2, 0, 0, 136}));
    EXPECT_THAT(picture.values, ElementsAre(2, 0, 0, 1, 0, 0));
}

TEST(RadiancePicture, IsRefusedWithASentenceWhereDamaged) {
    EXPECT_THAT(radiance_objection("P6\n"), HasSubstr("sky.hdr: not a Radiance picture"));
    EXPECT_THAT(radiance_objection("#?RADIANCE\n"), HasSubstr("a line of its header"));
    EXPECT_THAT(radiance_objection(kHead + std::string("-X 4 +Y 2\n")),
                HasSubstr("from left to right"));
    EXPECT_THAT(radiance_objection("#?RGBE\nFORMAT=32-bit_rle_xyze\n\n-Y 1 +X 1\n"),
                HasSubstr("other colours"));
    EXPECT_THAT(radiance_objection(kHead + std::string("-Y 1000 +X 1000\n")),
                HasSubstr("at most 1000"));
    EXPECT_THAT(radiance_objection(kHead + std::string("-Y 20 +X 20\n") + "x"),
                HasSubstr("far too small"));
    EXPECT_THAT(radiance_objection(kHead + std::string("-Y 1 +X 3\n") + bytes({1, 2, 3, 4})),
                HasSubstr("truncated"));
    EXPECT_THAT(
        radiance_objection(kHead + std::string("-Y 1 +X 3\n") + bytes({2, 2, 2, 130, 1, 1, 1, 3})),
        HasSubstr("doesn't fit"));
    EXPECT_THAT(
        radiance_objection(kHead + std::string("-Y 1 +X 8\n") + bytes({2, 2, 0, 9, 0, 0, 0, 0})),
        HasSubstr("another length"));
    EXPECT_THAT(
        radiance_objection(kHead + std::string("-Y 1 +X 8\n") + bytes({2, 2, 0, 8, 137, 5, 0})),
        HasSubstr("doesn't fit"));
}

class SkyPicture : public FileTest {};

TEST_F(SkyPicture, OfAnotherEndingIsRefused) {
    put_bytes(folder / "sky.tif", "II*");
    EXPECT_THAT(error_of([&] { read_sky_picture(folder / "sky.tif", 10); }).what(),
                HasSubstr(".exr, .hdr or .png"));
}

TEST_F(SkyPicture, HasItsSizeInTheHeader) {
    put_bytes(folder / "sky.hdr", kHead + std::string("-Y 30 +X 60\n"));
    EXPECT_EQ(sky_picture_size(folder / "sky.hdr", 1800), glm::ivec2(60, 30));
    EXPECT_THAT(error_of([&] { sky_picture_size(folder / "sky.hdr", 1799); }).what(),
                HasSubstr("60 x 30 pixels"));
}

}  // namespace
}  // namespace voxelume
