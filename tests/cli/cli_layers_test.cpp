// SPDX-License-Identifier: Apache-2.0
// Caches in layers, and what fills them.
#include <gmock/gmock.h>

#include "tests/cli/scene_program.hpp"

namespace voxelume {
namespace {

using testing::HasSubstr;
namespace fs = std::filesystem;

class CliLayersTest : public SceneProgramTest {
  protected:
    /// Runs the program with the folders of a cache, and with PoCL's kernels in it.
    ProgramResult run_with(const std::string& cache, const std::string& arguments) const {
        return run_line(fmt::format("env -u POCL_CACHE_DIR VOXELUME_CACHE_DIR='{}' voxelume {}",
                                    cache, arguments));
    }

    static size_t count_files(const fs::path& path) {
        std::error_code error;
        size_t count = 0;
        for (const auto& entry : fs::recursive_directory_iterator(path, error))
            count += size_t(entry.is_regular_file());
        return count;
    }
};

TEST_F(CliLayersTest, AWarmBaseSparesANodeAllCompilingAndIsNotWrittenTo) {
    const fs::path base = folder / "base", top = folder / "top";
    const ProgramResult warm = run_with(base, "warm scene.json nothing.json");
    EXPECT_EQ(warm.exit_code, 4);
    EXPECT_THAT(warm.err, HasSubstr("scene.json: "));
    EXPECT_THAT(warm.err, HasSubstr("kernels compiled in "));
    EXPECT_THAT(warm.err, HasSubstr("nothing.json: the scene can't be opened"));
    const size_t files = count_files(base);
    EXPECT_GT(files, 0u);
    for (const char* output : {"a.exr", "a.png"}) {
        const ProgramResult result =
            run_with(base.string() + ":" + top.string(),
                     fmt::format("render scene.json -q -o {} --progress json", output));
        EXPECT_EQ(result.exit_code, 0) << result.err;
        EXPECT_THAT(result.err, testing::Not(HasSubstr("\"compiling\""))) << output;
    }
    EXPECT_EQ(count_files(base), files);
    EXPECT_EQ(count_files(top / "programs"), 0u);
    EXPECT_THAT(run_with(base, "warm scene.json").err, HasSubstr("scene.json: nothing to compile"));
}

TEST_F(CliLayersTest, WithoutAFolderToWriteToThereIsNothingToWarm) {
    const ProgramResult result = run_with("", "warm scene.json");
    EXPECT_EQ(result.exit_code, 2);
    EXPECT_THAT(result.err, HasSubstr("there is no cache to fill"));
    const Json report = Json::parse(run_with("/a:/b:/c", "doctor --json --no-test").out);
    EXPECT_EQ(report["cache"], "/c");
    EXPECT_THAT(run_with("/a:/b:/c", "doctor --no-test").out, HasSubstr("cache base "));
    const std::string missing = "isn't read: there is no such folder";
    EXPECT_EQ(report["cache bases"], Json::array({{{"folder", "/a"}, {"state", missing}},
                                                  {{"folder", "/b"}, {"state", missing}}}));
}

TEST_F(CliLayersTest, TheDoctorTellsWhyABaseIsNotRead) {
    const auto state_of = [&](const std::string& base) {
        const std::string text = run_with(base + ":/c", "doctor --json --no-test").out;
        return Json::parse(text)["cache bases"][0]["state"].get<std::string>();
    };
    const fs::path base = folder / "base";
    fs::create_directories(base / "programs");
    EXPECT_EQ(state_of(base), "is read");
    fs::permissions(base / "programs", fs::perms::all);
    EXPECT_EQ(state_of(base),
              "isn't read: programs: other users may write to it; `chmod go-w` forbids them");
    fs::permissions(base, fs::perms::all);
    EXPECT_EQ(state_of(base), "isn't read: other users may write to it; `chmod go-w` forbids them");
    put_bytes(folder / "file", "");
    EXPECT_EQ(state_of(folder / "file"), "isn't read: Not a directory");
    fs::permissions(base, fs::perms::owner_all);
    fs::permissions(base / "programs", fs::perms::owner_all);
    fs::create_directory_symlink(base, folder / "link");  // of the user, who named it
    EXPECT_EQ(state_of(folder / "link"), "is read");
    fs::rename(base / "programs", folder / "elsewhere");
    fs::create_directory_symlink(folder / "elsewhere", base / "programs");
    EXPECT_EQ(state_of(base),
              "isn't read: programs: a link in the place of a folder isn't followed");
}

TEST_F(CliLayersTest, ARunTellsOfABaseThatItDoesNotRead) {
    const std::string caches = "/none:" + (folder / "top").string();
    const std::string note =
        "note: /none, a base of the cache, isn't read: there is no such folder";
    EXPECT_THAT(run_with(caches, "render scene.json -o a.png").err, HasSubstr(note));
    EXPECT_THAT(run_with(caches, "render scene.json -o a.png -q").err, testing::IsEmpty());
}

TEST_F(CliLayersTest, StrictWarmingEndsWithTheFirstWarning) {
    write_scene([](Json& scene) { scene["objects"][0]["position"] = {90, 1, 0.5}; });
    const ProgramResult told = run_with(folder / "base", "warm scene.json");
    EXPECT_EQ(told.exit_code, 0);
    EXPECT_THAT(told.err, HasSubstr("warning: "));
    const ProgramResult strict = run_with(folder / "base", "warm scene.json --strict");
    EXPECT_EQ(strict.exit_code, 3);
    EXPECT_THAT(strict.err, HasSubstr("voxelume: scene.json"));
}

}  // namespace
}  // namespace voxelume
