// SPDX-License-Identifier: Apache-2.0
#include "runtime/opencl/program.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <numeric>

#include "runtime/base/error.hpp"
#include "runtime/opencl/buffer.hpp"
#include "runtime/opencl/build_log.hpp"
#include "runtime/opencl/program_cache.hpp"
#include "runtime/stages/features.hpp"
#include "tests/support/test_device.hpp"

namespace voxelume {
namespace {

constexpr const char* kAlone = "this device's kernels are compiled alone, when they are launched";

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
    if (compiles_kernels_alone(device.info())) GTEST_SKIP() << kAlone;
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

TEST(Program, WarningsOfTheCompilerAreNotPrinted) {
    const Device device = test_device();
    if (device.info().platform == "Oclgrind") GTEST_SKIP() << "it prints what it likes";
    testing::internal::CaptureStderr();
    const Program program =
        Program::from_text(device, "#warning told\nkernel void h(global int* x) { *x = 9; }\n");
    EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

TEST(Program, ThatDoesNotCompileSaysTheFirstErrorsAndNoOptions) {
    const Device device = test_device();
    testing::internal::CaptureStderr();  // to which compilers say more
    std::string told;
    try {
        const Program program = Program::from_text(
            device, "kernel void wrong(global int* x) { *x = unheard_of + VALUE; }\n",
            {{"VALUE", 7}});
        program.kernel("wrong").launch(WorkItem::light, 1, Buffer<int32_t>(device, "x", 1));
    } catch (const Error& error) {
        EXPECT_EQ(error.kind(), ErrorKind::build);
        told = error.what();
    }
    testing::internal::GetCapturedStderr();
    EXPECT_THAT(told, testing::HasSubstr(" does not compile on \""));
    EXPECT_THAT(told, testing::HasSubstr("unheard_of"));
    EXPECT_THAT(told, testing::Not(testing::HasSubstr("-D")));
    EXPECT_LT(told.size(), 700u);
}

TEST(BuildLog, IsToldByItsFirstErrors) {
    EXPECT_EQ(first_errors(""), "");
    EXPECT_EQ(first_errors("\n  \nno room\n"), "no room");
    std::string log = "warning: all is strange\nkernels/a.cl:1:2: error: no x\n    y = x;\n  ^\n";
    EXPECT_EQ(first_errors(log), "kernels/a.cl:1:2: error: no x");
    for (int i = 0; i < 7; ++i) log += "kernels/b.cl:1:2: error: " + std::string(300, 'z') + "\n";
    EXPECT_THAT(first_errors(log), testing::EndsWith("zz...\n  and 3 more"));
    EXPECT_LT(first_errors(log).size(), 1000u);
}

TEST(Program, ConstantsThatTheSourceDoesNotMentionMakeNoOther) {
    const Device device = test_device();
    if (compiles_kernels_alone(device.info())) GTEST_SKIP() << kAlone;
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
    if (compiles_kernels_alone(device.info())) GTEST_SKIP() << kAlone;
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
    if (compiles_kernels_alone(device.info())) GTEST_SKIP() << kAlone;
    Features features;
    features.cubes = true;
    const std::array<const char*, 2> files = {"sight.cl", "light.cl"};
    Program::build_together(device, files, features.defines(device));
    features.shadows = true;  // a feature that only light.cl mentions
    Program::build_together(device, files, features.defines(device));
    const auto programs_with = [&](const std::string& kernel) {
        return std::ranges::count_if(program_sources(device), [&](const std::string& source) {
            return source.find(kernel) != std::string::npos;
        });
    };
    EXPECT_EQ(programs_with("kernel void add_light"), 2);
    EXPECT_EQ(programs_with("kernel void cast_sight"), 1);
}

/// A structure with two buffers and a number.
struct Pair {
    Buffer<uint32_t> numbers;
    Buffer<float> shares;
    uint32_t stride = 0;
};

void bind(KernelArguments& to, const Pair& pair) {
    to.add(pair.numbers, pair.shares, pair.stride);
}

constexpr const char* kAddPair = R"(
#include "lib/lanes/work_item.h"
kernel void add_pair(uint count, global uint* numbers, global float* shares, uint stride,
                     global float* sums) {
    const uint i = work_item();
    if (i < count) sums[i] = (float)numbers[i] + shares[stride * i];
}
)";

/// The error that a launch of add_pair with these arguments throws.
template <class... Args>
std::string refusal(const Args&... args) {
    try {
        const Device device = test_device();
        Program::from_text(device, kAddPair).kernel("add_pair").launch(WorkItem::light, 3, args...);
        device.finish();
        return "none";
    } catch (const Error& error) {
        EXPECT_EQ(error.kind(), ErrorKind::render);
        return error.what();
    }
}

TEST(Program, AStructureIsBoundAsItsMembersAreInTheOrderOfItsBindFunction) {
    const Device device = test_device();
    const std::vector<uint32_t> numbers = {3, 5, 7};
    const std::vector<float> shares = {0.5f, 90, 0.25f, 91, 0.125f, 92};
    const Pair pair = {{device, "numbers", std::span<const uint32_t>(numbers)},
                       {device, "shares", std::span<const float>(shares)},
                       2};
    const Buffer<float> sums(device, "sums", 3);
    Kernel add = Program::from_text(device, kAddPair).kernel("add_pair");
    add.launch(WorkItem::light, 3, 3u, pair, sums);
    EXPECT_EQ(sums.read(), (std::vector<float>{3.5f, 5.25f, 7.125f}));
}

TEST(Program, AnotherNumberOfArgumentsThanParametersIsRefusedWithBoth) {
    const Device device = test_device();
    const Buffer<uint32_t> numbers(device, "numbers", 3);
    const Buffer<float> shares(device, "shares", 3);
    EXPECT_EQ(refusal(3u, numbers, shares, 1u),
              "kernel add_pair has 5 parameters, but gets 4 arguments");
    EXPECT_EQ(refusal(3u, numbers, shares, 1u, shares, shares),
              "kernel add_pair has 5 parameters, but gets at least 6 arguments");
}

TEST(Program, AnArgumentOfAnotherTypeThanItsParameterIsRefusedWithBoth) {
    const Device device = test_device();
    const Buffer<uint32_t> numbers(device, "numbers", 3);
    const Buffer<float> shares(device, "shares", 3);
    if (refusal(3u, shares, numbers, 1u, shares) == "none")
        GTEST_SKIP() << "this driver keeps no types of parameters";
    EXPECT_EQ(refusal(3u, shares, shares, 1u, shares),
              "kernel add_pair: argument 1 is a buffer of float, but the parameter is uint*");
    EXPECT_EQ(refusal(3u, numbers, 1u, 1u, shares),
              "kernel add_pair: argument 2 is a value of type uint, but the parameter is float*");
    EXPECT_EQ(refusal(3u, numbers, shares, 1.0f, shares),
              "kernel add_pair: argument 3 is a value of type float, but the parameter is uint");
    EXPECT_EQ(refusal(3u, numbers, shares, shares, shares),
              "kernel add_pair: argument 3 is a buffer of float, but the parameter is uint");
}

TEST(Program, NamesTheKernelFileAndLineOfAnError) {
    const Device device = test_device();
    if (compiles_kernels_alone(device.info())) GTEST_SKIP() << kAlone;
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
