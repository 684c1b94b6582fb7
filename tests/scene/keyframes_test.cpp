// SPDX-License-Identifier: Apache-2.0
// Keyframes against independent formulas.
#include "runtime/scene/keyframes.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <numbers>
#include <random>

#include "runtime/scene/parts/scene_affine.hpp"

namespace voxelume {
namespace {

using testing::DoubleNear;
using testing::ElementsAre;

Keyframes keys_of(Interpolation interpolation, std::vector<double> frames,
                  std::vector<double> values, size_t width = 1) {
    return {interpolation, std::move(frames), std::move(values), width};
}

/// A rotation of `degrees` about a unit axis, by Rodrigues' formula.
glm::dmat3 rotation_about(glm::dvec3 a, double degrees) {
    const double c = std::cos(degrees * std::numbers::pi / 180);
    const double s = std::sin(degrees * std::numbers::pi / 180);
    const glm::dmat3 cross(0, a.z, -a.y, -a.z, 0, a.x, a.y, -a.x, 0);
    return glm::dmat3(c) + s * cross + (1 - c) * glm::outerProduct(a, a);
}

double distance(const glm::dmat3& a, const glm::dmat3& b) {
    double largest = 0;
    for (int column = 0; column < 3; ++column)
        for (int row = 0; row < 3; ++row)
            largest = std::max(largest, std::abs(a[column][row] - b[column][row]));
    return largest;
}

glm::dvec3 turn_at(const Keyframes& keys, double frame) {
    const std::vector<double> row = values_at(keys, frame);
    return {row[0], row[1], row[2]};
}

}  // namespace

TEST(Keyframes, HoldBeforeTheFirstAndAfterTheLastKey) {
    for (const Interpolation kind :
         {Interpolation::step, Interpolation::linear, Interpolation::cubic}) {
        const Keyframes keys = keys_of(kind, {2, 5}, {3, -1, 7, 11}, 2);
        EXPECT_THAT(values_at(keys, -1e9), ElementsAre(3, -1));
        EXPECT_THAT(values_at(keys, 2), ElementsAre(3, -1));
        EXPECT_THAT(values_at(keys, 5), ElementsAre(7, 11));
        EXPECT_THAT(values_at(keys, 1e9), ElementsAre(7, 11));
    }
    EXPECT_THAT(values_at(keys_of(Interpolation::cubic, {4}, {9}), 1), ElementsAre(9));
}

TEST(Keyframes, OfStepsHoldUntilTheNext) {
    const Keyframes keys = keys_of(Interpolation::step, {1, 3, 8}, {10, 30, 80});
    EXPECT_THAT(values_at(keys, 2.999), ElementsAre(10));
    EXPECT_THAT(values_at(keys, 3), ElementsAre(30));
    EXPECT_THAT(values_at(keys, 7.5), ElementsAre(30));
}

TEST(Keyframes, OfLinesLieOnThem) {
    const Keyframes keys = keys_of(Interpolation::linear, {1, 3, 8}, {0, 5, 4, 5, -6, 10}, 2);
    EXPECT_THAT(values_at(keys, 2), ElementsAre(2, 5));
    EXPECT_THAT(values_at(keys, 3), ElementsAre(4, 5));
    EXPECT_THAT(values_at(keys, 5), ElementsAre(DoubleNear(0, 1e-14), DoubleNear(7, 1e-14)));
}

TEST(Keyframes, OfATurntableTurnAllTheWay) {
    const Keyframes keys = keys_of(Interpolation::linear, {1, 37}, {0, 0, 0, 360, 0, 0}, 3);
    EXPECT_THAT(values_at(keys, 19), ElementsAre(180, 0, 0));
    EXPECT_THAT(values_at(keys, 28), ElementsAre(270, 0, 0));
}

TEST(Keyframes, OfTwoCubicKeysAreSmoothstep) {
    const Keyframes keys = keys_of(Interpolation::cubic, {10, 14}, {2, -6});
    for (const double frame : {10.0, 10.5, 11.0, 12.0, 13.75}) {
        const double t = (frame - 10) / 4;
        EXPECT_NEAR(values_at(keys, frame)[0], 2 - 8 * (3 * t * t - 2 * t * t * t), 1e-13);
    }
}

// Computed by hand: the slopes around frame 3 are 1 and 4 and the spans 2 and 1. So the weights are
// 2*1+2 = 4 and 1+2*2 = 5, and the slope there is 9 / (4/1 + 5/4) = 12/7. The control values of the
// cubic Bezier curve lie a third of the span along the slopes.
TEST(Keyframes, OfCubicKeysAreTheHandComputedBezier) {
    const Keyframes keys = keys_of(Interpolation::cubic, {1, 3, 4}, {0, 2, 6});
    const double slope = 12.0 / 7;
    const auto bezier = [](double a, double b, double c, double d, double t) {
        const double u = 1 - t;
        return u * u * u * a + 3 * u * u * t * b + 3 * u * t * t * c + t * t * t * d;
    };
    EXPECT_NEAR(values_at(keys, 2.5)[0], bezier(0, 0, 2 - slope * 2 / 3, 2, 0.75), 1e-14);
    EXPECT_NEAR(values_at(keys, 3.25)[0], bezier(2, 2 + slope / 3, 6, 6, 0.25), 1e-14);
}

TEST(Keyframes, OfCubicKeysNeverLeaveTheRangeOfTheKeysAroundThem) {
    constexpr unsigned kSeed = 41;
    std::mt19937 random(kSeed);
    std::uniform_real_distribution<double> number(-10, 10);
    for (int repeat = 0; repeat < 200; ++repeat) {
        SCOPED_TRACE(testing::Message() << "seed " << kSeed << ", repeat " << repeat);
        Keyframes keys = keys_of(Interpolation::cubic, {}, {});
        double frame = number(random);
        for (int i = 0; i < 7; ++i) {
            keys.frames.push_back(frame += 0.01 + std::abs(number(random)));
            keys.values.push_back(repeat % 3 == 0 ? std::round(number(random) / 5)
                                                  : number(random));
        }
        for (size_t i = 0; i + 1 < keys.frames.size(); ++i) {
            const auto [low, high] = std::minmax(keys.values[i], keys.values[i + 1]);
            double last = keys.values[i];
            for (int step = 0; step <= 50; ++step) {
                const double at =
                    keys.frames[i] + (keys.frames[i + 1] - keys.frames[i]) * step / 50;
                const double value = values_at(keys, at)[0];
                EXPECT_GE(value, low - 1e-14 * std::abs(low));
                EXPECT_LE(value, high + 1e-14 * std::abs(high));
                const double rise = keys.values[i + 1] - keys.values[i];
                EXPECT_GE((value - last) * (rise < 0 ? -1 : 1), -1e-12);
                last = value;
            }
        }
    }
}

TEST(Keyframes, OfCubicKeysHaveAContinuousSpeed) {
    const Keyframes keys = keys_of(Interpolation::cubic, {1, 3, 4, 9}, {0, 2, 6, 7});
    for (const double key : {3.0, 4.0}) {
        const double e = 1e-6;
        const double before = (values_at(keys, key)[0] - values_at(keys, key - e)[0]) / e;
        const double after = (values_at(keys, key + e)[0] - values_at(keys, key)[0]) / e;
        EXPECT_NEAR(before, after, 1e-4);
        EXPECT_GT(before, 0.1);
    }
}

TEST(Keyframes, OfSlerpTurnAboutOneAxisTheShortWayAtAnEvenSpeed) {
    // The turn about Y goes from 350 to 20 degrees: 30 degrees, through 0.
    const Keyframes keys = keys_of(Interpolation::slerp, {1, 4}, {350, 0, 0, 20, 0, 0}, 3);
    EXPECT_LT(distance(rotation_from_turn(turn_at(keys, 2)), rotation_about({0, 1, 0}, 0)), 1e-15);
    EXPECT_LT(distance(rotation_from_turn(turn_at(keys, 3)), rotation_about({0, 1, 0}, 10)), 1e-15);

    const glm::dvec3 axis = glm::normalize(glm::dvec3(1, -2, 0.5));
    const glm::dmat3 start = rotation_from_turn({20, 40, -70});
    for (const double whole : {35.0, 179.0, -120.0}) {
        const glm::dvec3 end = turn_from_rotation(rotation_about(axis, whole) * start);
        const Keyframes about =
            keys_of(Interpolation::slerp, {0, 8}, {20, 40, -70, end.x, end.y, end.z}, 3);
        for (const double frame : {1.0, 4.0, 6.5}) {
            const glm::dmat3 expected = rotation_about(axis, whole * frame / 8) * start;
            EXPECT_LT(distance(rotation_from_turn(turn_at(about, frame)), expected), 1e-14)
                << whole << " at " << frame;
        }
    }
}

TEST(TurnFromRotation, GivesTheRotationBackAlsoWhereAnglesAreIllDetermined) {
    constexpr unsigned kSeed = 7;
    std::mt19937 random(kSeed);
    std::uniform_real_distribution<double> angle(-180, 180);
    for (int i = 0; i < 2000; ++i) {
        glm::dvec3 turn(angle(random), angle(random), angle(random));
        if (i % 4 == 0) turn.y = i % 8 == 0 ? 90 : -90;
        if (i % 4 == 1) turn.y = 90 - std::pow(10.0, -1 - i % 15);
        const glm::dmat3 rotation = rotation_from_turn(turn);
        EXPECT_LT(distance(rotation_from_turn(turn_from_rotation(rotation)), rotation), 2e-15)
            << "seed " << kSeed << ", number " << i;
    }
}

}  // namespace voxelume
