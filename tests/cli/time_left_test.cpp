// SPDX-License-Identifier: Apache-2.0
#include "cli/render/time_left.hpp"

#include <gtest/gtest.h>

namespace voxelume::cli {
namespace {

TEST(TimeLeft, OfOneImageIsMeasuredFromWhereItGetsOn) {
    TimeLeft left;
    EXPECT_FALSE(left.seconds());
    left.advance(30, 0.1);  // the world took half a minute
    EXPECT_FALSE(left.seconds());
    left.advance(32, 0.3);
    EXPECT_DOUBLE_EQ(left.seconds().value(), 7);
    left.advance(39, 1);
    EXPECT_EQ(left.seconds(), 0);
}

TEST(TimeLeft, CompilingIsToldApartAndForetellsNothing) {
    TimeLeft left;
    left.advance(1, 0.1);
    left.compiling(2);
    left.compiling(5);
    EXPECT_EQ(left.compile_seconds(), 0);
    EXPECT_EQ(left.compile_seconds(6), 4);
    left.advance(12, 0.3);
    EXPECT_EQ(left.compile_seconds(), 10);
    EXPECT_EQ(left.compile_seconds(20), 10);
    EXPECT_DOUBLE_EQ(left.seconds().value(), 3.5);  // a fifth took one second
    left.compiling(21);
    EXPECT_EQ(left.compile_seconds(23), 12);
}

TEST(TimeLeft, OfFramesIsUnknownBeforeTheFirstIsDone) {
    TimeLeft left(0.25);
    left.compiling(1);
    left.advance(11, 0.1);
    EXPECT_FALSE(left.seconds());
    left.advance(12, 0.25);
    EXPECT_DOUBLE_EQ(left.seconds().value(), 6);  // 2 s a frame, without compiling
}

TEST(TimeLeft, ATinyPartForetellsNothing) {
    TimeLeft left;
    left.advance(0, 0.01);
    left.advance(10, 0.02);
    EXPECT_FALSE(left.seconds());
    TimeLeft fast;
    fast.advance(0, 0);
    fast.advance(0.4, 0.5);
    EXPECT_FALSE(fast.seconds());
}

}  // namespace
}  // namespace voxelume::cli
