// SPDX-License-Identifier: Apache-2.0
// Transfer functions of scans at points and averaged over boxes.
#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <random>

#include "runtime/grid/density_field.hpp"
#include "runtime/stages/medium/transfer_curve.hpp"
#include "tests/light/transfer_windows.hpp"

namespace voxelume {

TEST(TransferCurve, HasItsPointsAndLinesBetweenThem) {
    const TransferCurve curve(kWindows);
    for (double value = -4; value < 8; value += 0.03125)
        for (int channel = 0; channel < 4; ++channel)
            EXPECT_NEAR(curve.at(value)[channel], light_at(value, channel), 1e-13) << value;
    EXPECT_TRUE(curve.is_zero_in(1.25, 3));
    EXPECT_TRUE(curve.is_zero_in(-9, -2));
    EXPECT_FALSE(curve.is_zero_in(1.2, 2));
    EXPECT_FALSE(curve.is_zero_in(-9, 9)) << "both ends and both windows";
    EXPECT_FALSE(curve.is_zero_in(2, 4));
}

TEST(TransferCurve, IsExactlyAveragedOverLinearValues) {
    const TransferCurve curve(kWindows);
    std::mt19937 random(3);
    std::uniform_real_distribution<double> middle(-4, 7), rise(-3, 3);
    constexpr int kSteps = 40;
    for (int i = 0; i < 60; ++i) {
        glm::dvec3 rises(rise(random), rise(random), rise(random));
        if (i % 3 == 1) rises.y = rises.z = 0;
        if (i % 3 == 2) rises.x *= 1e-5;
        const double center = middle(random);
        const auto value = [&](double x, double y, double z) {
            return center + glm::dot(rises, glm::dvec3(x, y, z) - 0.5);
        };
        std::array<float, 8> corners{};
        for (int c = 0; c < 8; ++c) corners[size_t(c)] = float(value(c & 1, c >> 1 & 1, c >> 2));
        glm::dvec4 sum(0);
        for (int x = 0; x < kSteps; ++x)
            for (int y = 0; y < kSteps; ++y)
                for (int z = 0; z < kSteps; ++z)
                    for (int channel = 0; channel < 4; ++channel)
                        sum[channel] += light_at(
                            value((x + 0.5) / kSteps, (y + 0.5) / kSteps, (z + 0.5) / kSteps),
                            channel);
        const glm::dvec4 mean = curve.mean(corners), expected = sum / std::pow(kSteps, 3);
        // Sums over points are as exact as the kinks of the function allow.
        for (int channel = 0; channel < 4; ++channel)
            EXPECT_NEAR(mean[channel], expected[channel], 4e-3) << i;
    }
    EXPECT_EQ(curve.mean({kOutsideScan, kOutsideScan, kOutsideScan, kOutsideScan, kOutsideScan,
                          kOutsideScan, kOutsideScan, kOutsideScan}),
              glm::dvec4(0));
}

TEST(TransferCurve, MayRiseBetweenTheClosestPoints) {
    const std::array<float, 8> far = {200, 200, 200, 200, 200, 200, 200, 200};
    for (const double gap : {1e-1, 1e-6, 1e-9, 1e-12, 1e-13}) {
        const TransferCurve step(
            std::vector<TransferPoint>{{100, 0.5F, {1, 1, 1}}, {100 + gap, 2, {1, 1, 1}}});
        EXPECT_EQ(step.at(200), glm::dvec4(2)) << gap;
        EXPECT_EQ(step.mean(far), glm::dvec4(2)) << gap;
        // A box of whose values, from 96 to 104 along X, half lie below the step.
        const glm::dvec4 mean = step.mean({96, 104, 96, 104, 96, 104, 96, 104});
        EXPECT_NEAR(mean.w, 0.5 + 1.5 * (4 - gap / 2) / 8, 1e-7) << gap;
        // A corner of the box, a sixth of it, lies below the step.
        EXPECT_NEAR(step.mean({97, 100, 100, 103, 100, 103, 103, 106}).w,
                    2 - 1.5 / 6 - 1.5 * gap / 12, gap * gap + 1e-6)
            << gap;
    }
    for (const double gap : {1e-300, 1e-310}) {
        const TransferCurve step(
            std::vector<TransferPoint>{{0, 0.5F, {1, 1, 1}}, {gap, 2, {1, 1, 1}}});
        EXPECT_EQ(step.mean(far), glm::dvec4(2)) << gap;
        EXPECT_NEAR(step.mean({-1, 3, -1, 3, -1, 3, -1, 3}).w, 0.5 + 1.5 * 0.75, 1e-7) << gap;
    }
}

TEST(TransferCurve, IsExactlyNothingBetweenPointsOfNothing) {
    const TransferCurve curve(std::vector<TransferPoint>{{-200, 0, {1, 1, 1}},
                                                         {40, 0.5F, {1, 0.9F, 0.3F}},
                                                         {100, 0, {1, 1, 1}},
                                                         {300, 0, {1, 1, 1}},
                                                         {900, 4, {1, 1, 1}},
                                                         {1000.1, 0, {1, 1, 1}}});
    for (float value = 100; value <= 300; value += 0.37F) {
        EXPECT_EQ(curve.at(value), glm::dvec4(0)) << value;
        EXPECT_EQ(curve.mean({100, value, 300, value, 200, 200, value, value}), glm::dvec4(0));
        EXPECT_TRUE(curve.is_zero_in(100, value));
        EXPECT_FALSE(curve.is_zero_in(99.9, value));
    }
    EXPECT_EQ(curve.at(1e9), glm::dvec4(0));
    EXPECT_TRUE(curve.is_zero_in(1001, INFINITY));
    EXPECT_FALSE(curve.is_zero_in(-INFINITY, INFINITY));
}

}  // namespace voxelume
