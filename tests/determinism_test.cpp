// The same scene gives the same bytes: the stress cases D2 and D6 (tests/CASES.md).
#include <gtest/gtest.h>

#include "tests/program_runner.hpp"

namespace voxelume {
namespace {

class Determinism : public ProgramTest {
  protected:
    /// The image's bytes when rendered with something added before the program's name.
    std::string image(const std::string& name, const std::string& options) {
        const ProgramResult result =
            run(fmt::format("render '{}/scenes/solids.json' --size 52x39 --float -q -o {}.exr {}",
                            VXL_SOURCE_DIR, name, options));
        EXPECT_EQ(result.exit_code, 0) << result.err;
        return bytes_of(folder / (name + ".exr"));
    }
};

TEST_F(Determinism, D2ThreadsOfTheDeviceDoNotChangeABit) {
    const std::string expected = image("own", "");
    ASSERT_FALSE(expected.empty());
    for (const char* threads : {"1", "2"}) {
        ASSERT_EQ(setenv("POCL_MAX_PTHREAD_COUNT", threads, 1), 0);
        EXPECT_TRUE(image(threads, "") == expected) << threads;
    }
    unsetenv("POCL_MAX_PTHREAD_COUNT");
}

TEST_F(Determinism, D6RunsGiveTheSameBytes) {
    const std::string expected = image("first", "");
    for (int i = 1; i < 3; ++i) ASSERT_TRUE(image("again", "") == expected) << i;
}

}  // namespace
}  // namespace voxelume
