// SPDX-License-Identifier: Apache-2.0
// Which program a folder of PoCL belongs to, where not all of them are ours.
#include "runtime/opencl/quirks/pocl_folder.hpp"

#include <gtest/gtest.h>

#include <cstdlib>
#include <string>
#include <vector>

#include "runtime/opencl/kernel_builds.hpp"
#include "runtime/opencl/program.hpp"
#include "tests/support/file_fixture.hpp"
#include "tests/support/own_process.hpp"
#include "tests/support/test_device.hpp"

namespace voxelume {
namespace {

/// A kernel of this name for each factor. A comment makes another program of an equal kernel.
std::string scaling_source(uint32_t factor, const std::string& comment) {
    return fmt::format(
        "//{}\n#include \"lib/lanes/work_item.h\"\nkernel void scale(uint count, global uint* x) {{"
        "\n    if (work_item() < count) x[work_item()] = {}u * work_item();\n}}\n",
        comment, factor);
}

/// Run in its own process: builds eight programs, whose kernels PoclFolder keeps, after two that it
/// doesn't hear of with VXL_TEST_BESIDE. The exit code is 10 if they compute what they should.
TEST(PoclFolderProcess, DISABLED_BuildsAndRuns) {
    const Device device = test_device();
    if (std::getenv("VXL_TEST_BESIDE"))
        for (const int number : {1, 2})
            build_with_binary(
                compiler_target(device), "a program beside",
                {fmt::format("kernel void beside(global int* x) {{ *x = {}; }}", number),
                 "-cl-std=CL1.2"});
    const uint32_t count = 5;
    const char* const comment = std::getenv("VXL_TEST_COMMENT");
    for (uint32_t factor = 3; factor < 11; ++factor) {
        Buffer<uint32_t> x(device, "x", count);
        Program::from_text(device, scaling_source(factor, comment ? comment : ""))
            .kernel("scale")
            .launch(WorkItem::light, count, count, x);
        const std::vector<uint32_t> result = x.read();
        for (uint32_t i = 0; i < count; ++i) EXPECT_EQ(result[i], i * factor) << factor;
    }
    if (!HasFailure()) std::exit(10);
}

using PoclFolderFiles = FileTest;

TEST_F(PoclFolderFiles, KernelsAreKeptAsThoseOfTheirOwnProgram) {
    if (!keeps_pocl_folder(test_device().info())) GTEST_SKIP() << "this driver isn't PoCL";
    const std::string environment = "VOXELUME_CACHE_DIR=" + folder.string();
    const char* const test = "PoclFolderProcess.DISABLED_BuildsAndRuns";
    EXPECT_EQ(run_own_test(test, environment + " VXL_TEST_BESIDE=1"), 10);
    // Now there are kernels for equal ones, but no programs.
    EXPECT_EQ(run_own_test(test, environment + " VXL_TEST_COMMENT=again"), 10);
}

}  // namespace
}  // namespace voxelume
