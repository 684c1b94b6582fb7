// SPDX-License-Identifier: Apache-2.0
// lib/lanes/exact_float.h and lib/lanes/exact_exp.h give the same bits as IEEE arithmetic, and stay
// within bounds around results in double.
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <random>

#include "runtime/opencl/program.hpp"
#include "tests/support/test_device.hpp"

namespace voxelume {
namespace {

constexpr unsigned kFloatSeed = 20261121;
constexpr uint32_t kFloats = 1u << 20;

constexpr const char* kFloatSource = R"(
#include "lib/lanes/exact_exp.h"
#include "lib/lanes/work_item.h"
kernel void evaluate(uint count, global const float* a, global const float* b, global float* results) {
    const uint first = work_item() * VXL_LANES;
    if (first >= count) return;
    const lane_float x = LANES_LOAD(a, first), y = LANES_LOAD(b, first);
    lane_float sine, cosine;
    exact_sincos(x, &sine, &cosine);
    LANES_STORE((RESULT), results, first);
}
)";

/// The values of an expression in x and y (and `sine`, `cosine` of x) for all inputs.
std::vector<float> evaluate(const std::string& expression, const std::vector<float>& x,
                            const std::vector<float>& y, bool native, int lanes) {
    const Device device = test_device(lanes);
    std::string source = kFloatSource;
    source.replace(source.find("RESULT"), 6, expression);
    const auto count = uint32_t(x.size());
    Buffer<float> results(device, "results", count);
    Program::from_text(device, source, {{"VXL_NATIVE_DIVIDE", native}})
        .kernel("evaluate")
        .launch_packets(count, count, Buffer<float>(device, "x", std::span<const float>(x)),
                        Buffer<float>(device, "y", std::span<const float>(y)), results);
    return results.read();
}

/// Random numbers of both signs with exponents in [low, high]; some have few bits set, some all.
std::vector<float> spread_numbers(uint32_t count, int low, int high, bool negative, unsigned seed) {
    std::mt19937 random(seed);
    std::vector<float> numbers(count);
    for (float& v : numbers) {
        uint32_t mantissa = random() & 0x7FFFFFu;
        const uint32_t kind = random() % 8;
        if (kind == 0) mantissa = 0x7FFFFFu - random() % 64;
        if (kind == 1) mantissa = random() % 64;
        if (kind == 2) mantissa = 1u << random() % 23;
        const int exponent = low + int(random() % uint32_t(high - low));
        v = std::ldexp(std::bit_cast<float>(0x3F800000u | mantissa), exponent);
        if (negative && random() % 2) v = -v;
    }
    return numbers;
}

/// The difference between a value and the expected one, in units in the last place of the latter.
double ulps(double value, double expected) {
    int exponent;
    std::frexp(expected, &exponent);
    return std::abs(value - expected) / std::ldexp(1.0, std::max(exponent, -125) - 24);
}

struct Way {
    bool native;
    int lanes;
};

class ExactFloat : public testing::TestWithParam<Way> {
  protected:
    void SetUp() override {
        if (GetParam().native && !test_device().is_cpu())
            GTEST_SKIP() << "kernels don't use its own division, which may round otherwise";
    }

    std::vector<float> results(const std::string& expression, const std::vector<float>& x,
                               const std::vector<float>& y) const {
        return evaluate(expression, x, y, GetParam().native, GetParam().lanes);
    }
};

TEST_P(ExactFloat, DividesAndTakesRootsToTheBitsOfIeee) {
    auto x = spread_numbers(kFloats, -24, 24, true, kFloatSeed);
    for (uint32_t i = 0; i < kFloats; i += 4093) x[i] = i % 2 ? 0.0f : -0.0f;
    const auto y = spread_numbers(kFloats, -24, 24, true, kFloatSeed + 1);
    const auto positive = spread_numbers(kFloats, -60, 60, false, kFloatSeed + 2);
    const auto inverse = results("exact_reciprocal(x)", x, y);
    const auto quotient = results("exact_divide(x, y)", x, y);
    const auto root = results("exact_sqrt(x)", positive, y);
    const auto bits = [](float v) { return std::bit_cast<uint32_t>(v); };
    for (uint32_t i = 0; i < kFloats; ++i) {
        ASSERT_EQ(bits(inverse[i]), bits(1.0f / x[i]))
            << std::hexfloat << x[i] << " seed " << kFloatSeed;
        ASSERT_EQ(bits(quotient[i]), bits(x[i] / y[i])) << std::hexfloat << x[i] << " / " << y[i];
        ASSERT_EQ(bits(root[i]), bits(std::sqrt(positive[i]))) << std::hexfloat << positive[i];
    }
}

TEST_P(ExactFloat, TakesTheRootOfTheFloatBelowOneToBeItself) {
    const std::vector<float> below(16, std::nextafter(1.0f, 0.0f));
    EXPECT_EQ(results("exact_sqrt(x)", below, below), below);
}

TEST_P(ExactFloat, KeepsTheLimits) {
    const std::vector<float> x = {0, 0x1p-24f, 0x1p24f, 1, 3,  -7, 0x1.fffffep0f, 16, 0, 4,
                                  9, 2,        5,       6, 10, 12};
    const auto inverse = results("exact_reciprocal(x)", x, x);
    const auto root = results("exact_sqrt(fabs(x))", x, x);
    EXPECT_EQ(inverse[0], INFINITY);
    EXPECT_EQ(root[0], 0);
    EXPECT_EQ(inverse[1], 0x1p24f);
    EXPECT_EQ(inverse[2], 0x1p-24f);
    EXPECT_EQ(root[7], 4);
}

INSTANTIATE_TEST_SUITE_P(Ways, ExactFloat,
                         testing::Values(Way{false, 1}, Way{false, 16}, Way{true, 4}, Way{true, 8}),
                         [](const auto& way) {
                             return (way.param.native ? "Native" : "Corrected") +
                                    std::to_string(way.param.lanes);
                         });

/// Evenly spread numbers in [low, high].
std::vector<float> between(float low, float high, unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<float> place(low, high);
    std::vector<float> numbers(kFloats);
    for (float& v : numbers) v = place(random);
    numbers[0] = low, numbers[1] = high;
    return numbers;
}

class ExactFunctions : public testing::TestWithParam<int> {
  protected:
    std::vector<float> results(const std::string& expression, const std::vector<float>& x,
                               const std::vector<float>& y) const {
        return evaluate(expression, x, y, false, GetParam());
    }

