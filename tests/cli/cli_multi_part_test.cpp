// SPDX-License-Identifier: Apache-2.0
// Files with a part for each layer, in everything that reads or writes images.
#include <gmock/gmock.h>

#include "runtime/io/image/exr.hpp"
#include "tests/cli/scene_program.hpp"

namespace voxelume {
namespace {

using testing::HasSubstr;

class CliMultiPartTest : public SceneProgramTest {
  protected:
    static constexpr const char* kLayers =
        "render scene.json -q --samples 4 --channels RGBA,CryptoObject,CryptoMaterial ";

    auto time_of(const char* name) const { return std::filesystem::last_write_time(folder / name); }
    size_t parts_of(const char* name) const { return read_exr_header(folder / name).parts.size(); }
};

TEST_F(CliMultiPartTest, PartsOfARunMergeToTheBytesOfASingleRun) {
    const std::string line = std::string(kLayers) + "-o m.exr -o m.png --multi-part ";
    for (const std::string crop : {"", "--crop 2,1,15,9 "}) {
        ASSERT_EQ(run(line + crop).exit_code, 0);
        EXPECT_EQ(parts_of("m.exr"), 7u);
        const std::string whole = bytes_of(folder / "m.exr"), png = bytes_of(folder / "m.png");
        std::filesystem::remove(folder / "m.exr");
        for (const char* shard : {"1/2", "2/2"})
            ASSERT_EQ(run(line + crop + "--shard " + shard).exit_code, 0);
        ASSERT_EQ(run("merge m.exr.*.shard").exit_code, 0);
        EXPECT_EQ(bytes_of(folder / "m.exr"), whole);
        EXPECT_EQ(bytes_of(folder / "m.png"), png);
    }
    ASSERT_EQ(run(std::string(kLayers) + "-o m.exr -o m.png --crop 2,1,15,9 --shard 2/2").exit_code,
              0);
    const ProgramResult mixed = run("merge m.exr.1-of-2.shard m.exr.2-of-2.shard");
    EXPECT_EQ(mixed.exit_code, 4);
    EXPECT_THAT(mixed.err, HasSubstr("options of images differ"));
}

TEST_F(CliMultiPartTest, ResumeKeepsAFileOfPartsAndReplacesOneWithout) {
    const std::string line = std::string(kLayers) + "-o m.exr --resume ";
    ASSERT_EQ(run(line).exit_code, 0);
    EXPECT_EQ(parts_of("m.exr"), 0u);
    ASSERT_EQ(run(line + "--multi-part").exit_code, 0);
    EXPECT_EQ(parts_of("m.exr"), 7u);
    const auto time = time_of("m.exr");
    ASSERT_EQ(run(line + "--multi-part").exit_code, 0);
    EXPECT_EQ(time_of("m.exr"), time);
    std::string bytes = bytes_of(folder / "m.exr");
    bytes.back() ^= 1;  // the last part's last chunk
    put_bytes(folder / "m.exr", bytes);
    EXPECT_EQ(run("info --verify m.exr").exit_code, 4);
    ASSERT_EQ(run(line + "--multi-part").exit_code, 0);
    EXPECT_EQ(run("info --verify m.exr").exit_code, 0);
}

TEST_F(CliMultiPartTest, InfoAndDiffShowAllParts) {
    ASSERT_EQ(run(std::string(kLayers) + "-o m.exr --multi-part").exit_code, 0);
    ASSERT_EQ(run(std::string(kLayers) + "-o o.exr").exit_code, 0);
    const Json info = Json::parse(run("info --json m.exr").out);
    ASSERT_EQ(info["parts"].size(), 7u);
    EXPECT_EQ(info["parts"][0]["part"], "rgba");
    EXPECT_EQ(info["parts"][0]["channels"], "A B G R");
    EXPECT_EQ(info["parts"][1]["part"], "CryptoMaterial00");
    EXPECT_EQ(info["channels"], Json::parse(run("info --json o.exr").out)["channels"]);
    const ProgramResult same = run("diff m.exr o.exr --fail 0");
    EXPECT_EQ(same.exit_code, 0);
    EXPECT_THAT(same.out, HasSubstr("CryptoObject02.A"));
    ASSERT_EQ(
        run(std::string(kLayers) + "-o n.exr --multi-part --set world.ambient=0,0,0").exit_code, 0);
    const ProgramResult other = run("diff m.exr n.exr --fail 0 -o d.exr");
    EXPECT_EQ(other.exit_code, 1);
    EXPECT_EQ(read_exr(folder / "d.exr").planes.size(), 28u);
}

TEST_F(CliMultiPartTest, AStreamHasTheBytesOfTheFile) {
    ASSERT_EQ(run(std::string(kLayers) + "-o m.exr --multi-part").exit_code, 0);
    ASSERT_EQ(run_line("sh -c 'voxelume " + std::string(kLayers) + "-o -.exr --multi-part >s.exr'")
                  .exit_code,
              0);
    // The stream's image wasn't hashed for a file, so that it has no stamp.
    EXPECT_EQ(read_exr(folder / "s.exr").planes, read_exr(folder / "m.exr").planes);
    EXPECT_EQ(parts_of("s.exr"), 7u);
}

}  // namespace
}  // namespace voxelume
