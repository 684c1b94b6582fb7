// SPDX-License-Identifier: Apache-2.0
// Pipes, devices, folders and the system's files are refused by every command that reads files,
// without waiting for their writers.
#include <gmock/gmock.h>
#include <sys/stat.h>

#include "runtime/base/sanitizers.hpp"
#include "tests/cli/scene_program.hpp"
#include "tests/support/setting.hpp"

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
        expect_refused("import " + file + " -o o.json");
        expect_refused("warm " + file);
        expect_refused("merge " + file);
        expect_refused("bench -q --peers " + file);
    }
    expect_refused("merge /proc/self/mem");
}

TEST_F(CliSpecialFilesTest, AreRefusedAsSettings) {
    for (const char* target : {"pipe", "folder", "/dev/zero", "/proc/self/environ", "/proc/kmsg"}) {
        const Setting setting("VOXELUME_CONFIG", target);
        expect_refused("config");
    }
    put_bytes(folder / "large", "# ");
    std::filesystem::resize_file(folder / "large", uintmax_t{3} << 30);
    const Setting setting("VOXELUME_CONFIG", "large");
    expect_refused("config");
}

/// A sparse file of 3 GB was read whole.
TEST_F(CliSpecialFilesTest, PartsThatAreTooLargeAreRefusedBeforeTheyAreRead) {
    put_bytes(folder / "a.shard", "{");
    std::filesystem::resize_file(folder / "a.shard", uintmax_t{3} << 30);
    // A sanitizer takes addresses of its own.
    const std::string limit = kHasSanitizer ? "" : "ulimit -v 2000000; ";
    const ProgramResult result = run_line(limit + "timeout 20 voxelume merge a.shard");
    EXPECT_EQ(result.exit_code, 8);
    EXPECT_THAT(result.err, HasSubstr("a.shard: 3221225472 bytes, and such a file has at most"));
}

TEST_F(CliSpecialFilesTest, AreRefusedUnderTheNamesOfEveryFormat) {
    for (const char* ending :
         {"obj", "ply", "stl", "vxm", "vdb", "exr", "png", "nrrd", "raw", "kv6", "json", "foo"}) {
        const std::string name = std::string("a.") + ending;
        for (const char* target : {"pipe", "/dev/zero", "/proc/kmsg"}) {
            std::filesystem::create_symlink(target, folder / name);
            expect_refused("check " + name);
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
