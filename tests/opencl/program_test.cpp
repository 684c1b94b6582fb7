#include "runtime/opencl/program.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <numeric>

#include "runtime/opencl/program_cache.hpp"
#include "runtime/stages/features.hpp"
#include "tests/support/test_device.hpp"

namespace voxelume {
namespace {

TEST(Program, NumbersEveryWorkItemOnceAcrossRows) {
    const Device device = test_device();
    const Program program = Program::from_text(device, R"(
#include "lib/lanes/work_item.h"
kernel void write_number(uint count, global uint* numbers) {
    if (work_item() >= count) return;
    numbers[work_item()] += work_item();
}
)");
    const uint32_t count = 40007;  // more than one row of the launch
    Buffer<uint32_t> numbers(device, "numbers", count);
    numbers.fill(0);
    program.kernel("write_number").launch(WorkItem::light, count, count, numbers);
    std::vector<uint32_t> expected(count);
    std::iota(expected.begin(), expected.end(), 0u);
    EXPECT_EQ(numbers.read(), expected);
    EXPECT_EQ(device.counters().launches.at("write_number"), 1u);
}

TEST(Program, IsMadeOnceWhileTheDeviceIsOpen) {
    const Device device = test_device();
    const auto made = [&](const std::string& text, int value) {
        const uint64_t before = device.counters().programs_built;
        Program::from_text(device, text, {{"VALUE", value}});
        return device.counters().programs_built - before;
    };
    EXPECT_EQ(made("kernel void f(global int* x) { *x = VALUE; }\n", 3), 1u);
    EXPECT_EQ(made("kernel void f(global int* x) { *x = VALUE; }\n", 3), 0u);
    EXPECT_EQ(made("kernel void f(global int* x) { *x = VALUE; }\n", 5), 1u);
    EXPECT_EQ(made("kernel void f(global int* x) { *x += VALUE; }\n", 3), 1u);
}

TEST(Program, ConstantsThatTheSourceDoesNotMentionMakeNoOther) {
    const Device device = test_device();
    const auto made = [&](const Defines& defines) {
        const uint64_t before = device.counters().programs_built;
        Program::from_text(device, "kernel void g(global int* x) { *x = VALUE + VALUES_2; }\n",
                           defines);
        return device.counters().programs_built - before;
    };
    EXPECT_EQ(made({{"VALUE", 3}, {"VALUES_2", 1}}), 1u);
    EXPECT_EQ(made({{"VALUE", 3}, {"VALUES_2", 1}, {"VALUES", 7}, {"VAL", 5}}), 0u);
    EXPECT_EQ(made({{"VALUE", 3}, {"VALUES_2", 2}}), 1u);
}

TEST(Program, FilesBuiltTogetherAreOneUntilTheirConstantsDiffer) {
    const Device device = test_device();
    Features features;
    features.cubes = true;
    const std::array<const char*, 2> files = {"trace.cl", "shade.cl"};
    Program::build_together(device, files, features.defines(device));
    EXPECT_EQ(device.counters().programs_built, 1u);
    Program(device, "shade.cl", features.defines(device)).kernel("shade_surface");
    Program(device, "trace.cl", features.defines(device)).kernel("trace_closest");
    Program::build_together(device, files, features.defines(device));
    EXPECT_EQ(device.counters().programs_built, 1u);
    features.smooth = true;
    Program(device, "trace.cl", features.defines(device));
    EXPECT_EQ(device.counters().programs_built, 2u);
}

TEST(Program, FilesBuiltTogetherAreThoseThatWereNotBuiltBefore) {
    const Device device = test_device();
    Features features;
    features.cubes = true;
    const std::array<const char*, 2> files = {"sight.cl", "light.cl"};
    Program::build_together(device, files, features.defines(device));
    features.shadows = true;  // which only light.cl mentions
    Program::build_together(device, files, features.defines(device));
    const auto programs_with = [&](const std::string& kernel) {
        return std::ranges::count_if(program_sources(device), [&](const std::string& source) {
            return source.find(kernel) != std::string::npos;
        });
    };
    EXPECT_EQ(programs_with("kernel void add_light"), 2);
    EXPECT_EQ(programs_with("kernel void cast_sight"), 1);
}

TEST(Program, NamesTheKernelFileAndLineOfAnError) {
    const Device device = test_device();
    if (device.info().platform == "Oclgrind") GTEST_SKIP() << "its compiler ignores #line";
    try {
        Program::from_text(device,
                           "#include \"lib/lanes/work_item.h\"\nkernel void f() { y = 1; }\n");
        FAIL() << "compiled";
    } catch (const Error& error) {
        EXPECT_EQ(error.kind(), ErrorKind::build);
        EXPECT_NE(std::string(error.what()).find("text:2"), std::string::npos) << error.what();
    }
}

}  // namespace
}  // namespace voxelume
