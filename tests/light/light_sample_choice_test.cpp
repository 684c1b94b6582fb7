// SPDX-License-Identifier: Apache-2.0
#include "runtime/stages/light/light_sample_choice.hpp"

#include <gmock/gmock.h>

#include <glm/geometric.hpp>
#include <random>

namespace voxelume {
namespace {

/// The pieces of a sheet of 12 x 5 squares of 0.5 x 0.25 m that emits light to both sides.
std::vector<EmissivePiece> sheet() {
    std::vector<EmissivePiece> pieces;
    for (int side : {-1, 1})
        for (int x = 0; x < 12; ++x)
            for (int z = 0; z < 5; ++z)
                pieces.push_back({{x * 0.5, 0, z * 0.25}, {0, side, 0}, 0.125, {1, 2, 4}, true});
    return pieces;
}

TEST(LightSampleChoice, TwoLightSamplesOfASheetFaceBothWays) {
    std::vector<EmissivePiece> pieces = sheet();
    for (EmissivePiece& piece : pieces) piece.position.x *= 0.4;  // 2.2 m: a direction's share
    const std::vector<LightSample> light_samples = choose_light_samples(pieces, 4);
    ASSERT_EQ(light_samples.size(), 4u);
    double up = 0, down = 0;
    for (const LightSample& light_sample : light_samples)
        (light_sample.normal.y > 0 ? up : down) += light_sample.area;
    EXPECT_DOUBLE_EQ(up, down);
}

TEST(LightSampleChoice, PartsAddUpToTheWholeAndAreOfLikeSize) {
    std::mt19937 random(20170311);
    std::uniform_real_distribution<double> unit(-1, 1);
    std::vector<EmissivePiece> pieces;
    double area = 0;
    glm::dvec3 power(0);
    for (int i = 0; i < 5000; ++i) {
        const glm::dvec3 n = glm::normalize(glm::dvec3(unit(random), unit(random), unit(random)));
        pieces.push_back({n * 3.0, n, 1 + unit(random) * 0.5, {1, 0.5, 2}, true});
        area += pieces.back().area;
        power += pieces.back().emission * pieces.back().area;
    }
    const std::vector<LightSample> light_samples = choose_light_samples(pieces, 37);
    ASSERT_EQ(light_samples.size(), 37u);
    double sum = 0;
    glm::dvec3 power_sum(0);
    for (const LightSample& light_sample : light_samples) {
        EXPECT_NEAR(light_sample.area, area / 37, 0.03 * area / 37);
        sum += light_sample.area;
        power_sum += light_sample.power;
    }
    EXPECT_NEAR(sum, area, 1e-9 * area);
    EXPECT_NEAR(power_sum.z, power.z, 1e-9 * power.z);
}

TEST(LightSampleChoice, ThereAreNoMoreLightSamplesThanPieces) {
    std::vector<EmissivePiece> pieces = sheet();
    EXPECT_EQ(choose_light_samples(pieces, 1000).size(), pieces.size());
    EXPECT_TRUE(choose_light_samples({}, 3).empty());
}

TEST(LightSampleChoice, APieceOffTheSurfaceIsNoLightSampleWhileThereAreOthers) {
    std::vector<EmissivePiece> pieces = sheet();
    for (EmissivePiece& piece : pieces) piece.is_exact = piece.position.x == 0;
    const std::vector<LightSample> light_samples =
        choose_light_samples(std::span(pieces).first(60), 1);
    EXPECT_EQ(light_samples.at(0).position.x, 0);
    EXPECT_DOUBLE_EQ(light_samples.at(0).area, 60 * 0.125);
}

TEST(LightSampleChoice, TheMiddleOfEqualPartsIsTheLightSample) {
    std::vector<EmissivePiece> pieces = sheet();
    const std::vector<LightSample> light_samples =
        choose_light_samples(std::span(pieces).first(55), 1);  // 11 x 5
    EXPECT_EQ(light_samples.at(0).position, glm::dvec3(2.5, 0, 0.5));
}

}  // namespace
}  // namespace voxelume
