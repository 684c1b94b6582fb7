// SPDX-License-Identifier: Apache-2.0
#include "runtime/opencl/quirks/llvm_passes.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "runtime/opencl/program.hpp"
#include "tests/support/test_device.hpp"

namespace voxelume {
namespace {

/// True for the versions of PoCL that ask LLVM for its standard passes by the function that
/// programs of ours replace: "OpenCL 3.0 PoCL 3.1+debian  Linux, ..., RELOC, LLVM 15.0.6, ...".
bool asks_for_standard_passes(const DeviceInfo& info) {
    return info.platform == "Portable Computing Language" &&
           info.platform_version.find("PoCL 3.1") != std::string::npos;
}

TEST(LlvmPasses, AreFewForKernelsThatPoclCompilesInOurPrograms) {
    const Device device = test_device();
    if (!asks_for_standard_passes(device.info()))
        GTEST_SKIP() << device.info().platform_version << " asks for its passes otherwise";
    // The kernel holds the time, since no earlier run may have compiled it.
    const std::string number =
        std::to_string(::testing::UnitTest::GetInstance()->start_timestamp());
    const uint32_t count = 5;
    Buffer<uint32_t> numbers(device, "numbers", count);
    Program::from_text(device,
                       "#include \"lib/lanes/work_item.h\"\n"
                       "kernel void fill(uint count, global uint* numbers) {\n"
                       "    if (work_item() >= count) return;\n"
                       "    numbers[work_item()] = (uint)" +
                           number +
                           "UL + work_item();\n"
                           "}\n")
        .kernel("fill")
        .launch(WorkItem::light, count, count, numbers);
    const std::vector<uint32_t> result = numbers.read();
    for (uint32_t i = 0; i < count; ++i) EXPECT_EQ(result[i], uint32_t(std::stoull(number)) + i);
    // PoCL asks once for all kernels of a device.
    EXPECT_GT(few_passes_taken(), 0u);
}

TEST(LlvmPasses, AreThoseOfOtherDriversThemselves) {
    const Device device = test_device();
    if (device.info().platform == "Portable Computing Language") GTEST_SKIP() << "this is PoCL";
    EXPECT_EQ(few_passes_taken(), 0u);
}

}  // namespace
}  // namespace voxelume
