// SPDX-License-Identifier: Apache-2.0
#include "runtime/opencl/ranking.hpp"

#include <gmock/gmock.h>

#include "runtime/base/error.hpp"

namespace voxelume {
namespace {

DeviceInfo cpu(const char* name, int units, int lanes, int clock) {
    DeviceInfo info;
    info.kind = DeviceKind::cpu;
    info.name = name;
    info.platform = name;
    info.compute_units = units;
    info.lanes = lanes;
    info.clock = clock;
    info.shares_memory = true;
    return info;
}

DeviceInfo gpu(const char* vendor, int units, int clock, bool shares_memory = false) {
    DeviceInfo info;
    info.kind = DeviceKind::gpu;
    info.name = info.vendor = info.platform = vendor;
    info.compute_units = units;
    info.clock = clock;
    info.shares_memory = shares_memory;
    return info;
}

/// The devices, given without a driver, that `selector` chooses.
std::string chosen(std::vector<DeviceInfo> devices, std::string_view selector = "auto") {
    for (size_t i = 0; i < devices.size(); ++i) devices[i].index = int(i);
    return devices[best_device(devices, selector)].name;
}

const DeviceInfo kPocl = cpu("pthread-znver3", 2, 8, 3000);
const DeviceInfo kRasterizer = cpu("llvmpipe (LLVM 15.0.6, 256 bits)", 8, 1, 0);

TEST(Ranking, NamesWhatAnOldOrSmallDeviceLacks) {
    EXPECT_EQ(missing_ability(DeviceKind::gpu, "OpenCL 1.1 Mesa 20", 256),
              "it speaks OpenCL 1.1, and kernels need 1.2");
    EXPECT_EQ(missing_ability(DeviceKind::gpu, "OpenCL 1.2 ", 32),
              "its groups have at most 32 work-items, and kernels need 64");
    EXPECT_EQ(missing_ability(DeviceKind::cpu, "OpenCL 3.0 PoCL", 16), "");
    EXPECT_EQ(missing_ability(DeviceKind::gpu, "a vendor's own text", 64), "");
}

TEST(Ranking, PutsCardsBeforeProcessorsAndTheirOwnMemoryBeforeTheHosts) {
    EXPECT_EQ(chosen({cpu("server", 128, 16, 3000), gpu("Intel(R) Corporation", 24, 1000, true)}),
              "Intel(R) Corporation");
    EXPECT_EQ(
        chosen({gpu("Intel(R) Corporation", 512, 2000, true), gpu("NVIDIA Corporation", 10, 1000)}),
        "NVIDIA Corporation");
}

TEST(Ranking, CountsWhatAUnitDoesAtOnce) {
    EXPECT_EQ(chosen({gpu("Intel(R) Corporation", 96, 1300), gpu("NVIDIA Corporation", 68, 1700)}),
              "NVIDIA Corporation");
    EXPECT_EQ(chosen({gpu("Advanced Micro Devices, Inc.", 60, 2400),
                      gpu("NVIDIA Corporation", 46, 1700)}),
              "NVIDIA Corporation");
    EXPECT_EQ(chosen({cpu("wide", 8, 16, 2000), cpu("narrow", 12, 4, 2000)}), "wide");
    EXPECT_EQ(chosen({cpu("slow", 8, 8, 2000), cpu("fast", 8, 8, 4000)}), "fast");
    EXPECT_EQ(chosen({cpu("first", 8, 8, 2000), cpu("second", 8, 8, 2000)}), "first");
}

TEST(Ranking, SoftwareRasterizersAreUsedOnlyByName) {
    EXPECT_EQ(chosen({kRasterizer, kPocl}), kPocl.name);
    EXPECT_EQ(chosen({kRasterizer, kPocl}, "cpu"), kPocl.name);
    EXPECT_EQ(chosen({kRasterizer, kPocl}, "LLVMpipe"), kRasterizer.name);
    EXPECT_EQ(chosen({kRasterizer, kPocl}, "0"), kRasterizer.name);
    try {
        chosen({kRasterizer});
        FAIL() << "should not be used";
    } catch (const Error& error) {
        EXPECT_EQ(error.kind(), ErrorKind::device);
        EXPECT_THAT(error.what(), testing::HasSubstr("used only if it is named"));
    }
}

TEST(Ranking, ACardOfTwoDriversSharesWorkOnce) {
    std::vector<DeviceInfo> devices = {gpu("Mesa", 68, 0), gpu("NVIDIA Corporation", 68, 1700),
                                       gpu("Mesa", 68, 0), kRasterizer, kPocl};
    for (const size_t one_card : {0, 1}) devices[one_card].card = "0000:01:00.0";
    devices[2].card = "0000:02:00.0";
    EXPECT_EQ(distinct_gpus(devices), (std::vector<size_t>{1, 2}));
}

}  // namespace
}  // namespace voxelume
