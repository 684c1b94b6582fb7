// SPDX-License-Identifier: Apache-2.0
// Runs that several processes share: the parts together have the bytes of a single run.
#include <gmock/gmock.h>

#include <map>

#include "tests/cli/scene_program.hpp"

namespace voxelume {
namespace {

using testing::AllOf;
using testing::HasSubstr;
namespace fs = std::filesystem;

class CliShardTest : public SceneProgramTest {
  protected:
    static constexpr const char* kImage =
        "render scene.json -q -o p.exr -o p.png --size 21x37 --samples 2 --exposure 0.5 "
        "--view-transform agx --png-bits 16 ";
    static constexpr const char* kFrames = "render moving.json -q -o f.##.exr -o f.##.png ";

    void SetUp() override {
        SceneProgramTest::SetUp();
        Json scene = Json::parse(kScene);
        scene["animation"] = Json::parse(R"({"frames": 5, "tracks": [{
            "target": "objects[0].turn", "keys": [{"frame": 1, "value": [0, 0, 0]},
                                                  {"frame": 5, "value": [9, 9, 9]}]}]})");
        put_bytes(folder / "moving.json", scene.dump(1));
    }

    /// The files of pictures, but for those of parts.
    std::map<std::string, std::string> pictures(char first) const {
        std::map<std::string, std::string> files;
        for (const std::string& name : names())
            if (name.front() == first && name.find(".shard") == name.npos)
                files[name] = bytes_of(folder / name);
        return files;
    }

    void remove(const std::map<std::string, std::string>& files) const {
        for (const auto& [name, bytes] : files) std::filesystem::remove(folder / name);
    }

    void remove_parts() const {
        for (const std::string& name : names())
            if (name.find(".shard") != name.npos) std::filesystem::remove(folder / name);
    }

    void render_parts(const std::string& line, int count) const {
        for (int number = count; number >= 1; --number) {
            const ProgramResult result = run(fmt::format("{} --shard {}/{}", line, number, count));
            ASSERT_EQ(result.exit_code, 0) << result.err;
        }
    }

    /// Expects that the parts of `line` merge to its files.
    void expect_merged(const std::string& line, char first, const std::string& parts) {
        ASSERT_EQ(run(line).exit_code, 0);
        const auto whole = pictures(first);
        ASSERT_GE(whole.size(), 2u);
        for (const int count : {1, 2, 3, 8}) {
            remove(whole);
            remove_parts();
            render_parts(line, count);
            const ProgramResult result = run("merge " + parts + "*");
            ASSERT_EQ(result.exit_code, 0) << result.err;
            EXPECT_EQ(pictures(first), whole) << count;
            EXPECT_THAT(result.err, HasSubstr(fmt::format(" of {} parts\n", count)));
        }
    }

    std::string refusal(const std::string& parts) const {
        const ProgramResult result = run("merge " + parts);
        EXPECT_EQ(result.exit_code, 4) << parts;
        return result.err;
    }
};

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

