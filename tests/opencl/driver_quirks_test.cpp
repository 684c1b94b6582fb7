// SPDX-License-Identifier: Apache-2.0
#include "runtime/opencl/quirks/driver_quirks.hpp"

#include <gtest/gtest.h>

#include "runtime/opencl/device_settings.hpp"
#include "tests/support/setting.hpp"

namespace voxelume {
namespace {

TEST(DriverQuirks, AreThoseOfThePlatformsRowAndNobodyElses) {
    EXPECT_EQ(driver_quirks("Oclgrind").keeping, ProgramKeeping::none);
    EXPECT_FALSE(driver_quirks("Oclgrind").compiles_side_by_side);
    EXPECT_EQ(driver_quirks("Intel(R) OpenCL").max_work_group, 8);
    EXPECT_EQ(driver_quirks("Intel(R) OpenCL Graphics").max_work_group, 0);
    EXPECT_EQ(driver_quirks("Portable Computing Language").keeping, ProgramKeeping::pocl_folder);
    for (const char* const name : {"", "NVIDIA CUDA", "Intel(R) OpenCL", "Oclgrind 2"}) {
        const DriverQuirks& quirks = driver_quirks(name);
        EXPECT_EQ(quirks.keeping, ProgramKeeping::binaries) << name;
        EXPECT_TRUE(quirks.build_options.empty()) << name;
        EXPECT_TRUE(quirks.compiles_side_by_side) << name;
        EXPECT_FALSE(quirks.is_slow_to_declare) << name;
    }
}

TEST(DriverQuirks, LimitTheGroupsThatAreAskedFor) {
    const Setting group("VOXELUME_WORK_GROUP", "16");
    EXPECT_EQ(settled({.platform = "Intel(R) OpenCL"}, 16).work_group, 8);
    EXPECT_EQ(settled({.platform = "Portable Computing Language"}, 16).work_group, 16);
}

TEST(DriverQuirks, KnowMakersByAnyNameThatTheirDriversGive) {
    EXPECT_EQ(floats_per_unit("NVIDIA Corporation"), 128);
    EXPECT_EQ(floats_per_unit("Advanced Micro Devices, Inc."), floats_per_unit("AMD"));
    EXPECT_EQ(floats_per_unit("a maker nobody knows"), 32);
}

}  // namespace
}  // namespace voxelume
