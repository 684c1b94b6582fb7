// SPDX-License-Identifier: Apache-2.0
// Pipes, devices, folders and the system's files are refused by every command that reads files,
// without waiting for their writers.
#include <gmock/gmock.h>
#include <sys/stat.h>

#include "tests/cli/scene_program.hpp"

namespace voxelume {

using testing::AnyOf;
using testing::HasSubstr;

class CliSpecialFilesTest : public SceneProgramTest {
  protected:
    void SetUp() override {
        SceneProgramTest::SetUp();
        ASSERT_EQ(mkfifo((folder / "pipe").c_str(), 0600), 0);
        std::filesystem::create_directory(folder / "folder");
    }

    /// Expects that the command refuses its input soon: 124 is that of `timeout`.
    void expect_refused(const std::string& arguments) const {
        const ProgramResult result = run_line("timeout 20 voxelume " + arguments);
        EXPECT_THAT(result.exit_code, AnyOf(2, 3, 4)) << arguments << "\n" << result.err;
        EXPECT_THAT(result.err, testing::MatchesRegex("(warning: [^\n]+\n)*voxelume: [^\n]+\n"))
            << arguments;
    }
};

TEST_F(CliSpecialFilesTest, AreRefusedByEveryCommand) {
    for (const std::string file :
         {"pipe", "folder", "/dev/zero", "/dev/tty", "/proc/self/environ", "/proc/kmsg"}) {
        expect_refused("info " + file);
        expect_refused("check " + file);
        expect_refused("render " + file + " -o o.png");
        expect_refused("diff " + file + " " + file);
        expect_refused("voxelize " + file + " -o o.vxm");
    }
}

TEST_F(CliSpecialFilesTest, AreRefusedUnderTheNamesOfEveryFormat) {
    for (const char* ending :
         {"obj", "ply", "stl", "vxm", "vdb", "exr", "png", "nrrd", "raw", "kv6", "json"}) {
        const std::string name = std::string("a.") + ending;
        for (const char* target : {"pipe", "/dev/zero", "/proc/self/environ"}) {
            std::filesystem::create_symlink(target, folder / name);
            expect_refused("info " + name);
            expect_refused("convert " + name + " o.nrrd");
            expect_refused("view " + name + " -o o.png");
            std::filesystem::remove(folder / name);
        }
    }
}

TEST_F(CliSpecialFilesTest, AreRefusedInScenes) {
    for (const char* target : {"pipe", "/dev/zero", "/proc/self/environ", "folder"})
        for (const auto& kind :
             {std::pair("mesh", "obj"), std::pair("voxels", "vxm"), std::pair("voxels", "vdb")}) {
            const std::string name = std::string("a.") + kind.second;
            std::filesystem::create_symlink(target, folder / name);
            write_scene([&](Json& scene) {
                scene["models"]["thing"] = {{kind.first, name}, {"surface", "cubes"}};
            });
            expect_refused("check scene.json");
            std::filesystem::remove(folder / name);
        }
}

}  // namespace voxelume