TEST_F(CliShardTest, APartOfAnotherVersionsFormatIsRefused) {
    render_parts(kImage, 2);
    const fs::path part = folder / "p.exr.1-of-2.shard";
    Json manifest = Json::parse(bytes_of(part));
    manifest["voxelume_shard"] = 1;
    put_bytes(part, manifest.dump());
    EXPECT_THAT(refusal("p.*.shard"), HasSubstr("is of another version of voxelume"));
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

TEST_F(CliShardTest, AMissingPartIsNamed) {
    render_parts(kImage, 8);
    std::filesystem::remove(folder / "p.exr.3-of-8.shard");
    std::filesystem::remove(folder / "p.exr.5-of-8.shard");
    EXPECT_THAT(refusal("p.*.shard"), HasSubstr("merge: p.exr: of 8 parts 2 are missing: 3, 5\n"));
    EXPECT_FALSE(std::filesystem::exists(folder / "p.exr"));
}

TEST_F(CliShardTest, ADoubledPartIsRefused) {
    render_parts(kImage, 2);
    std::filesystem::copy_file(folder / "p.exr.1-of-2.shard", folder / "p.copy.shard");
    EXPECT_THAT(refusal("p.*.shard"), AllOf(HasSubstr("p.copy.shard and p.exr.1-of-2.shard are "),
                                            HasSubstr("both part 1 of 2; leave one out\n")));
    EXPECT_THAT(refusal("p.copy.shard p.copy.shard"), HasSubstr("both part 1 of 2"));
}

TEST_F(CliShardTest, AForeignPartIsRefusedWithTheReason) {
    render_parts(kImage, 2);
    const auto mixed = [&](const std::string& options, const std::string& number) {
        EXPECT_EQ(run(kImage + options + " --shard " + number).exit_code, 0);
        return refusal("p.exr.1-of-*.shard p.exr.2-of-2.shard");
    };
    EXPECT_THAT(mixed("--set world.ambient=0.9,0,0", "2/2"), HasSubstr("the scene, one of its"));
    EXPECT_THAT(mixed("--light global", "2/2"), HasSubstr("its settings"));
    EXPECT_THAT(mixed("--crop 0,0,9,9", "2/2"), HasSubstr("differ in size"));
    EXPECT_THAT(mixed("--float", "2/2"), HasSubstr("options of images"));
    EXPECT_THAT(mixed("-o other.png", "2/2"), HasSubstr("different outputs"));
    EXPECT_THAT(mixed("", "1/3"), HasSubstr("one is of 2 parts, the other of 3"));
    EXPECT_EQ(run("merge p.exr.2-of-2.shard.exr").exit_code, 2);
    EXPECT_THAT(refusal("scene.json"), HasSubstr("isn't a part of a run"));
    EXPECT_THAT(refusal("nothing.shard"), HasSubstr("there is no such file"));
    EXPECT_THAT(refusal("/dev/zero"), HasSubstr("/dev/zero: isn't a file"));
}

TEST_F(CliShardTest, ADamagedPartIsCalledThat) {
    render_parts(kImage, 2);
    const fs::path part = folder / "p.exr.1-of-2.shard";
    const std::string bytes = bytes_of(part);
    const Json whole = Json::parse(bytes);
    const auto expect_damaged = [&](const std::string& text) {
        put_bytes(part, text);
        EXPECT_THAT(refusal("p.*.shard"),
                    HasSubstr("p.exr.1-of-2.shard: is damaged: render this part again\n"))
            << text;
    };
    for (size_t size = 0; size + 1 < bytes.size(); size += 7) expect_damaged(bytes.substr(0, size));
    expect_damaged(std::string(9, '\0'));
    for (const auto& [path, value] :
         std::vector<std::pair<const char*, Json>>{{"/voxelume_shard", "x"},
                                                   {"/part", 3},
                                                   {"/part", "x"},
                                                   {"/outputs", Json::array()},
                                                   {"/frames", {}},
                                                   {"/view_transform", "sgrb"},
                                                   {"/channels", "RGBX"},
                                                   {"/rows/outputs", Json::array()},
                                                   {"/rows/first", -4},
                                                   {"/rows/end", 99},
                                                   {"/rows/file", nullptr}}) {
        Json changed = whole;
        changed[Json::json_pointer(path)] = value;
        expect_damaged(changed.dump());
    }
    put_bytes(folder / "p.copy", bytes.substr(0, bytes.size() / 2));
    EXPECT_THAT(refusal("p.copy"), HasSubstr("is damaged"));
}

TEST_F(CliShardTest, APartWritesOutsideOfItsFolderOnlyWhereThatIsAskedFor) {
    std::filesystem::create_directories(folder / "in/deep");
    std::filesystem::create_directory_symlink("..", folder / "in/link");
    render_parts("render scene.json -q -o in/p.exr -o in/q.exr", 2);
    const std::string whole = (folder / "w.exr").string();
    for (const std::string& name : {std::string("../w.exr"), std::string("deep/../../w.exr"),
                                    std::string("link/w.exr"), whole}) {
        for (const char* part : {"in/p.exr.1-of-2.shard", "in/p.exr.2-of-2.shard"}) {
            Json manifest = Json::parse(bytes_of(folder / part));
            manifest["rows"]["outputs"][1] = name;
            put_bytes(folder / part, manifest.dump());
        }
        EXPECT_THAT(refusal("in/p.*.shard"),
                    AllOf(HasSubstr("merge: in/p.exr.1-of-2.shard would write "),
                          HasSubstr("w.exr, outside of its folder; --outside lets it\n")));
        EXPECT_FALSE(std::filesystem::exists(folder / "in/p.exr"));
        EXPECT_FALSE(std::filesystem::exists(whole));
        ASSERT_EQ(run("merge --outside in/p.*.shard").exit_code, 0);
        EXPECT_EQ(bytes_of(whole), bytes_of(folder / "in/p.exr"));
        std::filesystem::remove(whole);
        std::filesystem::remove(folder / "in/p.exr");
    }
    put_bytes(folder / "w.exr", "mine");
    std::filesystem::create_symlink("../w.exr", folder / "in/p.exr");
    render_parts("render scene.json -q -o in/p.exr", 2);
    EXPECT_THAT(refusal("in/p.*.shard"), HasSubstr("outside of its folder"));
    EXPECT_EQ(bytes_of(folder / "w.exr"), "mine");
    render_parts("render scene.json -q -o in/deep/q.exr -o in/deep/../deep/r.exr", 2);
    EXPECT_EQ(run("merge in/deep/q.*.shard").exit_code, 0);
}

TEST_F(CliShardTest, FramesOfPartsWithOtherOptionsOrOfAnotherSceneAreRefused) {
    const auto mixed = [&](const std::string& options) {
        render_parts(kFrames, 2);
        EXPECT_EQ(run(kFrames + options + " --shard 2/2").exit_code, 0);
        return refusal("f.*.shard");
    };
    EXPECT_THAT(mixed("--exposure 3"), HasSubstr("options of images"));
    EXPECT_THAT(mixed("--float"), HasSubstr("options of images"));
    EXPECT_THAT(mixed("--channels RGBA,Z"), HasSubstr("options of images"));
    // The first frame is the same in both.
    EXPECT_THAT(mixed("--set 'animation.tracks[0].keys[1].value=9,9,8'"),
                HasSubstr("the scene, one of its"));
}

TEST_F(CliShardTest, APartThatShowsNothingIsNotTakenForAnEmptyPicture) {
    write_scene([](Json& scene) { scene["observer"]["look_at"] = {1.5, 0.2, 0.5}; });
    const std::string line = "render scene.json --strict -q -o s.png ";
    ASSERT_EQ(run(line).exit_code, 0);
    EXPECT_EQ(run(line + "--shard 3/3").exit_code, 0);
    EXPECT_EQ(run(line + "--crop 0,11,20,1").exit_code, 0);
}

TEST_F(CliShardTest, AFileThatChangedSinceIsRefused) {
    render_parts(kFrames, 3);
    const std::string bytes = bytes_of(folder / "f.02.exr");
    put_bytes(folder / "f.02.exr", bytes.substr(0, 700));
    EXPECT_THAT(refusal("f.*.shard"),
                HasSubstr("f.02.exr: isn't as it was rendered; render part 2 of 3 again"));
    std::filesystem::remove(folder / "f.02.exr");
    EXPECT_THAT(refusal("f.*.shard"), HasSubstr("f.02.exr: isn't there"));
    ASSERT_EQ(run(std::string(kFrames) + "--shard 2/3 --resume").exit_code, 0);
    EXPECT_EQ(bytes_of(folder / "f.02.exr"), bytes);
    EXPECT_EQ(run("merge f.*.shard").exit_code, 0);
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