    template <class Function>
    double worst_ulps(const std::string& expression, const std::vector<float>& x,
                      const Function& expected) const {
        const auto values = results(expression, x, x);
        double worst = 0;
        for (uint32_t i = 0; i < kFloats; ++i)
            worst = std::max(worst, ulps(values[i], expected(double(x[i]))));
        return worst;
    }
};

TEST_P(ExactFunctions, ExponentialAndLogarithmAreRightWithinUnitsInTheLastPlace) {
    const auto exp = [](double v) { return std::exp(v); };
    const auto log = [](double v) { return std::log(v); };
    EXPECT_LT(worst_ulps("exact_exp(x)", between(-87, 88, kFloatSeed), exp), 1.5);
    EXPECT_LT(worst_ulps("exact_exp(x)", between(-1, 1, kFloatSeed), exp), 1.5);
    EXPECT_LT(worst_ulps("exact_log(x)", between(0.5f, 2, kFloatSeed), log), 2.5);
    EXPECT_LT(
        worst_ulps("exact_log(x)", spread_numbers(kFloats, -126, 127, false, kFloatSeed), log),
        2.5);
}

TEST_P(ExactFunctions, ExponentialVanishesBelowTheNormalNumbers) {
    const std::vector<float> x = {-87.5f, -1e30f, -INFINITY, 0, 1,  -0.0f, -87, 88,
                                  -100,   -200,   -3e38f,    0, -1, 2,     3,   4};
    const auto values = results("exact_exp(x)", x, x);
    for (const size_t i : {0, 1, 2, 8, 9, 10}) EXPECT_EQ(values[i], 0) << x[i];
    EXPECT_EQ(values[3], 1);
    EXPECT_EQ(values[5], 1);
}

TEST_P(ExactFunctions, PowersLoseAsManyUnitsAsTheirExponentIsLarge) {
    const auto x = between(0, 1, kFloatSeed);
    const auto y = between(0.01f, 1000, kFloatSeed + 1);
    const auto values = results("exact_power(x, y)", x, y);
    for (uint32_t i = 0; i < kFloats; ++i) {
        const double expected = std::pow(double(x[i]), double(y[i]));
        if (expected < 0x1p-125) {
            ASSERT_LT(values[i], 0x1p-124) << x[i] << " to the " << y[i];
            continue;
        }
        // The exponent y ln x, at most 87, has a relative error of about three units of 2^-24.
        const double bound = 4 + 4 * std::abs(std::log(expected));
        ASSERT_LT(ulps(values[i], expected), bound) << x[i] << " to the " << y[i];
    }
    EXPECT_EQ(results("exact_power(x, y)", std::vector<float>(16, 1), between(1, 9, 1))[3], 1);
    EXPECT_EQ(results("exact_power(x, y)", std::vector<float>(16, 0), between(1, 9, 1))[3], 0);
}

TEST_P(ExactFunctions, SineAndCosineAreRightWithinTwoUnitsOfOne) {
    const auto angles = between(-6.2831853f, 6.2831853f, kFloatSeed);
    const auto sine = results("sine", angles, angles), cosine = results("cosine", angles, angles);
    for (uint32_t i = 0; i < kFloats; ++i) {
        ASSERT_NEAR(sine[i], std::sin(double(angles[i])), 0x1p-23) << angles[i];
        ASSERT_NEAR(cosine[i], std::cos(double(angles[i])), 0x1p-23) << angles[i];
    }
}

INSTANTIATE_TEST_SUITE_P(Lanes, ExactFunctions, testing::Values(1, 16));

}  // namespace
}  // namespace voxelume
