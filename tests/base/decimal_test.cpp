// SPDX-License-Identifier: Apache-2.0
#include "runtime/base/decimal.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <random>
#include <string>

namespace voxelume {
namespace {

uint32_t bits(float value) {
    return std::bit_cast<uint32_t>(value);
}

/// Expects the result of the C library's strtof, which is the oracle: glibc rounds it correctly.
void expect_like_strtof(const std::string& text) {
    const Decimal decimal = scan_decimal(text.c_str());
    const float expected = std::strtof(text.c_str(), nullptr);
    if (std::isinf(expected)) {
        EXPECT_EQ(decimal.status, DecimalStatus::beyond_float) << text;
        return;
    }
    EXPECT_EQ(decimal.status, DecimalStatus::ok) << text;
    EXPECT_EQ(bits(decimal.value), bits(expected)) << text;
    EXPECT_EQ(decimal.end, text.c_str() + text.size()) << text;
}

}  // namespace

TEST(Decimal, HasItsValue) {
    EXPECT_EQ(scan_decimal("1.5").value, 1.5f);
    EXPECT_EQ(scan_decimal("-.25e1 7").value, -2.5f);
    EXPECT_EQ(scan_decimal("+3.E-2").value, 0.03f);
    EXPECT_EQ(bits(scan_decimal("-0.0").value), 0x80000000u);
}

TEST(Decimal, EndsBehindItsLastDigit) {
    const char* const text = "12.5e+x";
    const Decimal decimal = scan_decimal(text);
    EXPECT_EQ(decimal.value, 12.5f);
    EXPECT_EQ(decimal.end, text + 4);
}

TEST(Decimal, WordsAreNoNumbers) {
    for (const char* const text :
         {"", "nan", "inf", "-inf", ".", "-", "+.e5", "e5", "abc", "\n1"}) {
        EXPECT_EQ(scan_decimal(text).status, DecimalStatus::not_a_number) << text;
        EXPECT_EQ(scan_decimal(text).end, text);
    }
}

TEST(Decimal, IsBeyondFloatOnlyFromHalfwayToTheNextPowerOfTwo) {
    expect_like_strtof("340282346638528859811704183484516925440");
    expect_like_strtof("340282356779733661637539395458142568447.9");
    expect_like_strtof("340282356779733661637539395458142568448");
    expect_like_strtof("-3.5e38");
    expect_like_strtof("1e999999999999999999999");
    expect_like_strtof("1" + std::string(300, '0') + "e-200");
    expect_like_strtof("1" + std::string(300, '0') + "e-290");
    expect_like_strtof("0." + std::string(300, '0') + "1e310");
}

TEST(Decimal, BecomesZeroBelowHalfTheSmallestFloat) {
    expect_like_strtof("7.006492321624085354618e-46");
    expect_like_strtof("7.006492321624085354619e-46");
    expect_like_strtof("-1e-400");
    expect_like_strtof("1e-99999999999999999999");
    expect_like_strtof("1.17549435e-38");
    expect_like_strtof("1.1754943e-38");
}

TEST(Decimal, RoundsMidpointsOfFloatsToEven) {
    expect_like_strtof("16777217");
    expect_like_strtof("16777219");
    expect_like_strtof("16777217.0000000000000000000000001");
    expect_like_strtof("16777216.99999999999");
    expect_like_strtof("9007199791611905");  // double rounding goes wrong here
}

TEST(Decimal, RandomNumbersRoundLikeTheCLibrary) {
    constexpr unsigned kSeed = 20170401;
    std::mt19937_64 random(kSeed);
    char text[128];
    for (int i = 0; i < 300'000; ++i) {
        const auto sign_and_mantissa = static_cast<uint32_t>(random()) & 0x807FFFFFu;
        const auto exponent = static_cast<uint32_t>(random() % 254);  // 255 would be infinity
        const auto finite = std::bit_cast<float>(sign_and_mantissa | exponent << 23);
        // The number lies around the midpoint between a float and the next, with 1 to 24 digits
        // after the first.
        const double middle = static_cast<double>(finite) +
                              (static_cast<double>(std::nextafter(finite, 1e38f)) - finite) / 2;
        std::snprintf(text, sizeof text, "%.*e", static_cast<int>(random() % 24 + 1), middle);
        expect_like_strtof(text);
        std::snprintf(text, sizeof text, "%.*f", static_cast<int>(random() % 12),
                      static_cast<double>(static_cast<int64_t>(random()) >> (random() % 60)) / 1e4);
        expect_like_strtof(text);
        ASSERT_FALSE(HasFailure()) << "seed " << kSeed << ", number " << i << ": " << text;
    }
}

TEST(Integer, IsScannedWithItsSign) {
    EXPECT_EQ(scan_integer("-17/3").value, -17);
    EXPECT_EQ(scan_integer("+4").value, 4);
    EXPECT_EQ(scan_integer("99999999999999999999999").value, 1'000'000'000'000'000'000);
    const char* const none = "-x";
    EXPECT_EQ(scan_integer(none).end, none);
}

}  // namespace voxelume
