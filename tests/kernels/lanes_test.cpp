// SPDX-License-Identifier: Apache-2.0
// Every macro of lib/lanes/lanes.h has the same meaning for each number of lanes.
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <functional>
#include <string>

#include "runtime/opencl/program.hpp"
#include "tests/support/test_device.hpp"

namespace voxelume {
namespace {

constexpr uint32_t kLaneCount = 64;  // a multiple of every number of lanes

const std::vector<float>& floats() {
    static const std::vector<float> values = [] {
        std::vector<float> v;
        for (uint32_t i = 0; i < kLaneCount; ++i) v.push_back((float(i) - 20.25f) * 1.75f);
        return v;
    }();
    return values;
}

const std::vector<int32_t>& integers() {
    static const std::vector<int32_t> values = [] {
        std::vector<int32_t> v;
        for (uint32_t i = 0; i < kLaneCount; ++i) v.push_back((int32_t(i * 2654435761u) >> 3) - 77);
        v[0] = INT32_MIN, v[1] = INT32_MAX, v[2] = 0, v[3] = -1;
        return v;
    }();
    return values;
}

/// Indices into the arrays in no order; some occur twice.
uint32_t shuffled(uint32_t i) {
    return (i * 37 + i / 7) % kLaneCount;
}

/// An expression of a 32-bit lane type, and its expected bits at an index.
struct Case {
    std::string expression;
    std::function<uint32_t(uint32_t)> bits;

