// SPDX-License-Identifier: Apache-2.0
#include "runtime/opencl/device.hpp"

#include <gtest/gtest.h>

#include <fstream>

#include "runtime/opencl/program.hpp"
#include "runtime/opencl/status.hpp"
#include "tests/support/file_fixture.hpp"
#include "tests/support/setting.hpp"
#include "tests/support/test_device.hpp"

namespace voxelume {
namespace {

using DriverFilesDeathTest = FileTest;

/// The kind and the sentence of the error that opening `selector` throws.
std::pair<int, std::string> refusal(std::string_view selector, int lanes = 0) {
    try {
        Device::open(selector, lanes);
    } catch (const Error& error) {
        return {error.exit_code(), error.what()};
    }
    return {0, "opened"};
}

TEST(Device, IsChosenByIndexByKindAndByPartOfItsName) {
    const std::vector<DeviceInfo> devices = list_devices();
    ASSERT_FALSE(devices.empty());
    for (const DeviceInfo& info : devices) {
        if (!info.unusable.empty()) continue;
        EXPECT_EQ(Device::open(std::to_string(info.index)).info().index, info.index);
        EXPECT_EQ(Device::open(info.name).info().name, info.name);
        std::string part = info.name.substr(1, 5);
        for (char& c : part) c = char(std::toupper(c));
        EXPECT_NO_THROW(Device::open(part)) << part;
    }
    EXPECT_NO_THROW(Device::open("auto"));
}

TEST(Device, VoxelumeDeviceCountsOnlyWhenNothingElseIsAskedFor) {
    const Setting environment("VOXELUME_DEVICE", "no such thing");
    EXPECT_EQ(refusal("").first, 6);
    EXPECT_NE(refusal("").second.find("no such thing"), std::string::npos);
    EXPECT_NO_THROW(Device::open("auto"));
}

TEST(Device, ANameThatMatchesNothingIsAnsweredWithWhatThereIs) {
    const auto [code, sentence] = refusal("warp drive");
    EXPECT_EQ(code, 6);
    EXPECT_NE(sentence.find("\"warp drive\""), std::string::npos);
    EXPECT_NE(sentence.find("[0] " + list_devices().at(0).name), std::string::npos);
    EXPECT_EQ(refusal("99").first, 6);
    EXPECT_EQ(refusal("-1").first, 6);
}

TEST(Device, LanesAreTheCallersThenVoxelumeLanesThenTheDevices) {
    const int native = Device::open("").lanes();
    EXPECT_TRUE(native == 1 || native == 4 || native == 8 || native == 16) << native;
    const Setting environment("VOXELUME_LANES", "4");
    EXPECT_EQ(Device::open("").lanes(), 4);
    EXPECT_EQ(Device::open("", 8).lanes(), 8);
    EXPECT_EQ(list_devices().at(0).lanes, native);
}

TEST(Device, LanesWithoutKernelsAreRefused) {
    EXPECT_EQ(refusal("", 3).first, 2);
    const Setting environment("VOXELUME_LANES", "many");
    EXPECT_EQ(refusal("").first, 2);
    EXPECT_NE(refusal("").second.find("many"), std::string::npos);
}

TEST(Device, TheEnvironmentKeepsItWithinSomeOfItsMemory) {
    const DeviceInfo whole = Device::open("").info();
    const Setting buffer("VOXELUME_BUFFER_MB", "3");
    EXPECT_EQ(Device::open("").info().memory, whole.memory);
    EXPECT_EQ(Device::open("").info().max_allocation, 3u << 20);
    const Setting memory("VOXELUME_MEMORY_MB", "2");
    EXPECT_EQ(Device::open("").info().memory, 2u << 20);
    EXPECT_EQ(Device::open("").info().max_allocation, 2u << 20);
    for (const DeviceInfo& listed : list_devices()) EXPECT_EQ(listed.memory, 2u << 20);
    const Setting more("VOXELUME_MEMORY_MB", "2000000000");
    EXPECT_EQ(Device::open("").info().memory, whole.memory);
    for (const char* text : {"2.5", "3e9", "3000000000", "0", "-1"}) {
        const Setting wrong("VOXELUME_MEMORY_MB", text);
        EXPECT_EQ(refusal("").first, 2) << text;
        EXPECT_NE(refusal("").second.find("a whole number from 1 to 2147483647, in digits"),
                  std::string::npos);
    }
}

TEST(Device, TimesItsKernelsWhenAsked) {
    const Device device = test_device();
    Kernel spin = Program::from_text(device,
                                     "kernel void spin(global uint* x) {\n"
                                     "    for (uint i = 0; i < 100000; ++i) *x = *x * 5 + i;\n"
                                     "}\n")
                      .kernel("spin");
    Buffer<uint32_t> x(device, "x", 1);
    x.fill(1);
    spin.launch(WorkItem::heavy, 1, x);
    device.finish();
    EXPECT_TRUE(device.counters().kernel_ms.empty());
    device.time_kernels(true);
    for (int i = 0; i < 3; ++i) spin.launch(WorkItem::heavy, 1, x);
    device.finish();
    EXPECT_GT(device.counters().kernel_ms.at("spin"), 0.001);
    EXPECT_EQ(device.counters().launches.at("spin"), 4u);
    EXPECT_GT(device.counters().build_ms, 0);
}

TEST(Status, HasItsName) {
    EXPECT_EQ(status_name(-5), "CL_OUT_OF_RESOURCES (-5)");
    EXPECT_EQ(status_name(-9999), "status -9999");
}

/// Opens any device in a new process that finds its drivers in `folder`. It takes a new process
/// because the ICD loader reads the folder once.
void open_with_drivers(const std::filesystem::path& folder) {
    setenv("OCL_ICD_VENDORS", (folder.string() + "/").c_str(), 1);
    const auto [code, sentence] = refusal("auto");
    std::fprintf(stderr, "%s\n", sentence.c_str());
    std::filesystem::remove_all(folder);  // exit() leaves out what TearDown() does
    std::exit(code);
}

TEST_F(DriverFilesDeathTest, WithoutAnyDriverThePackageToInstallIsNamed) {
    GTEST_FLAG_SET(death_test_style, "threadsafe");
    EXPECT_EXIT(open_with_drivers(folder), testing::ExitedWithCode(6), "pocl-opencl-icd");
}

TEST_F(DriverFilesDeathTest, ADriverThatIsMissingIsPassedOver) {
    GTEST_FLAG_SET(death_test_style, "threadsafe");
    std::ofstream(folder / "bogus.icd") << "libno-such-driver.so.1\n";
    EXPECT_EXIT(open_with_drivers(folder), testing::ExitedWithCode(6), "pocl-opencl-icd");
    if (std::filesystem::exists("/etc/OpenCL/vendors/pocl.icd")) {
        std::filesystem::copy("/etc/OpenCL/vendors/pocl.icd", folder / "pocl.icd");
        EXPECT_EXIT(open_with_drivers(folder), testing::ExitedWithCode(0), "opened");
    }
}

}  // namespace
}  // namespace voxelume
