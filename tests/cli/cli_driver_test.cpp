// SPDX-License-Identifier: Apache-2.0
// A driver that computes something wrong isn't used, and the wrong result is reported.
#include <gmock/gmock.h>

#include <cstdlib>
#include <fstream>
#include <sstream>

#include "runtime/base/sanitizers.hpp"
#include "tests/cli/scene_program.hpp"

namespace voxelume {

using testing::HasSubstr;

class CliDriverTest : public SceneProgramTest {
  protected:
    /// Runs a command with a cache that this test alone has, and variables of the environment.
    ProgramResult with(const std::string& environment, const std::string& command) const {
        return run_line(fmt::format(
            "env VOXELUME_CACHE_DIR={}/cache VOXELUME_DEVICE=cpu {} timeout 120 voxelume {}",
            folder.string(), environment, command));
    }

    /// Runs a command whose self-test gets a wrong first answer.
    ProgramResult with_wrong_bits(const std::string& command) const {
        return with(
            fmt::format("LD_PRELOAD='{}' VXL_FAULT=clEnqueueReadBuffer:1:wrong", VXL_FAULTS),
            command);
    }

    /// The number of calls of a function by a command.
    long count(const std::string& function, const std::string& command) const {
        std::filesystem::remove(folder / "counts");  // without calls none is written
        const ProgramResult result =
            with(fmt::format("LD_PRELOAD='{}' VXL_FAULT_COUNTS=counts", VXL_FAULTS), command);
        EXPECT_EQ(result.exit_code, 0) << result.err;
        std::ifstream file(folder / "counts");
        std::string name;
        for (long calls = 0; file >> name >> calls;)
            if (name == function) return calls;
        return 0;
    }

