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

TEST(JsonText, IntegersAreTakenOnlyWhereTheirTypeHoldsThem) {
    EXPECT_EQ(json_integer<int>(parse_json_text<Json>("-2147483648")), -2147483648);
    EXPECT_EQ(json_integer<int>(parse_json_text<Json>("2147483647")), 2147483647);
    EXPECT_EQ(json_integer<uint64_t>(parse_json_text<Json>("18446744073709551615")),
              18446744073709551615u);
    for (const char* text : {"2147483648", "-2147483649", "18446744073709551615", "1.0", "8.9e100",
                             "-1e300", "true", "null", "\"1\"", "[1]", "{}"})
        EXPECT_THROW(json_integer<int>(parse_json_text<Json>(text)), Json::out_of_range) << text;
    for (const char* text : {"-1", "18446744073709551616", "1e3"})
        EXPECT_THROW(json_integer<uint64_t>(parse_json_text<Json>(text)), Json::out_of_range)
            << text;
}

}  // namespace
}  // namespace voxelume
