// SPDX-License-Identifier: Apache-2.0
// The answers that a driver's self-test takes for right, computed once more by the host.
#include "runtime/opencl/self_test/self_test.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <bit>
#include <climits>
#include <cmath>
#include <vector>

#include "kernels/shared/trace.h"
#include "runtime/opencl/self_test/known_answers.hpp"
#include "tests/oracles/cell_walk.hpp"
#include "tests/support/file_fixture.hpp"
#include "tests/support/setting.hpp"
#include "tests/support/test_device.hpp"

namespace voxelume {
namespace {

using KeptFaults = FileTest;

constexpr int kFractionBits = 19;  // of rays in a world of 20 voxels

uint32_t question(int row, int column) {
    return known_questions()[size_t(row)].words[size_t(column)];
}
float float_of(int row, int column) {
    return std::bit_cast<float>(question(row, column));
}
int32_t i_of(int column) {
    return int32_t(question(VXL_KNOWN_I, column));
}
int32_t j_of(int column) {
    return int32_t(question(VXL_KNOWN_J, column));
}
uint32_t answer(int row, int column) {
    return known_answers()[size_t(row)].words[size_t(column)];
}

/// Holds a row of answers against `expected` of each column.
template <class Expected>
void expect_row(int row, const Expected& expected) {
    for (int column = 0; column < VXL_KNOWN_COLUMNS; ++column)
        EXPECT_EQ(answer(row, column), std::bit_cast<uint32_t>(expected(column)))
            << known_answers()[size_t(row)].what << " " << column;
}

/// Holds a row of answers, which round well but not best, against real numbers.
template <class Exact>
void expect_near(int row, const Exact& exact, double units) {
    for (int column = 0; column < VXL_KNOWN_COLUMNS; ++column) {
        const double right = exact(column);
        const double unit = std::ldexp(1.0, std::ilogb(right) - 23);
        EXPECT_NEAR(std::bit_cast<float>(answer(row, column)), right, units * unit)
            << known_answers()[size_t(row)].what << " " << column;
    }
}

TEST(KnownAnswers, AreRoundedAsTheHostRounds) {
    const auto x = [](int k) { return float_of(VXL_KNOWN_X, k); };
    const auto y = [](int k) { return float_of(VXL_KNOWN_Y, k); };
    const auto z = [](int k) { return float_of(VXL_KNOWN_Z, k); };
    expect_row(VXL_KNOWN_RECIPROCAL, [&](int k) { return 1.0f / x(k); });
    expect_row(VXL_KNOWN_QUOTIENT, [&](int k) { return y(k) / x(k); });
    expect_row(VXL_KNOWN_ROOT, [&](int k) { return std::sqrt(x(k)); });
    expect_row(VXL_KNOWN_FUSED, [&](int k) { return std::fma(x(k), y(k), z(k)); });
    expect_row(VXL_KNOWN_UNFUSED, [&](int k) {
        const volatile float product = x(k) * y(k);
        return product + z(k);
    });
    expect_row(VXL_KNOWN_WHOLE, [&](int k) { return int32_t(std::nearbyint(y(k) * 64)); });
    expect_row(VXL_KNOWN_FROM_INT, [](int k) { return float(i_of(k)); });
}

TEST(KnownAnswers, OfFunctionsAreCloseToTheirValues) {
    const auto x = [](int k) { return double(float_of(VXL_KNOWN_X, k)); };
    const auto y = [](int k) { return double(float_of(VXL_KNOWN_Y, k)); };
    expect_near(
        VXL_KNOWN_EXPONENTIAL, [&](int k) { return std::exp(y(k)); }, 2);
    expect_near(
        VXL_KNOWN_LOGARITHM, [&](int k) { return std::log(x(k)); }, 2);
    expect_near(
        VXL_KNOWN_SINE, [&](int k) { return std::sin(y(k)); }, 3);
    expect_near(
        VXL_KNOWN_COSINE, [&](int k) { return std::cos(y(k)); }, 3);
}

TEST(KnownAnswers, OfIntegersAreExact) {
    __extension__ using Wide = __int128;
    const auto product = [](int k) { return Wide(i_of(k)) * j_of(k); };
    const auto both = [](int k) { return (Wide(i_of(k)) << 32) + Wide(uint32_t(j_of(k))); };
    const auto divisor = [](int k) { return 2 * Wide(j_of(k)) + 1; };
    expect_row(VXL_KNOWN_BITS, [](int k) { return std::popcount(uint32_t(i_of(k))); });
    expect_row(VXL_KNOWN_LONG_PRODUCT, [&](int k) { return uint32_t(product(k) >> 16); });
    expect_row(VXL_KNOWN_LONG_COMPARISON,
               [&](int k) { return 3 * product(k) <= Wide(i_of(k)) * i_of(k) ? UINT32_MAX : 0; });
    expect_row(VXL_KNOWN_LONG_QUOTIENT, [&](int k) { return uint32_t(both(k) / divisor(k)); });
    expect_row(VXL_KNOWN_LONG_REMAINDER, [&](int k) { return uint32_t(both(k) % divisor(k)); });
    expect_row(VXL_KNOWN_LONG_SHIFT, [&](int k) { return uint32_t(both(k) >> (j_of(k) & 63)); });
    expect_row(VXL_KNOWN_UPPER_HALF, [&](int k) { return uint32_t(product(k) >> 32); });
    expect_row(VXL_KNOWN_LEADING_ZEROS,
               [](int k) { return std::countl_zero(uint32_t(i_of(k)) >> (j_of(k) & 31)); });
    expect_row(VXL_KNOWN_PRIVATE_ARRAY, [](int k) {
        uint32_t sum = 0;
        for (uint32_t digit = 0; digit < 4; ++digit) {
            uint32_t count = 0;
            for (int bit = 0; bit < 32; bit += 2)
                count += ((uint32_t(i_of(k)) >> bit) & 3) == digit;
            sum += count * count;
        }
        return sum;
    });
    expect_row(VXL_KNOWN_LONG_LOOP, [](int k) {
        auto number = uint32_t(j_of(k));
        for (int left = 140000 + (i_of(k) & 63); left > 0; --left) {
            number ^= number << 13;
            number ^= number >> 17;
            number ^= number << 5;
        }
        return number;
    });
    expect_row(VXL_KNOWN_VECTOR, [](int k) {
        const int start = i_of(k) & 15;
        return (120 - start * (start - 1) / 2) * int16_t(j_of(k));
    });
}

TEST(KnownAnswers, OfAtomicOperationsDoNotDependOnTheirOrder) {
    std::vector<uint32_t> expected = {VXL_KNOWN_COLUMNS, 0, 0, uint32_t(INT_MAX)};
    expected.resize(VXL_KNOWN_COLUMNS, 0);
    for (int k = 0; k < VXL_KNOWN_COLUMNS; ++k) {
        expected[1] += question(VXL_KNOWN_J, k);
        expected[2] |= 1u << (question(VXL_KNOWN_I, k) & 31);
        expected[3] = uint32_t(std::min(int32_t(expected[3]), i_of(k)));
    }
    expect_row(VXL_KNOWN_ATOMICS, [&](int k) { return expected[size_t(k)]; });
}

/// The axis of the world's side on which a ray comes in; 3 if it doesn't begin on one.
int side_of(const glm::dvec3& o, const glm::dvec3& d) {
    for (int a = 0; a < 3; ++a)
        if ((o[a] == 0 && d[a] > 0) || (o[a] == VXL_KNOWN_WORLD && d[a] < 0)) return a;
    return 3;
}

TEST(KnownAnswers, OfRaysAreThoseOfExactWalks) {
    oracle::VoxelSet voxels;
    for (const auto& v : known_voxels()) voxels.emplace(v[0], v[1], v[2]);
    for (int k = 0; k < VXL_KNOWN_COLUMNS; ++k) {
        glm::dvec3 o, d;
        for (int a = 0; a < 3; ++a) {
            o[a] = float_of(VXL_KNOWN_RAYS + VXL_RAY_OX + a, k);
            d[a] = float_of(VXL_KNOWN_RAYS + VXL_RAY_DX + a, k);
        }
        const oracle::FirstHit hit =
            oracle::first_hit(o, d, glm::ivec3(VXL_KNOWN_WORLD), kFractionBits, voxels);
        const int axis = hit.axis == 3 ? side_of(o, d) : hit.axis;
        ASSERT_TRUE(hit.hit) << k;
        EXPECT_EQ(answer(VXL_KNOWN_HIT_CELL, k),
                  uint32_t(hit.cell.x | hit.cell.y << 8 | hit.cell.z << 16 | axis << 24))
            << k;
        EXPECT_FLOAT_EQ(std::bit_cast<float>(answer(VXL_KNOWN_HIT_T, k)), float(hit.t)) << k;
    }
}

TEST(SelfTest, ThisDeviceGivesTheKnownAnswersForEachNumberOfLanes) {
    for (const int lanes : {1, 4, 8, 16})
        EXPECT_EQ(find_fault(test_device(lanes)), "") << lanes << " lanes";
    EXPECT_EQ(test_device().info().self_test, SelfTest::passed);
}

TEST(SelfTest, GroupsOfAnySizeGiveThem) {
    for (const char* size : {"1", "16", "64"}) {
        const Setting group("VOXELUME_WORK_GROUP", size);
        EXPECT_EQ(find_fault(test_device(1)), "") << size;
    }
}

TEST_F(KeptFaults, AreThoseOfOneDriverAndOneNumberOfLanes) {
    const Setting cache("VOXELUME_CACHE_DIR", folder.c_str());
    DeviceInfo info;
    info.name = "a card of " + folder.string();  // other tests keep results in this process, too
    info.driver = "1.2.3";
    EXPECT_FALSE(kept_fault(info));
    keep_fault(info, "");
    EXPECT_EQ(kept_fault(info), "");
    DeviceInfo newer = info;
    newer.driver = "1.2.4";
    EXPECT_FALSE(kept_fault(newer));
    keep_fault(newer, "its sums are wrong");
    EXPECT_EQ(kept_fault(newer), "its sums are wrong");
    EXPECT_EQ(kept_fault(info), "");
    DeviceInfo wider = info, unoptimized = info, grouped = info;
    wider.lanes = 16;
    unoptimized.build_options = "-cl-opt-disable";
    grouped.work_group = 64;
    for (const DeviceInfo& other : {wider, unoptimized, grouped}) EXPECT_FALSE(kept_fault(other));
}

TEST(SelfTest, OfAnotherModeIsRefused) {
    const Setting setting("VOXELUME_SELF_TEST", "maybe");
    try {
        Device::open("cpu");
        FAIL() << "should not open";
    } catch (const Error& error) {
        EXPECT_EQ(error.kind(), ErrorKind::usage);
        EXPECT_THAT(error.what(), testing::HasSubstr("VOXELUME_SELF_TEST=maybe"));
    }
}

}  // namespace
}  // namespace voxelume
