// SPDX-License-Identifier: Apache-2.0
// lib/lanes/fixed_point.h against the same rules in double.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "kernels/shared/trace.h"
#include "runtime/opencl/program.hpp"
#include "tests/support/test_device.hpp"

namespace voxelume {
namespace {

constexpr unsigned kFixedSeed = 20261121;
constexpr uint32_t kFixedCount = 1u << 16;

constexpr const char* kFixedSource = R"(
#include "lib/lanes/fixed_point.h"
#include "lib/lanes/work_item.h"
kernel void evaluate(uint count, float size, global const float* a, global const float* b,
                     global const float* c, global float* results) {
    const uint first = work_item() * VXL_LANES;
    if (first >= count) return;
    const lane_float x = LANES_LOAD(a, first), y = LANES_LOAD(b, first), z = LANES_LOAD(c, first);
    lane_float t_first = (lane_float)0.25f, t_last = (lane_float)1000.0f;
    clip_axis(x, y, size, &t_first, &t_last);
    LANES_STORE((RESULT), results, first);
}
)";

using Values = std::vector<float>;

class FixedPoint : public testing::TestWithParam<int> {
  protected:
    /// The values of an expression in x, y, z, `size` and the result of clip_axis for [0.25, 1000].
    Values evaluate(const std::string& expression, float size, const Values& x, const Values& y,
                    const Values& z) const {
        const Device device = test_device(GetParam());
        std::string source = kFixedSource;
        source.replace(source.find("RESULT"), 6, expression);
        const auto count = uint32_t(x.size());
        Buffer<float> results(device, "results", count);
        Program::from_text(device, source, {{"VXL_NATIVE_DIVIDE", 0}})
            .kernel("evaluate")
            .launch_packets(count, count, size, Buffer<float>(device, "x", std::span(x)),
                            Buffer<float>(device, "y", std::span(y)),
                            Buffer<float>(device, "z", std::span(z)), results);
        return results.read();
    }

    Values uniform(float low, float high, unsigned seed) const {
        std::mt19937 random(seed);
        std::uniform_real_distribution<float> place(low, high);
        Values values(kFixedCount);
        for (float& v : values) v = place(random);
        return values;
    }
};

TEST_P(FixedPoint, ScalesTheLargestComponentIntoTheUpperHalfOfOne) {
    std::mt19937 random(kFixedSeed);
    Values v[3] = {uniform(-1, 1, 1), uniform(-1, 1, 2), uniform(-1, 1, 3)};
    for (uint32_t i = 0; i < kFixedCount; ++i)
        for (Values& c : v) c[i] = std::ldexp(c[i], int(random() % 41) - 20);
    v[0][0] = 0, v[1][0] = 1, v[2][0] = 0;
    v[0][1] = -0.5f, v[1][1] = 0.25f, v[2][1] = 0;
    const Values scale = evaluate("power_of_two_scale(x, y, z)", 1, v[0], v[1], v[2]);
    EXPECT_EQ(scale[0], 0.5f);
    EXPECT_EQ(scale[1], 1);
    for (uint32_t i = 0; i < kFixedCount; ++i) {
        int exponent;
        ASSERT_EQ(std::frexp(scale[i], &exponent), 0.5f) << "not a power of two";
        const float largest =
            std::max({std::abs(v[0][i]), std::abs(v[1][i]), std::abs(v[2][i])}) * scale[i];
        ASSERT_GE(largest, 0.5f) << "seed " << kFixedSeed << " vector " << i;
        ASSERT_LT(largest, 1.0f) << "seed " << kFixedSeed << " vector " << i;
    }
}

TEST_P(FixedPoint, SnapsDirectionsToTheNearestStepTiesToEven) {
    Values x = uniform(-1, 1, kFixedSeed);
    const double step = std::ldexp(1.0, -VXL_DIRECTION_BITS);
    x[0] = 1, x[1] = -1, x[2] = 0, x[3] = float(step / 2), x[4] = float(1.5 * step);
    const Values snapped = evaluate("snap_direction(x)", 1, x, x, x);
    for (uint32_t i = 0; i < kFixedCount; ++i)
        ASSERT_EQ(snapped[i], std::nearbyint(double(x[i]) / step) * step) << "number " << i;
}

TEST_P(FixedPoint, SnapsPositionsTowardsTheirSide) {
    for (const float fixed_point : {8192.0f, 1048576.0f}) {
        const Values o = uniform(0, 13.7f, kFixedSeed);
        Values side = uniform(-1, 1, kFixedSeed + 1);
        for (uint32_t i = 0; i < kFixedCount; i += 3) side[i] = 0;
        const Values snapped = evaluate("snap_position(x, y, size)", fixed_point, o, side, o);
        for (uint32_t i = 0; i < kFixedCount; ++i) {
            const double scaled = double(o[i]) * double(fixed_point);
            const double expected = side[i] > 0   ? std::ceil(scaled)
                                    : side[i] < 0 ? std::floor(scaled)
                                                  : std::nearbyint(scaled);
            ASSERT_EQ(snapped[i], expected / double(fixed_point))
                << "seed " << kFixedSeed << " number " << i;
        }
    }
}

TEST_P(FixedPoint, ClipsRaysToASlab) {
    constexpr float kSize = 37;
    Values o = uniform(-20, 60, kFixedSeed), d = uniform(-1, 1, kFixedSeed + 1);
    for (uint32_t i = 0; i < kFixedCount; i += 5) d[i] = 0;
    o[0] = 0, o[5] = 37, o[10] = -0.01f, o[15] = 37.01f;  // d is 0 in these
    const Values first = evaluate("t_first", kSize, o, d, o),
                 last = evaluate("t_last", kSize, o, d, o);
    for (uint32_t i = 0; i < kFixedCount; ++i) {
        const double a = (0 - double(o[i])) / double(d[i]),
                     b = (double(kSize) - double(o[i])) / double(d[i]);
        if (d[i] == 0) {
            const bool inside = o[i] >= 0 && o[i] <= kSize;
            ASSERT_EQ(first[i] <= last[i], inside) << "ray " << i;
            if (!inside) continue;
            ASSERT_EQ(first[i], 0.25f) << "ray " << i;
            ASSERT_EQ(last[i], 1000) << "ray " << i;
            continue;
        }
        const double expected_first = std::max(std::min(a, b), 0.25);
        const double expected_last = std::min(std::max(a, b), 1000.0);
        ASSERT_NEAR(first[i], expected_first, 4e-7 * std::abs(expected_first)) << "ray " << i;
        ASSERT_NEAR(last[i], expected_last, 4e-7 * std::abs(expected_last)) << "ray " << i;
    }
}

INSTANTIATE_TEST_SUITE_P(Lanes, FixedPoint, testing::Values(1, 4, 8, 16));

}  // namespace
}  // namespace voxelume
