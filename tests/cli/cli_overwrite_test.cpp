// SPDX-License-Identifier: Apache-2.0
// `--overwrite never` keeps existing files, whatever they are.
#include <gmock/gmock.h>

#include "runtime/io/image/png.hpp"
#include "tests/cli/scene_program.hpp"

namespace voxelume {
namespace {

using testing::HasSubstr;

using CliOverwriteTest = SceneProgramTest;

TEST_F(CliOverwriteTest, NeverKeepsAFileAlongsideAStream) {
    put_bytes(folder / "keep.png", "mine");
    const std::string line =
        "sh -c 'voxelume render scene.json -q -o - -o {} "
        "--overwrite never >piped.png'";
    ASSERT_EQ(run_line(fmt::format(fmt::runtime(line), "keep.png")).exit_code, 0);
    EXPECT_EQ(bytes_of(folder / "keep.png"), "mine");
    ASSERT_EQ(run_line(fmt::format(fmt::runtime(line), "new.png")).exit_code, 0);
    EXPECT_EQ(read_png(folder / "piped.png").width, 20);
    EXPECT_TRUE(std::filesystem::exists(folder / "new.png"));
}

TEST_F(CliOverwriteTest, NeverKeepsVolumesOfSeveralFilesOnlyIfTheyAreWhole) {
    const std::string line =
        "render scene.json --frames 1 --volume s.%02d.png --volume t.###.png --volume v.raw "
        "--volume w.json --overwrite never --progress json";
    ASSERT_EQ(run(line).exit_code, 0);
    EXPECT_THAT(run(line).err, HasSubstr("1 of 1 frames are there already"));
    const std::vector<std::string> whole = names();
    for (const char* part : {"s.0001.04.png", "s.0001.json", "t.0001.000.png", "v0001.raw",
                             "v0001.json", "w0001.raw", "w0001.json"}) {
        const std::string bytes = bytes_of(folder / part);
        ASSERT_FALSE(bytes.empty()) << part;
        std::filesystem::remove(folder / part);
        const std::string refusal = expect_failure(5, line);
        EXPECT_THAT(refusal, HasSubstr("is there already, but not all files of")) << part;
        put_bytes(folder / part, bytes);
        EXPECT_THAT(run(line).err, HasSubstr("1 of 1 frames are there already")) << part;
    }
    EXPECT_EQ(names(), whole);
}

TEST_F(CliOverwriteTest, NeverKeepsFilesThatBecameNoVolume) {
    write_scene([](Json&) {});
    for (const char* name : {"ct.raw", "s.0007.png"}) {
        put_bytes(folder / name, "mine");
        const std::string volume = name[0] == 's' ? "s.####.png" : name;
        EXPECT_THAT(expect_failure(5, "render scene.json --overwrite never --volume " + volume),
                    HasSubstr(name));
        EXPECT_EQ(bytes_of(folder / name), "mine");
    }
}

TEST_F(CliOverwriteTest, OptionsAtOddsAreMistakes) {
    EXPECT_THAT(expect_failure(2, "render scene.json -o a.png --overwrite nevr"),
                HasSubstr("did you mean \"never\"?"));
    EXPECT_THAT(expect_failure(2, "render scene.json -o a.png --resume --overwrite never"),
                HasSubstr("--resume and --overwrite never"));
}

}  // namespace
}  // namespace voxelume
