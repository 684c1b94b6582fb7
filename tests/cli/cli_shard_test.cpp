// SPDX-License-Identifier: Apache-2.0
// Runs that several processes share: the parts together have the bytes of a single run.
#include "tests/cli/shard_program.hpp"

namespace voxelume {
namespace {

using testing::AllOf;
using testing::HasSubstr;
namespace fs = std::filesystem;

using CliShardTest = ShardProgramTest;

TEST_F(CliShardTest, PartsOfOneImageMergeToTheBytesOfASingleRun) {
    expect_merged(kImage, 'p', "p.*.shard");
}

TEST_F(CliShardTest, SoDoPartsOfACroppedImageInGlobalLight) {
    expect_merged(std::string(kImage) + "--crop 3,5,13,27 --light global --channels RGBA,Z", 'p',
                  "p.*.shard");
}

TEST_F(CliShardTest, SoDoPartsOfAnAnimation) {
    expect_merged(kFrames, 'f', "f.*.shard");
    expect_merged("render moving.json -q --volume v.##.nrrd --volume v.##.raw", 'v', "v.*.shard");
}

TEST_F(CliShardTest, PartsTellOfAllFilesOfAVolume) {
    const std::string line =
        "render moving.json -q --frames 1,3 --volume q.%02d.png --volume v.raw";
    expect_merged(line, 'q', "q.*.shard");
    for (const char* file : {"q.0003.07.png", "q.0003.json", "v0003.raw", "v0003.json"}) {
        const std::string bytes = bytes_of(folder / file);
        std::filesystem::remove(folder / file);
        EXPECT_THAT(refusal("q.*.shard"), HasSubstr(std::string(file) + ": isn't there")) << file;
        put_bytes(folder / file, bytes);
    }
    EXPECT_EQ(run("merge q.*.shard").exit_code, 0);
}

TEST_F(CliShardTest, PartsOfSeveralRunsMergeToEachOfThem) {
    const std::string line =
        "render scene.json -q --views 2 --sweep lights.0.intensity=1,2 -o "
        "'q{intensity}-{view}.exr' ";
    ASSERT_EQ(run(line).exit_code, 0);
    const auto whole = pictures('q');
    ASSERT_EQ(whole.size(), 4u);
    remove(whole);
    render_parts(line, 2);
    const ProgramResult result = run("merge q*.shard");
    EXPECT_EQ(result.exit_code, 0);
    EXPECT_THAT(result.err, HasSubstr("4 of 4 runs merged\n"));
    EXPECT_EQ(pictures('q'), whole);
    std::filesystem::remove(folder / "q1-2.exr.2-of-2.shard");
    std::filesystem::remove(folder / "q2-2.exr");
    const ProgramResult partly = run("merge q*.shard");
    EXPECT_EQ(partly.exit_code, 4);
    EXPECT_THAT(partly.err, AllOf(HasSubstr("of 2 parts 1 is missing: 2\n"),
                                  HasSubstr("3 of 4 runs merged\n")));
    EXPECT_EQ(pictures('q'), whole);
}

TEST_F(CliShardTest, PartsAreOfOneRunHoweverTheirFolderIsNamed) {
    const std::string line = "render scene.json -q --size 21x37 -o ";
    for (const char* name : {"s", "t"}) {
        fs::create_directory(folder / name);
        ASSERT_EQ(run(fmt::format("{}{}/p.exr --shard 1/2", line, name)).exit_code, 0);
        const std::string whole = (folder / "." / name / "p.exr").string();
        ASSERT_EQ(run(line + whole + " --shard 2/2").exit_code, 0);
    }
    ASSERT_EQ(run(line + "whole.exr").exit_code, 0);
    EXPECT_EQ(run("merge s/*.shard").exit_code, 0);
    const ProgramResult both = run("merge */p.exr.*.shard");
    EXPECT_EQ(both.exit_code, 0) << both.err;
    EXPECT_THAT(both.err, HasSubstr("2 of 2 runs merged\n"));
    for (const char* name : {"s", "t"})
        EXPECT_EQ(bytes_of(folder / name / "p.exr"), bytes_of(folder / "whole.exr")) << name;
}

TEST_F(CliShardTest, NamesThatNoPartCanTellAreMistakes) {
    EXPECT_EQ(run("render scene.json -q -o \xff.png --shard 1/2").exit_code, 2);
}

TEST_F(CliShardTest, APartThatShowsNothingIsNotTakenForAnEmptyPicture) {
    write_scene([](Json& scene) { scene["observer"]["look_at"] = {1.5, 0.2, 0.5}; });
    const std::string line = "render scene.json --strict -q -o s.png ";
    ASSERT_EQ(run(line).exit_code, 0);
    EXPECT_EQ(run(line + "--shard 3/3").exit_code, 0);
    EXPECT_EQ(run(line + "--crop 0,11,20,1").exit_code, 0);
}

TEST_F(CliShardTest, APartGoesOnWhereItEnded) {
    const std::string line = std::string(kImage) + "--shard 2/3 --resume";
    ASSERT_EQ(run(line).exit_code, 0);
    std::filesystem::remove(folder / "p.exr.2-of-3.shard");
    const auto time = std::filesystem::last_write_time(folder / "p.exr.2-of-3.shard.exr");
    ASSERT_EQ(run(line).exit_code, 0);
    EXPECT_TRUE(std::filesystem::exists(folder / "p.exr.2-of-3.shard"));
    EXPECT_EQ(std::filesystem::last_write_time(folder / "p.exr.2-of-3.shard.exr"), time);
}

TEST_F(CliShardTest, WhatCantBeCutIsAMistake) {
    for (const char* shard : {"0/2", "3/2", "2", "1/0", "a/b", "1/2/3", "-1/2"})
        EXPECT_THAT(expect_failure(2, fmt::format("render scene.json -o a.png --shard={}", shard)),
                    HasSubstr(fmt::format("--shard {}: give I/N", shard)));
    EXPECT_THAT(expect_failure(2, "render scene.json -o a.png --shard 1/2 --overwrite never"),
                HasSubstr("give --resume"));
    EXPECT_THAT(expect_failure(2, "render scene.json --volume a.nrrd --shard 1/2"),
                HasSubstr("no volumetric image of one frame"));
    EXPECT_EQ(run_line("sh -c 'voxelume render scene.json -o - --shard 1/2 | cat; exit 2'").out,
              "");
}

}  // namespace
}  // namespace voxelume
