// SPDX-License-Identifier: Apache-2.0
// Signals end the program soon, with a line and without leftovers.
#include <gmock/gmock.h>

#include <csignal>

#include "tests/cli/scene_program.hpp"

namespace voxelume {
namespace {

using testing::HasSubstr;

class CliInterruptTest : public SceneProgramTest {
  protected:
    /// A shell that starts tests in the background makes them ignore SIGINT, and so would their
    /// programs.
    CliInterruptTest() { std::signal(SIGINT, SIG_DFL); }

    /// Runs the program and sends the signal after some seconds; after 3 more it would be killed,
    /// with exit code 137. The device has one thread, which is enough to be interrupted.
    ProgramResult interrupt(const char* signal, double seconds, const std::string& arguments) {
        return run_line(
            fmt::format("env POCL_MAX_PTHREAD_COUNT=1 timeout --preserve-status -s {} "
                        "-k 3 {} voxelume {}",
                        signal, seconds, arguments));
    }

    /// Hidden files and folders of processes, anywhere in the test's folder.
    std::vector<std::string> leftovers() const {
        std::vector<std::string> found;
        for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
            const std::string name = entry.path().filename();
            if (name.ends_with(".tmp") || name.starts_with("pocl")) found.push_back(name);
        }
        return found;
    }

    /// A scene that takes minutes.
    void write_long_scene() {
        write_scene([](Json& scene) {
            scene["render"] = {{"size", {2000, 2000}}, {"samples", 4096}};
            scene["animation"] = Json::parse(R"({"frames": 50, "tracks": [{
                "target": "objects[0].turn", "keys": [{"frame": 1, "value": [0, 0, 0]},
                                                      {"frame": 50, "value": [9, 9, 9]}]}]})");
        });
    }
};

TEST_F(CliInterruptTest, ARunEndsSoonWithALine) {
    ASSERT_EQ(run("render scene.json -q -o warm.png").exit_code, 0);
    write_long_scene();
    for (const auto& [signal, code] : {std::pair{"INT", 130}, {"TERM", 143}}) {
        const ProgramResult result = interrupt(signal, 2, "render scene.json -q -o f.##.exr");
        EXPECT_EQ(result.exit_code, code) << result.err;
        EXPECT_THAT(result.err, testing::MatchesRegex("\n?voxelume: [^\n]+\n"));
        EXPECT_THAT(leftovers(), testing::IsEmpty());
    }
}

TEST_F(CliInterruptTest, TwoSignalsTogetherAreOne) {
    write_long_scene();
    // The shell is in the program's place at first, so that its number is the program's.
    const ProgramResult result = run_line(
        "env POCL_MAX_PTHREAD_COUNT=1 sh -c '(sleep 2; kill -INT $$; sleep 0.02; kill -INT $$) & "
        "exec voxelume render scene.json -q -o f.##.exr'");
    EXPECT_EQ(result.exit_code, 130) << result.err;
    EXPECT_THAT(result.err, testing::MatchesRegex("\n?voxelume: [^\n]+\n"));
    EXPECT_THAT(leftovers(), testing::IsEmpty());
}

// PoCL aborts where it can't link a kernel, as in a folder that was removed.
TEST_F(CliInterruptTest, ALibraryThatAbortsEndsARunWithALine) {
    ASSERT_EQ(run("render scene.json -q -o warm.png").exit_code, 0);
    write_long_scene();
    const ProgramResult result = interrupt("ABRT", 2, "render scene.json -q -o f.##.exr");
    EXPECT_EQ(result.exit_code, 1) << result.err;
    EXPECT_THAT(result.err, testing::MatchesRegex("voxelume: a library gave up, [^\n]+\n"));
    EXPECT_THAT(leftovers(), testing::IsEmpty());
}

TEST_F(CliInterruptTest, ALimitOfFileSizesIsNamedAsTheCause) {
    const ProgramResult result = run_line(fmt::format(
        "ulimit -f 8; env -u POCL_CACHE_DIR VOXELUME_CACHE_DIR={} voxelume render scene.json -q "
        "-o a.png",
        (folder / "cold").string()));
    EXPECT_EQ(result.exit_code, 6) << result.err;
    EXPECT_THAT(result.err, testing::ContainsRegex("at most [48] kB here: raise `ulimit -f`"));
}