    template <class Function>
    Case(std::string text, const Function& expected)
        : expression(std::move(text)),
          bits([expected](uint32_t i) { return std::bit_cast<uint32_t>(expected(i)); }) {}
};

int32_t mask(bool condition) {
    return condition ? -1 : 0;
}

/// The cases of all macros. The expressions may use f, n, i and first.
std::vector<Case> cases_of(uint32_t lanes) {
    std::vector<Case> cases = {
        {"f", [](uint32_t i) { return floats()[i]; }},
        {"n", [](uint32_t i) { return integers()[i]; }},
        {"LANES_GATHER_FLOAT(floats, i)", [](uint32_t i) { return floats()[shuffled(i)]; }},
        {"LANES_GATHER_UINT(indices, i)", [](uint32_t i) { return shuffled(shuffled(i)); }},
        {"LANES_NUMBERS + (int)first", [](uint32_t i) { return i; }},

        // Masks are -1 or 0.
        {"LANE_MASK(f < 3.0f)", [](uint32_t i) { return mask(floats()[i] < 3); }},
        {"LANE_MASK(n >= 0)", [](uint32_t i) { return mask(integers()[i] >= 0); }},
        {"LANE_MASK(i == 5u)", [](uint32_t i) { return mask(shuffled(i) == 5); }},
        {"LANE_LONG_MASK(LANES_LONG(n) * 4 > LANES_LONG(i) << 28)",
         [](uint32_t i) { return mask(int64_t(integers()[i]) * 4 > int64_t(shuffled(i)) << 28); }},
        {"LANE_MASK(f < NAN)", [](uint32_t) { return 0; }},

        // Select takes the first where the mask is set.
        {"LANES_SELECT(LANE_MASK(f > 0.0f), f, -2.0f * f)",
         [](uint32_t i) { return floats()[i] > 0 ? floats()[i] : -2 * floats()[i]; }},
        {"LANES_SELECT(LANE_MASK(f > 0.0f), n, n ^ 1)",
         [](uint32_t i) { return integers()[i] ^ (floats()[i] > 0 ? 0 : 1); }},
        {"LANES_SELECT(LANE_MASK(n < 0), i, (lane_uint)7u)",
         [](uint32_t i) { return integers()[i] < 0 ? shuffled(i) : 7u; }},

        // Conversions truncate and keep signs.
        {"LANES_INT(f)", [](uint32_t i) { return int32_t(std::trunc(floats()[i])); }},
        {"LANES_UINT(fabs(f))", [](uint32_t i) { return uint32_t(std::abs(floats()[i])); }},
        {"LANES_UINT(n)", [](uint32_t i) { return uint32_t(integers()[i]); }},
        {"LANES_FLOAT(n)", [](uint32_t i) { return float(integers()[i]); }},
        {"LANES_FLOAT(LANES_UINT(n))", [](uint32_t i) { return float(uint32_t(integers()[i])); }},
        {"LANES_INT((LANES_LONG(n) * 1000000007L) >> 29)",
         [](uint32_t i) { return int32_t((int64_t(integers()[i]) * 1000000007) >> 29); }},
        {"LANES_INT(LANES_LONG(f * 4.0f))", [](uint32_t i) { return int32_t(4 * floats()[i]); }},
        {"LANES_INT(LANES_SHORT(n >> 16))", [](uint32_t i) { return integers()[i] >> 16; }},

        // Reinterpretation keeps the bits.
        {"LANES_AS_INT(f)", [](uint32_t i) { return floats()[i]; }},
        {"LANES_AS_UINT(n)", [](uint32_t i) { return integers()[i]; }},
        {"LANES_AS_FLOAT(LANES_AS_INT(f) ^ (int)0x80000000)",
         [](uint32_t i) { return -floats()[i]; }},
    };
    // These cases test a function that answers in all lanes of a packet: whether the packet holds
    // an index. An empty mask follows.
    for (const uint32_t index : {0u, 1u, 6u, 7u, 8u, 15u, 37u, 63u})
        cases.push_back({"(lane_int)(lanes_any(LANE_MASK(LANES_NUMBERS + (int)first == " +
                             std::to_string(index) + ")) != 0)",
                         [=](uint32_t at) { return int32_t(at / lanes == index / lanes); }});
    cases.push_back({"(lane_int)(lanes_any(LANE_MASK(n != n)) != 0)", [](uint32_t) { return 0; }});
    return cases;
}

/// The source of one kernel that writes the bits of every expression, kLaneCount apart.
std::string source_of(const std::vector<Case>& cases) {
    std::string source = R"(
#include "lib/lanes/lanes.h"
#include "lib/lanes/work_item.h"
kernel void evaluate(uint count, global const float* floats, global const int* integers,
                     global const uint* indices, global uint* results) {
    const uint first = work_item() * VXL_LANES;
    if (first >= count) return;
    const lane_float f = LANES_LOAD(floats, first);
    const lane_int n = LANES_LOAD(integers, first);
    const lane_uint i = LANES_LOAD(indices, first);
)";
    for (size_t c = 0; c < cases.size(); ++c)
        source += "    LANES_STORE(LANES_AS_UINT(" + cases[c].expression + "), results, " +
                  std::to_string(c) + " * count + first);\n";
    return source + "}\n";
}

class Lanes : public testing::TestWithParam<int> {};

TEST_P(Lanes, EveryMacroMeansTheSame) {
    const Device device = test_device(GetParam());
    const std::vector<Case> cases = cases_of(uint32_t(device.lanes()));
    std::vector<uint32_t> indices;
    for (uint32_t i = 0; i < kLaneCount; ++i) indices.push_back(shuffled(i));
    Buffer<uint32_t> buffer(device, "results", kLaneCount * cases.size());
    Program::from_text(device, source_of(cases))
        .kernel("evaluate")
        .launch_packets(
            kLaneCount, kLaneCount, Buffer<float>(device, "floats", std::span(floats())),
            Buffer<int32_t>(device, "integers", std::span(integers())),
            Buffer<uint32_t>(device, "indices", std::span<const uint32_t>(indices)), buffer);
    const std::vector<uint32_t> results = buffer.read();
    for (size_t c = 0; c < cases.size(); ++c)
        for (uint32_t i = 0; i < kLaneCount; ++i)
            ASSERT_EQ(results[c * kLaneCount + i], cases[c].bits(i))
                << cases[c].expression << " at " << i;
}

INSTANTIATE_TEST_SUITE_P(Lanes, Lanes, testing::Values(1, 4, 8, 16));

}  // namespace
}  // namespace voxelume
