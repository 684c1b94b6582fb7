#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <random>

#include "runtime/opencl/program.hpp"
#include "tests/test_device.hpp"

namespace voxelume {
namespace {

struct Results {
    std::vector<float> quotient, root, reciprocal;
};

/// a/b, the root of |a| and 1/b by the corrected operations, as a device without exact ones runs
/// them.
Results corrected(const std::vector<float>& a, const std::vector<float>& b) {
    const Device device = test_device();
    const Program code = Program::from_text(device, R"(
#include "lib/exact_float.h"
#include "lib/work_item.h"
kernel void compute(global const float* a, global const float* b, uint n, global float* out) {
    const uint i = work_item() * VXL_LANES;
    if (i >= n) return;
    const lane_float x = LANES_LOAD(a, i), y = LANES_LOAD(b, i);
    LANES_STORE(exact_divide(x, y), out, i);
    LANES_STORE(exact_sqrt(fabs(x)), out, n + i);
    LANES_STORE(exact_reciprocal(y), out, 2u * n + i);
}
)",
                                            {{"VXL_NATIVE_DIVIDE", 0}});
    const auto n = static_cast<uint32_t>(a.size());
    const Buffer<float> a_buffer(device, "a", a), b_buffer(device, "b", b);
    const Buffer<float> out(device, "out", 3 * a.size());
    code.kernel("compute").launch(WorkItem::light, n / device.lanes(), a_buffer, b_buffer, n, out);
    return {out.read(0, n), out.read(n, n), out.read(2 * a.size(), n)};
}

void expect_ieee(const std::vector<float>& a, const std::vector<float>& b) {
    const Results r = corrected(a, b);
    const auto same = [](float x, float y) { return std::memcmp(&x, &y, sizeof(x)) == 0; };
    for (size_t i = 0; i < a.size(); ++i) {
        ASSERT_TRUE(same(r.quotient[i], a[i] / b[i])) << a[i] << " / " << b[i];
        ASSERT_TRUE(same(r.root[i], std::sqrt(std::abs(a[i])))) << "root of " << std::abs(a[i]);
        ASSERT_TRUE(same(r.reciprocal[i], 1 / b[i])) << "1 / " << b[i];
    }
}

TEST(ExactFloat, TheRootOfTheFloatBelowOneIsItself) {
    const std::vector<float> a(16, std::nextafter(1.0f, 0.0f));
    EXPECT_EQ(corrected(a, a).root, a);
}

TEST(ExactFloat, RoundsLikeTheHostOnRandomValues) {
    std::mt19937 random(61);
    std::vector<float> a(1 << 18), b(1 << 18);
    for (size_t i = 0; i < a.size(); ++i) {
        const auto value = [&] {
            const float mantissa = 1 + std::ldexp(static_cast<float>(random() >> 9), -23);
            const float magnitude = std::ldexp(mantissa, static_cast<int>(random() % 40) - 20);
            return random() % 2 ? magnitude : -magnitude;
        };
        a[i] = value(), b[i] = value();
    }
    expect_ieee(a, b);
}

TEST(ExactFloat, RoundsLikeTheHostNearOneAndAtZero) {
    std::vector<float> a, b;
    for (int i = -2048; i < 2048; ++i) {
        a.push_back(1 + std::ldexp(static_cast<float>(i), i < 0 ? -24 : -23));
        b.push_back(1 + std::ldexp(static_cast<float>(i % 64), i % 2 ? -24 : -23));
    }
    for (int i = 0; i < 16; ++i) {
        a.push_back(i % 2 ? 0.0f : -0.0f);
        b.push_back(static_cast<float>(i + 1));
    }
    expect_ieee(a, b);
}

}  // namespace
}  // namespace voxelume
