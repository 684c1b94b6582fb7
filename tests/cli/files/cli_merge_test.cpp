// SPDX-License-Identifier: Apache-2.0
// Parts that merge refuses: missing, doubled, foreign, damaged or changed ones, and those that
// write elsewhere.
#include "tests/cli/shard_program.hpp"

namespace voxelume {
namespace {

using testing::AllOf;
using testing::HasSubstr;
namespace fs = std::filesystem;

using CliMergeTest = ShardProgramTest;

TEST_F(CliMergeTest, APartOfAnotherVersionsFormatIsRefused) {
    render_parts(kImage, 2);
    const fs::path part = folder / "p.exr.1-of-2.shard";
    Json manifest = Json::parse(bytes_of(part));
    manifest["voxelume_shard"] = 1;
    put_bytes(part, manifest.dump());
    EXPECT_THAT(refusal("p.*.shard"), HasSubstr("is of another version of voxelume"));
}

TEST_F(CliMergeTest, AMissingPartIsNamed) {
    render_parts(kImage, 8);
    std::filesystem::remove(folder / "p.exr.3-of-8.shard");
    std::filesystem::remove(folder / "p.exr.5-of-8.shard");
    EXPECT_THAT(refusal("p.*.shard"), HasSubstr("merge: p.exr: of 8 parts 2 are missing: 3, 5\n"));
    EXPECT_FALSE(std::filesystem::exists(folder / "p.exr"));
}

TEST_F(CliMergeTest, ADoubledPartIsRefused) {
    render_parts(kImage, 2);
    std::filesystem::copy_file(folder / "p.exr.1-of-2.shard", folder / "p.copy.shard");
    EXPECT_THAT(refusal("p.*.shard"), AllOf(HasSubstr("p.copy.shard and p.exr.1-of-2.shard are "),
                                            HasSubstr("both part 1 of 2; leave one out\n")));
    EXPECT_THAT(refusal("p.copy.shard p.copy.shard"), HasSubstr("both part 1 of 2"));
}

TEST_F(CliMergeTest, AForeignPartIsRefusedWithTheReason) {
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
    EXPECT_THAT(refusal("nothing.shard"), HasSubstr("nothing.shard: no such file"));
    EXPECT_THAT(refusal("/dev/zero"), HasSubstr("/dev/zero: isn't a plain file"));
}

TEST_F(CliMergeTest, ADamagedPartIsCalledThat) {
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
                                                   {"/part", 8.9e100},
                                                   {"/frames", 1},
                                                   {"/png_bits", 4294967304},
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

TEST_F(CliMergeTest, APartWritesOutsideOfItsFolderOnlyWhereThatIsAskedFor) {
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

TEST_F(CliMergeTest, FramesOfPartsWithOtherOptionsOrOfAnotherSceneAreRefused) {
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

TEST_F(CliMergeTest, AFileThatChangedSinceIsRefused) {
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

}  // namespace
}  // namespace voxelume
