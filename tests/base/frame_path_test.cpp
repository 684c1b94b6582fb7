// SPDX-License-Identifier: Apache-2.0
#include "runtime/base/frame_path.hpp"

#include <gtest/gtest.h>

namespace voxelume {

TEST(FramePath, ARunOfHashesIsTheNumberWithZeros) {
    EXPECT_EQ(frame_path("out/frame.####.exr", 12, true), "out/frame.0012.exr");
    EXPECT_EQ(frame_path("##.exr", 7, true), "07.exr");
    EXPECT_EQ(frame_path("f#.exr", 123, true), "f123.exr");
    EXPECT_EQ(frame_path("f###", 5, false), "f005");
}

TEST(FramePath, OnlyTheLastRunOfTheNameCounts) {
    EXPECT_EQ(frame_path("take##/a#b###.png", 4, true), "take##/a#b004.png");
    EXPECT_EQ(frame_path("take##/a.png", 4, true), "take##/a0004.png");
}

TEST(FramePath, PrintfNumbersWorkToo) {
    EXPECT_EQ(frame_path("a%04d.exr", 12, true), "a0012.exr");
    EXPECT_EQ(frame_path("a%d.exr", 12, true), "a12.exr");
    EXPECT_EQ(frame_path("a%3d.exr", 12, true), "a 12.exr");
}

TEST(FramePath, NegativeFramesKeepTheirSignAndWidth) {
    EXPECT_EQ(frame_path("a####.exr", -12, true), "a-012.exr");
    EXPECT_EQ(frame_path("a%04d.exr", -12, true), "a-012.exr");
}

TEST(FramePath, WithoutAPlaceASingleFrameIsThePatternItself) {
    EXPECT_EQ(frame_path("out/bunny.exr", 12, false), "out/bunny.exr");
}

TEST(FramePath, WithoutAPlaceAnAnimationGetsFourDigitsBeforeTheExtension) {
    EXPECT_EQ(frame_path("out.d/bunny.exr", 12, true), "out.d/bunny0012.exr");
    EXPECT_EQ(frame_path("out.d/bunny", 12, true), "out.d/bunny0012");
    EXPECT_EQ(frame_path(".hidden", 12, true), ".hidden0012");
}

TEST(FramePath, ADotKeepsThemApartFromADigit) {
    EXPECT_EQ(frame_path("out.1/view-1.exr", 12, true), "out.1/view-1.0012.exr");
    EXPECT_EQ(frame_path("out.1/.exr", 12, true), "out.1/.exr0012");
    EXPECT_EQ(frame_path("take9", 12, true), "take9.0012");
    EXPECT_EQ(frame_path("view-1.exr", 12, false), "view-1.exr");
}

}  // namespace voxelume