TEST_F(CliInterruptTest, SoDoesOneThatCompilesKernels) {
    const std::string cold = (folder / "cold").string();
    const ProgramResult result = run_line(
        fmt::format("env -u POCL_CACHE_DIR VOXELUME_CACHE_DIR={} timeout --preserve-status -s INT "
                    "-k 3 1 voxelume render scene.json -q -o a.exr --volume a.nrrd",
                    cold));
    EXPECT_EQ(result.exit_code, 130) << result.err;
    EXPECT_THAT(leftovers(), testing::IsEmpty());
}

TEST_F(CliInterruptTest, SoDoCommandsThatListenToNothing) {
    std::string obj;
    for (int i = 0; i < 200000; ++i) obj += fmt::format("v {} {} {}\n", i % 97, i % 89, i % 83);
    for (int i = 1; i + 2 < 200000; ++i) obj += fmt::format("f {} {} {}\n", i, i + 1, i + 2);
    put_bytes(folder / "large.obj", obj);
    const ProgramResult result =
        interrupt("TERM", 0.5, "voxelize large.obj --resolution 600 -o large.vdb");
    EXPECT_EQ(result.exit_code, 143) << result.err;
    EXPECT_THAT(result.err, HasSubstr("voxelume: terminated\n"));
    EXPECT_THAT(leftovers(), testing::IsEmpty());
}

TEST_F(CliInterruptTest, ACommandThatEndsMeanwhileLeavesNothingEither) {
    put_bytes(folder / "model.obj", kTetrahedron);
    const std::string env =
        fmt::format("env -u POCL_CACHE_DIR VOXELUME_CACHE_DIR={} ", (folder / "cache").string());
    const std::string voxelize = "voxelume voxelize model.obj -q -o large.vdb --resolution ";
    ASSERT_EQ(run_line(env + voxelize + "8").exit_code, 0);
    // The command takes some 0.4 s, and removing the files of its kernels 2 s.
    const ProgramResult result = run_line(env +
                                          "LD_PRELOAD=" VXL_WRITE_FAULTS
                                          " VXL_UNLINK_DELAY=100000 timeout --preserve-status "
                                          "-s TERM -k 9 0.1 " +
                                          voxelize + "800");
    EXPECT_EQ(result.exit_code, 143) << result.err;
    EXPECT_EQ(result.err, "\nvoxelume: terminated\n");
    EXPECT_THAT(leftovers(), testing::IsEmpty());
}

TEST_F(CliInterruptTest, AnIgnoredSignalStaysIgnored) {
    const ProgramResult result = run_line(
        "sh -c 'trap \"\" INT; voxelume render scene.json -q -o a.png --size 1000x1000 "
        "--samples 16 & sleep 0.3; kill -INT $! && wait $!'");
    EXPECT_EQ(result.exit_code, 0) << result.err;
}

TEST_F(CliInterruptTest, StressTellsWhatItFoundUntilItIsInterrupted) {
    // Compiles the kernels, which may take longer than the test.
    ASSERT_EQ(run("stress -q --rays 1 --only corners,ties").exit_code, 0);
    for (const auto& [signal, code] : {std::pair{"INT", 130}, {"TERM", 143}}) {
        const ProgramResult result =
            run_line(fmt::format("env POCL_MAX_PTHREAD_COUNT=1 timeout --preserve-status -k 100 "
                                 "-s {} 2 voxelume stress -q --rays 1e12 --only corners,ties",
                                 signal));
        EXPECT_EQ(result.exit_code, code) << result.err;
        EXPECT_THAT(result.out, testing::MatchesRegex("corners +[0-9]+ cases +0 mismatches .*\n"));
        EXPECT_THAT(result.err,
                    testing::MatchesRegex("interrupted after [0-9]+ cases, 0 mismatches\n"));
    }
    EXPECT_THAT(run("help").out, HasSubstr("130  ended by Ctrl-C"));
}

}  // namespace
}  // namespace voxelume
