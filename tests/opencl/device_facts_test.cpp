// SPDX-License-Identifier: Apache-2.0
// What is kept of the device that a selector names, and when it counts.
#include "runtime/opencl/self_test/device_facts.hpp"

#include <gmock/gmock.h>

#include <cstdlib>
#include <filesystem>
#include <optional>
#include <tuple>

#include "runtime/base/error.hpp"
#include "tests/support/file_fixture.hpp"
#include "tests/support/setting.hpp"
#include "tests/support/test_device.hpp"

namespace voxelume {
namespace {

namespace fs = std::filesystem;

class DeviceFacts : public FileTest {
  protected:
    void SetUp() override {
        FileTest::SetUp();
        for (const char* name : {"OCL_ICD_VENDORS", "LD_LIBRARY_PATH"})
            if (std::getenv(name)) GTEST_SKIP() << name << " is set, so that nothing is kept";
        test_device();  // its driver is tested, with the result in the tests' own cache
        cache_.emplace("VOXELUME_CACHE_DIR", folder.string());
        fs::permissions(folder, fs::perms::owner_all);
    }

    /// The number of entries that are kept.
    size_t kept() const {
        std::error_code none;
        size_t count = 0;
        for (const fs::directory_entry& entry : fs::directory_iterator(folder / "devices", none))
            count += size_t(!entry.path().filename().string().starts_with('.'));
        return count;
    }

  private:
    std::optional<Setting> cache_;
};

/// All that plans and messages take of a device.
auto facts_of(const DeviceInfo& info) {
    return std::tuple(info.index, info.kind, info.name, info.vendor, info.platform,
                      info.platform_version, info.version, info.driver, info.memory,
                      info.max_allocation, info.compute_units, info.clock, info.shares_memory,
                      info.card, info.lanes, info.work_group, info.batch_rays, info.build_options,
                      info.self_test, info.unusable, info.note);
}

TEST_F(DeviceFacts, AreThoseOfTheOpenDevice) {
    const DeviceInfo opened = Device::open("cpu").info();
    EXPECT_EQ(facts_of(device_for_plans("cpu")), facts_of(opened));
    EXPECT_EQ(kept(), 1u);
    EXPECT_EQ(facts_of(device_for_plans("cpu")), facts_of(opened));
    EXPECT_EQ(kept(), 1u);
}

TEST_F(DeviceFacts, AreOthersInAnotherEnvironment) {
    device_for_plans("cpu");
    const Setting changed("VXL_OF_SOME_DRIVER", "1");
    device_for_plans("cpu");
    EXPECT_EQ(kept(), 2u);
    const Setting folder_of_shell("OLDPWD", "/somewhere");
    device_for_plans("cpu");
    EXPECT_EQ(kept(), 2u);
}

TEST_F(DeviceFacts, HaveTheLimitsOfThisProcess) {
    const Setting limit("VOXELUME_MEMORY_MB", "64");
    for (int i = 0; i < 2; ++i) EXPECT_EQ(device_for_plans("cpu").memory, uint64_t(64) << 20) << i;
}

TEST_F(DeviceFacts, AreNotKeptWhereTheEnvironmentNamesDrivers) {
    const Setting vendors("OCL_ICD_VENDORS", "/etc/OpenCL/vendors/");
    EXPECT_EQ(device_for_plans("cpu").name, Device::open("cpu").info().name);
    EXPECT_EQ(kept(), 0u);
}

TEST_F(DeviceFacts, OfDevicesThatDontExistAreRefused) {
    EXPECT_THROW(device_for_plans("no such device"), Error);
    EXPECT_EQ(kept(), 0u);
    EXPECT_EQ(device_for_plans("all/1").kind, Device::open_all("all/1").front().info().kind);
}

}  // namespace
}  // namespace voxelume
