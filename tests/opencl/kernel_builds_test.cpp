// SPDX-License-Identifier: Apache-2.0
#include "runtime/opencl/kernel_builds.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <optional>
#include <stdexcept>
#include <thread>

#include "runtime/base/error.hpp"
#include "tests/support/file_fixture.hpp"
#include "tests/support/setting.hpp"
#include "tests/support/test_device.hpp"

namespace voxelume {
namespace {

const ProgramText kTwo = {
    "static inline int next(int i) { return i + STEP; }\n"
    "kernel void first(global int* x) { *x = next(*x); }\n"
    "kernel void second(global int* x) { *x = 7; }\n",
    "-cl-std=CL1.2 -w -DSTEP=3"};

class KernelBuildsTest : public FileTest {
  protected:
    BuiltProgram built(KernelBuilds& builds, const std::string& kernel, const ProgramText& text) {
        const auto parts = builds.parts_of(text.source + text.options, text.source, text.options);
        return builds.start(target, "a test", parts->kernels.at(kernel), parts->whole).get();
    }

    void SetUp() override {
        FileTest::SetUp();
        cache.emplace("VOXELUME_CACHE_DIR", folder.string());
    }

    std::optional<Setting> cache;
    const Device device = test_device();
    const CompilerTarget target = compiler_target(device);
};

TEST_F(KernelBuildsTest, EachKernelHasWhatItConsistsOf) {
    KernelBuilds builds;
    const auto parts = builds.parts_of("two", kTwo.source, kTwo.options);
    ASSERT_EQ(parts->kernels.size(), 2u);
    EXPECT_THAT(parts->kernels.at("first").text.source, testing::HasSubstr("next"));
    EXPECT_THAT(parts->kernels.at("second").text.source, testing::Not(testing::HasSubstr("next")));
    EXPECT_EQ(builds.parts_of("two", kTwo.source, kTwo.options), parts);
    // Another constant changes only the kernel that mentions it.
    const auto others = builds.parts_of("other", kTwo.source, "-cl-std=CL1.2 -w -DSTEP=4");
    EXPECT_NE(others->kernels.at("first").key, parts->kernels.at("first").key);
    EXPECT_EQ(others->kernels.at("second").key, parts->kernels.at("second").key);
}

TEST_F(KernelBuildsTest, CompileAKernelOnceAndKeepIt) {
    KernelBuilds builds, later;
    const BuiltProgram once = built(builds, "first", kTwo);
    EXPECT_FALSE(once.is_from_cache);
    EXPECT_EQ(built(builds, "first", kTwo).program, once.program);
    EXPECT_NE(built(builds, "second", kTwo).program, once.program);
    EXPECT_TRUE(built(later, "first", kTwo).is_from_cache);
}

TEST_F(KernelBuildsTest, ThatAreBegunAreMadeOnceInAnotherThreadAndTakenOnce) {
    KernelBuilds builds;
    EXPECT_FALSE(builds.take("a"));
    std::thread::id maker;
    builds.begin("a", [&] {
        maker = std::this_thread::get_id();
        return BuiltProgram{nullptr, true};
    });
    builds.begin("a", []() -> BuiltProgram { throw std::logic_error("begun twice"); });
    const std::optional<BuiltProgram> made = builds.take("a");
    ASSERT_TRUE(made);
    EXPECT_TRUE(made->is_from_cache);
    EXPECT_NE(maker, std::this_thread::get_id());
    EXPECT_FALSE(builds.take("a"));
    builds.begin("a", []() -> BuiltProgram { throw Error(ErrorKind::build, "wrong"); });
    EXPECT_THROW(builds.take("a"), Error);
}

TEST_F(KernelBuildsTest, TakeTheWholeProgramWhereAKernelDoesNotCompileAlone) {
    KernelBuilds builds;
    KernelPart part = builds.parts_of("two", kTwo.source, kTwo.options)->kernels.at("first");
    part.key = "broken", part.text.source = "kernel void first(global int* x) { *x = next(*x); }\n";
    EXPECT_TRUE(builds.start(target, "a test", part, kTwo).get().program);
    part.key = "both";
    try {
        builds.start(target, "a test", part, {"kernel void first() { wrong(); }", "-w"}).get();
        FAIL() << "it compiles";
    } catch (const Error& error) {
        EXPECT_EQ(error.kind(), ErrorKind::build);
        EXPECT_THAT(error.what(), testing::HasSubstr("wrong"));
    }
}

}  // namespace
}  // namespace voxelume
