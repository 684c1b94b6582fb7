// Every macro of lib/lanes.h means the same in each number of lanes.
#include <gtest/gtest.h>

#include <bit>
#include <cmath>

#include "runtime/opencl/program.hpp"
#include "tests/test_device.hpp"

namespace voxelume {
namespace {

constexpr uint32_t kCount = 64;  // a multiple of every number of lanes

const std::vector<float>& floats() {
    static const std::vector<float> values = [] {
        std::vector<float> v;
        for (uint32_t i = 0; i < kCount; ++i) v.push_back((float(i) - 20.25f) * 1.75f);
        return v;
    }();
    return values;
}

const std::vector<int32_t>& integers() {
    static const std::vector<int32_t> values = [] {
        std::vector<int32_t> v;
        for (uint32_t i = 0; i < kCount; ++i) v.push_back((int32_t(i * 2654435761u) >> 3) - 77);
        v[0] = INT32_MIN, v[1] = INT32_MAX, v[2] = 0, v[3] = -1;
        return v;
    }();
    return values;
}

/// Indices into the arrays, in no order, some of them twice.
uint32_t shuffled(uint32_t i) {
    return (i * 37 + i / 7) % kCount;
}

class Lanes : public testing::TestWithParam<int> {
  protected:
    /// The bits of an expression of a 32-bit lane type for each place; f, n, i, first are at hand.
    std::vector<uint32_t> bits(const std::string& expression) const {
        const Device device = test_device(GetParam());
        std::vector<uint32_t> places;
        for (uint32_t i = 0; i < kCount; ++i) places.push_back(shuffled(i));
        const std::string source = R"(
#include "lib/lanes.h"
#include "lib/work_item.h"
kernel void evaluate(uint count, global const float* floats, global const int* integers,
                     global const uint* places, global uint* results) {
    const uint first = work_item() * VXL_LANES;
    if (first >= count) return;
    const lane_float f = LANES_LOAD(floats, first);
    const lane_int n = LANES_LOAD(integers, first);
    const lane_uint i = LANES_LOAD(places, first);
    LANES_STORE(LANES_AS_UINT()" + expression + R"(), results, first);
}
)";
        Buffer<uint32_t> results(device, "results", kCount);
        Program::from_text(device, source)
            .kernel("evaluate")
            .launch_packets(kCount, kCount, Buffer<float>(device, "floats", std::span(floats())),
                            Buffer<int32_t>(device, "integers", std::span(integers())),
                            Buffer<uint32_t>(device, "places", std::span<const uint32_t>(places)),
                            results);
        return results.read();
    }

    /// Compares with what a host function of a place gives.
    template <class Function>
    void expect(const std::string& expression, const Function& expected) const {
        const std::vector<uint32_t> results = bits(expression);
        for (uint32_t i = 0; i < kCount; ++i)
            ASSERT_EQ(results[i], std::bit_cast<uint32_t>(expected(i))) << expression << " at " << i;
    }
};

int32_t mask(bool condition) {
    return condition ? -1 : 0;
}

TEST_P(Lanes, LoadsAndGathersPlaceByPlace) {
    expect("f", [](uint32_t i) { return floats()[i]; });
    expect("n", [](uint32_t i) { return integers()[i]; });
    expect("LANES_GATHER_FLOAT(floats, i)", [](uint32_t i) { return floats()[shuffled(i)]; });
    expect("LANES_GATHER_UINT(places, i)", [](uint32_t i) { return shuffled(shuffled(i)); });
    expect("LANES_NUMBERS + (int)first", [](uint32_t i) { return i; });
}

TEST_P(Lanes, MasksAreMinusOneOrZero) {
    expect("LANE_MASK(f < 3.0f)", [](uint32_t i) { return mask(floats()[i] < 3); });
    expect("LANE_MASK(n >= 0)", [](uint32_t i) { return mask(integers()[i] >= 0); });
    expect("LANE_MASK(i == 5u)", [](uint32_t i) { return mask(shuffled(i) == 5); });
    expect("LANE_LONG_MASK(LANES_LONG(n) * 4 > LANES_LONG(i) << 28)", [](uint32_t i) {
        return mask(int64_t(integers()[i]) * 4 > int64_t(shuffled(i)) << 28);
    });
    expect("LANE_MASK(f < NAN)", [](uint32_t) { return 0; });
}

TEST_P(Lanes, SelectTakesTheFirstWhereTheMaskIsSet) {
    expect("LANES_SELECT(LANE_MASK(f > 0.0f), f, -2.0f * f)",
           [](uint32_t i) { return floats()[i] > 0 ? floats()[i] : -2 * floats()[i]; });
    expect("LANES_SELECT(LANE_MASK(f > 0.0f), n, n ^ 1)", [](uint32_t i) {
        return integers()[i] ^ (floats()[i] > 0 ? 0 : 1);
    });
    expect("LANES_SELECT(LANE_MASK(n < 0), i, (lane_uint)7u)",
           [](uint32_t i) { return integers()[i] < 0 ? shuffled(i) : 7u; });
}

TEST_P(Lanes, ConversionsTruncateAndKeepSigns) {
    expect("LANES_INT(f)", [](uint32_t i) { return int32_t(std::trunc(floats()[i])); });
    expect("LANES_UINT(fabs(f))", [](uint32_t i) { return uint32_t(std::abs(floats()[i])); });
    expect("LANES_UINT(n)", [](uint32_t i) { return uint32_t(integers()[i]); });
    expect("LANES_FLOAT(n)", [](uint32_t i) { return float(integers()[i]); });
    expect("LANES_FLOAT(LANES_UINT(n))", [](uint32_t i) { return float(uint32_t(integers()[i])); });
    expect("LANES_INT((LANES_LONG(n) * 1000000007L) >> 29)", [](uint32_t i) {
        return int32_t((int64_t(integers()[i]) * 1000000007) >> 29);
    });
    expect("LANES_INT(LANES_LONG(f * 4.0f))", [](uint32_t i) { return int32_t(4 * floats()[i]); });
    expect("LANES_INT(LANES_SHORT(n >> 16))", [](uint32_t i) { return integers()[i] >> 16; });
}

TEST_P(Lanes, BitsPassThroughReinterpretation) {
    expect("LANES_AS_INT(f)", [](uint32_t i) { return floats()[i]; });
    expect("LANES_AS_UINT(n)", [](uint32_t i) { return integers()[i]; });
    expect("LANES_AS_FLOAT(LANES_AS_INT(f) ^ (int)0x80000000)", [](uint32_t i) { return -floats()[i]; });
}

TEST_P(Lanes, AnyIsTrueForEachSingleLane) {
    // A packet's answer, in all of its lanes: whether it holds a place; then for an empty mask.
    const auto lanes = uint32_t(test_device(GetParam()).lanes());
    for (const uint32_t place : {0u, 1u, 6u, 7u, 8u, 15u, 37u, 63u})
        expect("(lane_int)(lanes_any(LANE_MASK(LANES_NUMBERS + (int)first == " +
                   std::to_string(place) + ")) != 0)",
               [&](uint32_t i) { return int32_t(i / lanes == place / lanes); });
    expect("(lane_int)(lanes_any(LANE_MASK(n != n)) != 0)", [](uint32_t) { return 0; });
}

INSTANTIATE_TEST_SUITE_P(Lanes, Lanes, testing::Values(1, 4, 8, 16));

}  // namespace
}  // namespace voxelume
