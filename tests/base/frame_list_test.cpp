// SPDX-License-Identifier: Apache-2.0
#include "runtime/base/frame_list.hpp"

#include <gmock/gmock.h>

#include "runtime/base/error.hpp"

namespace voxelume {

using testing::ElementsAre;
using testing::HasSubstr;

namespace {

std::string complaint(const std::string& text) {
    try {
        parse_frame_list(text);
    } catch (const Error& error) {
        EXPECT_EQ(error.exit_code(), 2);
        return error.what();
    }
    return "";
}

}  // namespace

TEST(FrameList, NumbersRangesAndStepsKeepTheirOrder) {
    EXPECT_THAT(parse_frame_list("1-4,20,30-60x15"), ElementsAre(1, 2, 3, 4, 20, 30, 45, 60));
    EXPECT_THAT(parse_frame_list("20,1..3"), ElementsAre(20, 1, 2, 3));
    EXPECT_THAT(parse_frame_list("7"), ElementsAre(7));
}

TEST(FrameList, AStepThatDoesNotDivideEndsBeforeTheEnd) {
    EXPECT_THAT(parse_frame_list("1-10x4"), ElementsAre(1, 5, 9));
}

TEST(FrameList, NegativeFramesAreNumbers) {
    EXPECT_THAT(parse_frame_list("-2-1"), ElementsAre(-2, -1, 0, 1));
    EXPECT_THAT(parse_frame_list("-5..-3"), ElementsAre(-5, -4, -3));
    EXPECT_THAT(parse_frame_list("-5--3"), ElementsAre(-5, -4, -3));
}

TEST(FrameList, AFrameNamedTwiceIsThereOnce) {
    EXPECT_THAT(parse_frame_list("3,1-4"), ElementsAre(3, 1, 2, 4));
}

TEST(FrameList, TheLastIntIsAFrame) {
    EXPECT_THAT(parse_frame_list("2147483646-2147483647"), ElementsAre(2147483646, 2147483647));
}

TEST(FrameList, WhatCantBeReadIsQuoted) {
    EXPECT_THAT(complaint("1-10,a"), HasSubstr("can't read \"a\""));
    EXPECT_THAT(complaint(""), HasSubstr("can't read \"\""));
    EXPECT_THAT(complaint("1,,2"), HasSubstr("can't read \"\""));
    EXPECT_THAT(complaint("1-5x"), HasSubstr("can't read \"1-5x\""));
    EXPECT_THAT(complaint("10-1"), HasSubstr("write 1-10"));
    EXPECT_THAT(complaint("1-5x0"), HasSubstr("is zero"));
    EXPECT_THAT(complaint("99999999999"), HasSubstr("beyond"));
    EXPECT_THAT(complaint("1-2000000"), HasSubstr("more than 1000000"));
}

}  // namespace voxelume
