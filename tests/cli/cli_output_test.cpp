// SPDX-License-Identifier: Apache-2.0
// Outputs that can't be written, in every format: exit code 5, one sentence with the path and the
// cause, and no file left, not even a hidden one.
#include <gmock/gmock.h>

#include "tests/cli/scene_program.hpp"

namespace voxelume {

using testing::HasSubstr;

class CliOutputTest : public SceneProgramTest {
  protected:
    void SetUp() override {
        SceneProgramTest::SetUp();
        put_bytes(folder / "a.obj", kTetrahedron);
        write_scene([](Json& scene) {
            scene["render"]["size"] = {64, 48};
            scene["observer"]["display"]["layout"] = "lattice";
            scene["observer"]["display"]["voxels"] = {48, 40, 32};
        });
        ASSERT_EQ(run("render scene.json --volume v.nrrd -q").exit_code, 0);
    }

    /// One command for each format that is made of other files, into FOLDER/out.ENDING.
    static std::vector<std::string> conversions(const std::string& target) {
        std::vector<std::string> lines;
        for (const char* ending : {"vdb", "nrrd", "raw", "####.png", "ply", "kv6", "planes",
                                   "cplanes", "rgb332", "rgb565"})
            lines.push_back(fmt::format("convert v.nrrd {}/out.{}", target, ending));
        for (const char* ending : {"png", "html"})
            lines.push_back(fmt::format("view v.nrrd -o {}/out.{}", target, ending));
        return lines;
    }

    /// The others, too.
    static std::vector<std::string> commands(const std::string& target) {
        std::vector<std::string> lines = conversions(target);
        for (const char* option : {"-o {}/out.exr", "-o {}/out.png", "--volume {}/out.vdb",
                                   "-o here.png --stats-json {}/out.json"})
            lines.push_back("render scene.json " + fmt::format(fmt::runtime(option), target));
        for (const char* ending : {"vxm", "vdb"})
            lines.push_back(
                fmt::format("voxelize a.obj --resolution 24 -o {}/out.{}", target, ending));
        return lines;
    }

    void expect_refused(const std::string& setting, const std::string& command,
                        const std::string& cause) const {
        const std::vector<std::string> before = names();
        const ProgramResult result = run_line(setting + "voxelume " + command);
        std::filesystem::remove(folder / "here.png");  // which could be written
        EXPECT_EQ(result.exit_code, 5) << setting << command << "\n" << result.err;
        EXPECT_THAT(result.err, testing::MatchesRegex("(warning: [^\n]+\n)*voxelume: [^\n]+\n"))
            << command;
        EXPECT_THAT(result.err, HasSubstr("out.")) << command;
        EXPECT_THAT(result.err, HasSubstr(cause)) << command;
        EXPECT_EQ(names(), before) << command;
    }
};

TEST_F(CliOutputTest, FoldersThatTakeNoFilesAreNamed) {
    for (const std::string& command : commands("/proc")) expect_refused("", command, "/proc");
    for (const std::string& command : commands("nowhere"))
        expect_refused("", command, "there is no folder nowhere");
}

TEST_F(CliOutputTest, NamesThatAreTooLongAreNamed) {
    const std::string name(300, 'a');
    for (const char* const command :
         {"render scene.json -q -o ", "convert v.nrrd ", "voxelize scene.json -q -o "}) {
        const ProgramResult done = run(std::string(command) + name + ".nrrd");
        EXPECT_NE(done.exit_code, 1) << command << done.err;
        EXPECT_THAT(done.err, testing::Not(HasSubstr("filesystem error"))) << command;
    }
    const ProgramResult done = run("render scene.json -q -o " + name + ".png");
    EXPECT_EQ(done.exit_code, 5) << done.err;
    EXPECT_THAT(done.err, HasSubstr(name + ".png: can't be written: the name is too long"));
}

TEST_F(CliOutputTest, AFileThatMeetsItsLimitLeavesNothing) {
    std::filesystem::create_directory(folder / "full");
    for (const std::string& command : conversions("full")) {
        expect_refused("ulimit -f 1 && ", command, "see `ulimit -f`");  // 512 bytes
        EXPECT_TRUE(std::filesystem::is_empty(folder / "full")) << command;
        std::filesystem::remove_all(folder / "full");
        std::filesystem::create_directory(folder / "full");
    }
}

/// A disk of 64 kB, in a separate mount namespace, where this is allowed.
TEST_F(CliOutputTest, AFullDiskLeavesNothing) {
    std::filesystem::create_directory(folder / "full");
    const std::string mount = "unshare -m sh -c 'mount -t tmpfs -o size=64k none full && ";
    if (run_line(mount + "true'").exit_code != 0) GTEST_SKIP() << "nothing can be mounted here";
    for (const std::string& command : commands("full")) {
        const std::string line =
            mount + fmt::format(
                        "head -c 65536 /dev/zero >full/filler 2>/dev/null; "
                        "voxelume {}; code=$?; rm -f full/filler; ls -A full; exit $code'",
                        command);
        const ProgramResult result = run_line(line);
        std::filesystem::remove(folder / "here.png");
        EXPECT_EQ(result.exit_code, 5) << command << "\n" << result.err;
        EXPECT_THAT(result.err, testing::ContainsRegex(
                                    "voxelume: full/[^\n ]+: can't be written: the disk is full"))
            << command;
        EXPECT_EQ(result.out, "") << command;
    }
}

}  // namespace voxelume
