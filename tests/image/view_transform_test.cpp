// SPDX-License-Identifier: Apache-2.0
// View transforms against their published formulas, and what pictures rely on: order, greys, ends.
#include "runtime/image/view_transform.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <limits>

namespace voxelume {
namespace {

using Codes = std::array<uint16_t, 3>;

TEST(ViewTransform, SrgbOfSixteenBitsIsTheStandardsFormula) {
    const ColorCodes codes(ViewTransform::srgb, 16);
    for (const float light : {0.0f, 0.001f, 0.0031f, 0.0032f, 0.18f, 0.5f, 0.999f, 1.0f}) {
        const double code =
            light <= 0.0031308f ? 12.92 * light : 1.055 * std::pow(light, 1 / 2.4) - 0.055;
        EXPECT_EQ(codes({light, light, light})[1], std::lround(code * 65535)) << light;
    }
    EXPECT_EQ(codes({-1, 2, 0.5f}), (Codes{0, 65535, 48192}));
}

/// Tries every float at which one code ends and the next begins, and its neighbours.
TEST(ViewTransform, SrgbCodesBeginAndEndAtTheirThresholds) {
    for (const int bits : {8, 16}) {
        const ColorCodes codes(ViewTransform::srgb, bits);
        const double most = codes.maximum();
        for (uint32_t k = 0; k < codes.maximum(); ++k) {
            const double value = (k + 0.5) / most;
            const auto at =
                float(value <= 0.04045 ? value / 12.92 : std::pow((value + 0.055) / 1.055, 2.4));
            const float below = std::nextafter(at, 0.0f), above = std::nextafter(at, 2.0f);
            ASSERT_EQ(codes({below, at, above}),
                      (Codes{uint16_t(k), uint16_t(k + 1), uint16_t(k + 1)}))
                << bits << " bits, code " << k;
        }
        for (const float dark : {-INFINITY, -1.0f, -0.0f, 1e-45f, 1e-8f})
            EXPECT_EQ(codes({dark, dark, dark}), Codes{}) << dark;
        const auto white = codes.maximum();
        EXPECT_EQ(codes({1, 1e30f, INFINITY}), (Codes{white, white, white}));
    }
}

TEST(ViewTransform, NoneStoresTheLightItself) {
    EXPECT_EQ(ColorCodes(ViewTransform::none, 8)({0.2f, 0.5f, 3}), (Codes{51, 128, 255}));
    EXPECT_EQ(ColorCodes(ViewTransform::none, 16)({0.2f, 0.5f, -3}), (Codes{13107, 32768, 0}));
}

TEST(ViewTransform, FilmicHasTheValuesOfItsFit) {
    // Computed by hand: x = 1 gives 2.54 / 3.16 = 0.803797, whose code is 0.9083 * 255.
    const ColorCodes codes(ViewTransform::filmic, 8);
    EXPECT_EQ(codes({1, 1, 1}), (Codes{232, 232, 232}));
    EXPECT_EQ(codes({0, 0.18f, 100}), (Codes{0, 141, 255}));
}

TEST(ViewTransform, AgxKeepsMiddleGreyAndEndsAtBlackAndWhite) {
    // Middle grey is coded by a power of 2.4: 0.18^(1/2.4) = 0.48943.
    EXPECT_NEAR(agx_curve(10 / 16.5), 0.48943, 1e-5);
    EXPECT_NEAR(agx_curve(0), 0, 1e-12);
    EXPECT_NEAR(agx_curve(1), 1, 1e-12);
    // Its slope there is the contrast, 2.4, for a step in positions.
    EXPECT_NEAR((agx_curve(10 / 16.5 + 1e-5) - agx_curve(10 / 16.5 - 1e-5)) / 2e-5, 2.4, 1e-3);
    const ColorCodes codes(ViewTransform::agx, 16);
    EXPECT_NEAR(codes({0.18f, 0.18f, 0.18f})[0], 0.48943 * 65535, 2);
    EXPECT_EQ(codes({0, 0, 0}), (Codes{0, 0, 0}));
    EXPECT_EQ(codes({1000, 1000, 1000}), (Codes{65535, 65535, 65535}));
}

TEST(ViewTransform, AgxOfGreyIsItsCurveInStops) {
    const ColorCodes codes(ViewTransform::agx, 16);
    for (double stop = -9.5; stop < 6.4; stop += 0.37) {
        const auto light = float(0.18 * std::exp2(stop));
        const Codes code = codes({light, light, light});
        EXPECT_NEAR(code[0], agx_curve((stop + 10) / 16.5) * 65535, 3) << stop;
        EXPECT_NEAR(code[1], code[0], 1);
        EXPECT_NEAR(code[2], code[0], 1);
    }
}

TEST(ViewTransform, BrightSaturatedLightFadesToWhiteInAgxAlone) {
    const glm::vec3 bright(40, 4, 1);
    const Codes agx = ColorCodes(ViewTransform::agx, 8)(bright);
    EXPECT_GT(agx[0], agx[1]);
    EXPECT_GT(agx[2], 150);
    EXPECT_EQ(ColorCodes(ViewTransform::srgb, 8)(bright), (Codes{255, 255, 255}));
    const glm::vec3 red(8, 0.01f, 0.01f);
    EXPECT_GT(ColorCodes(ViewTransform::agx, 8)(red)[1], 60);
    EXPECT_LT(ColorCodes(ViewTransform::srgb, 8)(red)[1], 30);
}

TEST(ViewTransform, MoreLightNeverGivesASmallerCode) {
    for (const ViewTransform transform :
         {ViewTransform::srgb, ViewTransform::none, ViewTransform::filmic, ViewTransform::agx}) {
        const ColorCodes codes(transform, 16);
        uint16_t last = 0;
        for (double light = 1e-5; light < 100; light *= 1.003) {
            const uint16_t code = codes(glm::vec3(float(light)))[1];
            ASSERT_GE(code, last) << int(transform) << " " << light;
            last = code;
        }
    }
}

TEST(ViewTransform, TakesValuesThatAreNoLight) {
    const float inf = std::numeric_limits<float>::infinity();
    const float nan = std::numeric_limits<float>::quiet_NaN();
    for (const ViewTransform transform :
         {ViewTransform::srgb, ViewTransform::none, ViewTransform::filmic, ViewTransform::agx}) {
        const ColorCodes codes(transform, 8);
        EXPECT_EQ(codes({inf, inf, inf}), (Codes{255, 255, 255})) << int(transform);
        EXPECT_EQ(codes({nan, nan, nan}), (Codes{0, 0, 0})) << int(transform);
        EXPECT_EQ(codes({-inf, -1, -1e30f}), (Codes{0, 0, 0})) << int(transform);
    }
}

}  // namespace
}  // namespace voxelume
