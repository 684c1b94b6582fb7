// SPDX-License-Identifier: Apache-2.0
#include "runtime/base/json_text.hpp"

#include <gtest/gtest.h>

#include <string>

namespace voxelume {
namespace {

using Json = nlohmann::json;

std::string nested(size_t levels, const std::string& open, const std::string& close) {
    std::string text;
    for (size_t i = 0; i < levels; ++i) text += open;
    text += "1";
    for (size_t i = 0; i < levels; ++i) text += close;
    return text;
}

TEST(JsonText, SixtyFourLevelsAreReadAndNoMore) {
    for (const auto& [open, close] : {std::pair("[", "]"), std::pair("{\"a\":", "}")}) {
        bool is_too_deep = false;
        EXPECT_EQ(parse_json_text<Json>(nested(64, open, close), &is_too_deep).dump(),
                  nested(64, open, close));
        EXPECT_FALSE(is_too_deep);
        EXPECT_TRUE(parse_json_text<Json>(nested(65, open, close), &is_too_deep).is_discarded());
        EXPECT_TRUE(is_too_deep);
        EXPECT_TRUE(parse_json_text<Json>(nested(300'000, open, close)).is_discarded());
        EXPECT_TRUE(parse_json_text<Json>(nested(300'000, open, "")).is_discarded());
    }
    EXPECT_EQ(parse_json_text<Json>("[[[1],[2]],{\"a\":[3]}]").dump(), "[[[1],[2]],{\"a\":[3]}]");
}

TEST(JsonText, WhatIsNoJsonIsDiscarded) {
    for (const char* text : {"", "{", "[1,]", "{} {}", "nul", "// a\n1"}) {
        bool is_too_deep = false;
        EXPECT_TRUE(parse_json_text<Json>(text, &is_too_deep).is_discarded()) << text;
        EXPECT_FALSE(is_too_deep) << text;
    }
    EXPECT_EQ(parse_json_text<Json>("// a\n1", nullptr, true), 1);
    EXPECT_TRUE(parse_json_text<Json>("null").is_null());
}

}  // namespace
}  // namespace voxelume
