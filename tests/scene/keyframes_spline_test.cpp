// SPDX-License-Identifier: Apache-2.0
// Splines with slopes, and quaternions, against independent formulas.
#include <gmock/gmock.h>

#include <array>
#include <cmath>
#include <random>

#include "runtime/scene/keyframes.hpp"
#include "runtime/scene/parts/scene_affine.hpp"

namespace voxelume {
namespace {

using Quaternion = std::array<double, 4>;  // x, y, z, w

/// The rotation of a quaternion of any length, entry by entry.
glm::dmat3 rotation_of(Quaternion q) {
    const double length = std::sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
    for (double& number : q) number /= length;
    const auto [x, y, z, w] = q;
    glm::dmat3 m;
    m[0] = {1 - 2 * (y * y + z * z), 2 * (x * y + z * w), 2 * (x * z - y * w)};
    m[1] = {2 * (x * y - z * w), 1 - 2 * (x * x + z * z), 2 * (y * z + x * w)};
    m[2] = {2 * (x * z + y * w), 2 * (y * z - x * w), 1 - 2 * (x * x + y * y)};
    return m;
}

double largest_difference(const glm::dmat3& a, const glm::dmat3& b) {
    double largest = 0;
    for (int column = 0; column < 3; ++column)
        for (int row = 0; row < 3; ++row)
            largest = std::max(largest, std::abs(a[column][row] - b[column][row]));
    return largest;
}

glm::dmat3 turned_at(const Keyframes& keys, double frame) {
    const std::vector<double> row = values_at(keys, frame);
    EXPECT_EQ(row.size(), 3U);
    return rotation_from_turn({row[0], row[1], row[2]});
}

}  // namespace

TEST(Splines, FollowAnyCubicWhoseSlopesTheyHave) {
    // p(x) = 2 - 3 x + x^2 / 2 + x^3 / 4
    const auto value = [](double x) { return 2 - 3 * x + x * x / 2 + x * x * x / 4; };
    const auto slope = [](double x) { return -3 + x + 0.75 * x * x; };
    Keyframes keys{Interpolation::spline, {-1, 0.5, 4}, {}, 1};
    for (const double x : keys.frames) {
        keys.values.push_back(value(x));
        keys.in.push_back(slope(x));
        keys.out.push_back(slope(x));
    }
    for (double x = -1; x <= 4; x += 0.125)
        EXPECT_NEAR(values_at(keys, x)[0], value(x), 1e-13) << x;
    EXPECT_EQ(values_at(keys, 0.5)[0], value(0.5));
}

TEST(Splines, HaveSlopesOfTheirOwnOnBothSidesOfAKey) {
    const Keyframes keys{Interpolation::spline, {1, 2, 3},          {0, 0, 5, 5, 0, 0}, 2,
                         {0, 0, 4, -4, 0, 0},   {0, 0, -2, 2, 0, 0}};
    constexpr double kStep = 1e-6;
    for (const size_t column : {0, 1}) {
        const double sign = column == 0 ? 1 : -1;
        EXPECT_NEAR((5 - values_at(keys, 2 - kStep)[column]) / kStep, 4 * sign, 1e-4);
        EXPECT_NEAR((values_at(keys, 2 + kStep)[column] - 5) / kStep, -2 * sign, 1e-4);
    }
}

TEST(Quaternions, AreTurnsAtKeysAndBetweenThem) {
    std::mt19937 random(11);
    std::normal_distribution<double> normal;
    for (int i = 0; i < 300; ++i) {
        Quaternion a{}, b{};
        for (double& number : a) number = normal(random);
        for (double& number : b) number = normal(random);
        Keyframes keys{Interpolation::slerp, {2, 5}, {}, 4, {}, {}, true};
        keys.values.insert(keys.values.end(), a.begin(), a.end());
        keys.values.insert(keys.values.end(), b.begin(), b.end());
        EXPECT_LT(largest_difference(turned_at(keys, 2), rotation_of(a)), 1e-14) << i;
        EXPECT_LT(largest_difference(turned_at(keys, 9), rotation_of(b)), 1e-14) << i;
        // In the middle the shorter way is the sum of equally long quaternions of one side.
        double aa = 0, bb = 0, ab = 0;
        for (size_t c = 0; c < 4; ++c) aa += a[c] * a[c], bb += b[c] * b[c], ab += a[c] * b[c];
        Quaternion middle{};
        for (size_t c = 0; c < 4; ++c)
            middle[c] = a[c] / std::sqrt(aa) + std::copysign(b[c] / std::sqrt(bb), ab * b[c]);
        EXPECT_LT(largest_difference(turned_at(keys, 3.5), rotation_of(middle)), 1e-13) << i;
    }
}

TEST(Quaternions, OfSplinesAreTheirNumbersNormalized) {
    const Quaternion a{0.1, 0.2, 0.3, 1}, b{0.5, -0.3, 0.1, 0.7};
    const Keyframes keys{Interpolation::spline,
                         {1, 3},
                         {a[0], a[1], a[2], a[3], b[0], b[1], b[2], b[3]},
                         4,
                         {0, 0, 0, 0, 0.3, -0.1, 0.2, 0.1},
                         {0.1, 0.4, -0.2, 0, 0, 0, 0, 0},
                         true};
    // Halfway of Hermite's polynomial over two frames: (a + b) / 2 + 2 (out - in) / 8.
    Quaternion middle{};
    for (size_t c = 0; c < 4; ++c)
        middle[c] = (a[c] + b[c]) / 2 + (keys.out[c] - keys.in[4 + c]) / 4;
    EXPECT_LT(largest_difference(turned_at(keys, 2), rotation_of(middle)), 1e-15);
}

}  // namespace voxelume
