// The same scene gives the same bytes: the stress cases D2 and D6 (tests/CASES.md), and everything
// about a device that must not matter.
#include <gtest/gtest.h>

#include "tests/program_runner.hpp"

namespace voxelume {
namespace {

/// Sets an environment variable while it lives.
class Setting {
  public:
    Setting(const char* name, const std::string& value) : name_(name) {
        setenv(name, value.c_str(), 1);
    }
    Setting(const Setting&) = delete;
    Setting& operator=(const Setting&) = delete;
    ~Setting() { unsetenv(name_); }

  private:
    const char* name_;
};

class Determinism : public ProgramTest {
  protected:
    /// The image's bytes when rendered with something added to the command.
    std::string image(const std::string& name, const std::string& options = "") {
        const ProgramResult result =
            run(fmt::format("render '{}/scenes/solids.json' --size 52x39 --float -q -o {}.exr {}",
                            VXL_SOURCE_DIR, name, options));
        EXPECT_EQ(result.exit_code, 0) << result.err;
        return bytes_of(folder / (name + ".exr"));
    }

    void expect_same_image(const char* variable, const std::vector<const char*>& values) {
        const std::string expected = image("own");
        ASSERT_FALSE(expected.empty());
        for (const char* value : values) {
            const Setting setting(variable, value);
            EXPECT_TRUE(image("other") == expected) << variable << "=" << value;
        }
    }
};

TEST_F(Determinism, D2ThreadsOfTheDeviceDoNotChangeABit) {
    expect_same_image("POCL_MAX_PTHREAD_COUNT", {"1", "2"});
}

TEST_F(Determinism, D6RunsGiveTheSameBytes) {
    const std::string expected = image("first");
    for (int i = 1; i < 3; ++i) ASSERT_TRUE(image("again") == expected) << i;
}

TEST_F(Determinism, WorkGroupsOfAnySizeGiveTheSameBytes) {
    expect_same_image("VOXELUME_WORK_GROUP", {"1", "16", "24"});
}

TEST_F(Determinism, LanesDoNotChangeABit) {
    expect_same_image("VOXELUME_LANES", {"1", "4", "8", "16"});
}

TEST_F(Determinism, APartOfTheDeviceGivesTheSameBytes) {
    expect_same_image("VOXELUME_UNITS", {"1"});
}

TEST_F(Determinism, AnOptimizerGivesTheSameBytesAsNone) {
    expect_same_image("VOXELUME_BUILD_OPTIONS", {"-cl-opt-disable"});
}

TEST_F(Determinism, RefusesSettingsThatAreNoNumbers) {
    const Setting setting("VOXELUME_WORK_GROUP", "many");
    const ProgramResult result = run("render nothing.json -o a.exr");
    EXPECT_NE(result.exit_code, 0);
}

}  // namespace
}  // namespace voxelume
