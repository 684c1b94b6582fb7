// SPDX-License-Identifier: Apache-2.0
// A mismatch that `voxelume stress` finds is found again by its number alone. For this test kernels
// are built with faults.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "runtime/verify/stress/stress.hpp"
#include "tests/support/setting.hpp"
#include "tests/support/test_device.hpp"

namespace voxelume {
namespace {

constexpr uint64_t kAgainSeed = 20261122;

/// Floats alone decide where a ray leaves a voxel.
constexpr const char* kNotArbitrated = "-DVXL_ARBITRATE=0";
/// Voxels extend one unit of the lattice too far.
constexpr const char* kTooWide = "-DVXL_MARGIN=1";
/// The voxels that list triangles are smaller than their cubes, and the triangles' boxes are too
/// small.
constexpr const char* kTooNarrow = "-DVXL_MARGIN=-16";
/// Decides points one voxel beyond the bricks whose triangles are gathered for them.
constexpr const char* kCornersBeyond = "-DVXL_CENTERS=2";
constexpr const char* kCentersBeyond = "-DVXL_CENTERS=3";
/// Beams are wider than the empty space that is known around them.
constexpr const char* kWideBeams = "-DVXL_BEAM_RADIUS=12.0f";
/// Takes the world's voxels from a wrong place of the object.
constexpr const char* kElsewhere = "-Dvoxel=low";

struct Fault {
    const char* test;
    const char* options;
    uint64_t first, count;
};

/// Runs begin within a batch; some continue into the next one, which compares something else.
constexpr Fault kFaults[] = {
    {"random", kNotArbitrated, 32791, 20000},
    {"ties", kNotArbitrated, 16381, 40},
    {"grazing", kNotArbitrated, 21, 1000},
    {"corners", kNotArbitrated, 21, 700},
    {"parallel", kNotArbitrated, 150000, 150000},
    {"diagonal", kNotArbitrated, 32771, 700},
    {"faces", kNotArbitrated, 32791, 20000},
    {"far", kNotArbitrated, 49157, 15000},
    {"denormal", kNotArbitrated, 49157, 15000},
    {"thin", kNotArbitrated, 32773, 8000},
    {"thin", kWideBeams, 81925, 60000},
    {"smooth", kCornersBeyond, 16001, 900},
    {"smooth", kWideBeams, 81925, 60000},
    {"exact", kTooNarrow, 65541, 60000},
    {"exact", kWideBeams, 81925, 60000},
    {"solid", kCentersBeyond, 16001, 900},
    {"solid", kWideBeams, 81925, 60000},
    {"triangles", kTooWide, 1030, 600},
    {"triangles", kTooWide, 4500, 400},
    {"crosshairs", kTooNarrow, 1000, 600},
    {"placement", kElsewhere, 25, 4},
};

class StressAgain : public testing::TestWithParam<Fault> {};

TEST(StressAgainFaults, AreThereForEveryTest) {
    for (const StressTest& test : stress_tests())
        EXPECT_TRUE(std::ranges::any_of(kFaults, [&](const Fault& fault) {
            return test.name == fault.test;
        })) << test.name;
}

TEST_P(StressAgain, EveryMismatchIsFoundAloneAsAmongOthers) {
    const Fault& fault = GetParam();
    const Setting setting("VOXELUME_BUILD_OPTIONS", fault.options);
    const Setting untested("VOXELUME_SELF_TEST", "off");  // which finds some of the faults, too
    const Device device = test_device();
    for (const StressTest& test : stress_tests()) {
        if (test.name != fault.test) continue;
        const StressResult among = test.run({device, kAgainSeed, fault.first, fault.count, {}});
        EXPECT_EQ(among.cases, fault.count);
        ASSERT_GT(among.mismatches, 0u);
        for (const StressExample& example : among.examples) {
            EXPECT_GE(example.number, fault.first);
            EXPECT_LT(example.number, fault.first + fault.count);
            const StressResult alone = test.run({device, kAgainSeed, example.number, 1, {}});
            EXPECT_EQ(alone.cases, 1u);
            EXPECT_EQ(alone.mismatches, 1u) << example.number;
            ASSERT_EQ(alone.examples.size(), 1u);
            EXPECT_EQ(alone.examples[0].text, example.text);
            EXPECT_EQ(alone.examples[0].number, example.number);
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Tests, StressAgain, testing::ValuesIn(kFaults), [](const auto& fault) {
    return fmt::format("{}{}From{}", fault.param.test, fault.index, fault.param.first);
});

}  // namespace
}  // namespace voxelume