    /// The entry of `devices --json` for the first device.
    Json first_device() const { return Json::parse(with("", "devices --json").out).at(0); }
};

constexpr const char* kRender = "render scene.json -q -o a.exr --channels Z";  // few kernels
constexpr const char* kWrongReciprocal =
    "its driver gets reciprocals wrong: 0x3F800000 where 0x3F800001 is right "
    "(VOXELUME_SELF_TEST=again has it tested again)";

TEST_F(CliDriverTest, WithAWrongBitIsRefusedUntilItIsTestedAgain) {
    const ProgramResult refused = with_wrong_bits(kRender);
    EXPECT_EQ(refused.exit_code, 6);
    EXPECT_THAT(
        refused.err,
        testing::MatchesRegex("voxelume: no usable device matches \"cpu\"; there are: [^\n]+\n"));
    EXPECT_THAT(refused.err, HasSubstr(fmt::format(" (not usable: {})", kWrongReciprocal)));
    EXPECT_FALSE(std::filesystem::exists(folder / "a.exr"));

    EXPECT_EQ(with("", kRender).exit_code, 6) << "the result is kept";
    EXPECT_EQ(with("VOXELUME_SELF_TEST=off", kRender).exit_code, 0);
    EXPECT_EQ(with("VOXELUME_SELF_TEST=again", kRender).exit_code, 0);
    EXPECT_EQ(with("", kRender).exit_code, 0) << "the new result is kept";
}

TEST_F(CliDriverTest, IsListedWithWhatItGetsWrong) {
    const ProgramResult listed = with_wrong_bits("devices");
    EXPECT_EQ(listed.exit_code, 0);
    EXPECT_THAT(listed.out, HasSubstr(fmt::format("\n   not usable: {}\n", kWrongReciprocal)));
    const Json device = first_device();
    EXPECT_EQ(device["self_test"], "failed");
    EXPECT_EQ(device["usable"], false);
    EXPECT_EQ(device["unusable_because"], kWrongReciprocal);

    const ProgramResult doctor = with("", "doctor --json");
    EXPECT_EQ(doctor.exit_code, 6);
    const Json row = Json::parse(doctor.out)["devices"][0];
    EXPECT_EQ(row["known bits"], "failed");
    EXPECT_EQ(row["state"], kWrongReciprocal);
}

TEST_F(CliDriverTest, IsTestedForEachNumberOfLanes) {
    EXPECT_EQ(with_wrong_bits("devices").exit_code, 0);
    EXPECT_EQ(with("", kRender).exit_code, 6);
    EXPECT_EQ(with("VOXELUME_LANES=1", kRender).exit_code, 0);
    const Json device = Json::parse(with("VOXELUME_LANES=1", "devices --json").out).at(0);
    EXPECT_EQ(device["self_test"], "passed");
    EXPECT_EQ(first_device()["self_test"], "failed");
}

TEST_F(CliDriverTest, IsListedAsItWasTestedAgain) {
    const auto again = [](const Json& devices) { return devices.at(0)["self_test"]; };
    EXPECT_EQ(again(Json::parse(with("VOXELUME_SELF_TEST=again", "devices --json").out)), "passed");
    EXPECT_EQ(again(Json::parse(with_wrong_bits("devices --json").out)), "passed") << "kept";
    const ProgramResult wrong = with(fmt::format("VOXELUME_SELF_TEST=again LD_PRELOAD='{}' "
                                                 "VXL_FAULT=clEnqueueReadBuffer:1:wrong",
                                                 VXL_FAULTS),
                                     "devices --json");
    EXPECT_EQ(again(Json::parse(wrong.out)), "failed");
}

TEST_F(CliDriverTest, IsTestedOnceForAllRuns) {
    EXPECT_GT(count("clBuildProgram", "devices"), 0);
    EXPECT_EQ(count("clBuildProgram", "devices"), 0);
    EXPECT_EQ(first_device()["self_test"], "passed");
}

TEST_F(CliDriverTest, ThatCantBeTestedNowIsRefusedNow) {
    const std::string fault =
        fmt::format("LD_PRELOAD='{}' VXL_FAULT=clEnqueueReadBuffer:1:-5", VXL_FAULTS);
    const ProgramResult refused = with(fault, kRender);
    EXPECT_EQ(refused.exit_code, 6);
    EXPECT_THAT(refused.err, HasSubstr("not usable: its self-test failed: "));
    EXPECT_THAT(refused.err, HasSubstr("CL_OUT_OF_RESOURCES"));
    EXPECT_EQ(with("", kRender).exit_code, 0) << "the reason has passed";
}

TEST_F(CliDriverTest, KeepsOneSmallFileInTheCache) {
    ASSERT_EQ(with("", "devices").exit_code, 0);
    int files = 0;
    for (const auto& entry : std::filesystem::directory_iterator(folder / "cache" / "drivers")) {
        EXPECT_LT(entry.file_size(), 200u);
        ++files;
    }
    EXPECT_EQ(files, 1);
}

TEST_F(CliDriverTest, SaysHowLongItCompilesKernels) {
    const ProgramResult result = with("", "render scene.json -q -o a.exr --progress json");
    ASSERT_EQ(result.exit_code, 0) << result.err;
    int kernels = 0, known = 0;
    double seconds = 0;
    std::istringstream lines(result.err);
    for (std::string line; std::getline(lines, line);) {
        const Json event = Json::parse(line);
        if (event["event"] != "compiling") continue;
        EXPECT_EQ(event["kernel"], ++kernels);
        known = event["known"];
        EXPECT_GE(event["compile_seconds"], seconds);
        seconds = event["compile_seconds"];
    }
    EXPECT_GT(kernels, 5);
    EXPECT_GE(known, kernels);
    EXPECT_GT(seconds, 0);
    EXPECT_THAT(with("", "render scene.json -q -o a.exr --progress json").err,
                testing::Not(HasSubstr("compiling")))
        << "they are kept";
}

TEST_F(CliDriverTest, IsLoadedOnceToCheckScenes) {
    if (std::getenv("OCL_ICD_VENDORS")) GTEST_SKIP() << "nothing is kept then";
    const auto opened = [&](const std::string& command) {
        return count("clCreateContext", command);
    };
    EXPECT_GT(opened("check scene.json"), 0);
    EXPECT_EQ(opened("check scene.json"), 0);
    EXPECT_EQ(opened("render scene.json --dry-run -o a.exr"), 0);
    EXPECT_GT(opened("check scene.json --device auto"), 0) << "another device may be meant";
    const std::string before = with("", "check scene.json --json").out;
    EXPECT_EQ(with("", "check scene.json --json").out, before);
    EXPECT_THAT(with("VOXELUME_MEMORY_MB=1", "check scene.json").out, HasSubstr(" of 1.0 MB "));
    EXPECT_EQ(with("VOXELUME_SELF_TEST=again", "check scene.json").exit_code, 0);
    for (const auto& entry : std::filesystem::directory_iterator(folder / "cache" / "devices"))
        if (entry.is_regular_file()) put_bytes(entry.path(), "damaged");
    EXPECT_GT(opened("check scene.json"), 0);
    EXPECT_EQ(opened("check scene.json"), 0);
}

TEST_F(CliDriverTest, IsAskedAgainWhereAProcessMayHaveOtherMemory) {
    if (kHasSanitizer) GTEST_SKIP() << "a sanitizer takes memory of its own";
    // PoCL takes the limit of a process's data for the size of its memory.
    const auto checked = [&](const char* limit) {
        return run_line(
            fmt::format("sh -c '{} exec env VOXELUME_CACHE_DIR={}/cache "
                        "VOXELUME_DEVICE=cpu voxelume check scene.json --json'",
                        limit, folder.string()));
    };
    const ProgramResult limited = checked("ulimit -d 400000;"), whole = checked("");
    ASSERT_EQ(limited.exit_code, 0) << limited.err;
    ASSERT_EQ(whole.exit_code, 0) << whole.err;
    const auto memory = [](const ProgramResult& result) {
        return Json::parse(result.out)["device MB"].get<double>();
    };
    EXPECT_LT(memory(limited), 450);
    EXPECT_GT(memory(whole), 450);
}

}  // namespace voxelume
