// SPDX-License-Identifier: Apache-2.0
// Runs that go on where others ended: what is finished stays, what isn't is rendered.
#include <gmock/gmock.h>

#include <cstdio>
#include <map>
#include <sstream>

#include "runtime/base/version.hpp"
#include "runtime/io/image/png.hpp"
#include "tests/cli/scene_program.hpp"

namespace voxelume {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

class CliResumeTest : public SceneProgramTest {
  protected:
    static constexpr const char* kLine = "render scene.json -o f.#.exr -o f.#.png ";

    void SetUp() override {
        SceneProgramTest::SetUp();
        write_moving_scene([](Json&) {});
    }

    template <class Change>
    void write_moving_scene(const Change& change) {
        put_bytes(folder / "tetrahedron.obj", kTetrahedron);
        write_scene([&](Json& scene) {
            scene["models"]["thing"] = {{"mesh", "tetrahedron.obj"}, {"surface", "cubes"}};
            scene["animation"] = Json::parse(R"({"frames": 4, "tracks": [{
                "target": "objects[0].turn", "keys": [{"frame": 1, "value": [0, 0, 0]},
                                                      {"frame": 4, "value": [9, 9, 9]}]}]})");
            change(scene);
        });
    }

    /// The text of a mesh whose faces have the first three places on a texture.
    static std::string textured_faces(std::string text) {
        std::string result;
        std::istringstream lines(text);
        for (std::string line; std::getline(lines, line); result += line + "\n")
            if (int a = 0, b = 0, c = 0; std::sscanf(line.c_str(), "f %d %d %d", &a, &b, &c) == 3)
                line = fmt::format("f {}/1 {}/2 {}/3", a, b, c);
        return result;
    }

    void write_paint(float red) const {
        const Image paint{
            2, 1, {{"R", {red, 0.1f}}, {"G", {0.2f, 0.3f}}, {"B", {0.4f, 0.5f}}}, {}, {}};
        write_png(folder / "paint.png", paint);
    }

    std::map<std::string, std::string> pictures() const {
        std::map<std::string, std::string> files;
        for (const std::string& name : names())
            if (name.starts_with("f.")) files[name] = bytes_of(folder / name);
        return files;
    }

    /// When each picture was written.
    std::map<std::string, std::filesystem::file_time_type> times() const {
        std::map<std::string, std::filesystem::file_time_type> list;
        for (const auto& [name, bytes] : pictures())
            list[name] = std::filesystem::last_write_time(folder / name);
        return list;
    }

    /// Runs again and returns how many files were rendered.
    int count_rendered(const std::string& options) const {
        const ProgramResult result = run(kLine + options + " --progress json");
        EXPECT_EQ(result.exit_code, 0) << result.err;
        int count = 0;
        for (size_t at = result.err.find("\"written\""); at != std::string::npos;
             at = result.err.find("\"written\"", at + 1))
            ++count;
        return count;
    }
};

TEST_F(CliResumeTest, OnlyWhatIsMissingOrDamagedIsRendered) {
    ASSERT_EQ(count_rendered(""), 8);
    const auto whole = pictures();
    EXPECT_EQ(count_rendered("--resume"), 0);
    std::filesystem::remove(folder / "f.2.exr");
    std::string damaged = whole.at("f.3.png");
    damaged[damaged.size() / 2] ^= 4;
    put_bytes(folder / "f.3.png", damaged);
    put_bytes(folder / "f.4.exr", whole.at("f.4.exr").substr(0, 900));
    EXPECT_EQ(count_rendered("--resume"), 3);
    EXPECT_EQ(pictures(), whole);
    EXPECT_EQ(count_rendered("--overwrite always"), 8);
    EXPECT_EQ(pictures(), whole);
}

TEST_F(CliResumeTest, WhatWasMadeFromSomethingElseIsStale) {
    ASSERT_EQ(count_rendered(""), 8);
    EXPECT_EQ(count_rendered("--resume --set world.ambient=0.4,0.3,0.3"), 8);
    EXPECT_EQ(count_rendered("--resume"), 8);  // those of the changed scene are stale now
    EXPECT_EQ(count_rendered("--resume --samples 2"), 8);
    EXPECT_EQ(count_rendered("--resume --samples 2 --set render.filter=tent"), 8);
    EXPECT_EQ(count_rendered("--resume --samples 2 --set render.filter=tent"), 0);
    EXPECT_EQ(count_rendered("--resume --samples 2 --crop 0,0,9,9"), 8);
    EXPECT_EQ(count_rendered("--resume --samples 2 --crop 0,0,9,9 --device all/2 --no-cache"), 0);
    ASSERT_EQ(count_rendered(""), 8);
    put_bytes(folder / "tetrahedron.obj", std::string(kTetrahedron) + "# changed\n");
    EXPECT_EQ(count_rendered("--resume"), 8);
}

TEST_F(CliResumeTest, ItSaysWhyFilesAreRenderedAgain) {
    const std::string line = std::string(kLine) + "--resume --frames 1-3 --volume v.#.raw";
    EXPECT_THAT(run(line).err, Not(HasSubstr("again")));
    put_bytes(folder / "f.1.png", "not a picture");
    EXPECT_THAT(run(std::string(kLine) + "--resume").err,
                AllOf(HasSubstr("2 of 4 frames are there already\n"),
                      HasSubstr("1 file is damaged or has no hash in it, and rendered again\n"),
                      Not(HasSubstr("another scene"))));
    EXPECT_THAT(run(line + " --samples 2").err,
                AllOf(HasSubstr("3 files are damaged or have no hash in them, and rendered again"),
                      HasSubstr("6 files are of another scene, file, option or version, and "
                                "rendered again\n"),
                      Not(HasSubstr("already"))));
    EXPECT_EQ(run(line + " --samples 2 -q").err, "");
}

TEST_F(CliResumeTest, FilesOfAnotherVersionAreRenderedAgain) {
    ASSERT_EQ(count_rendered(""), 8);
    const auto whole = pictures();
    // This program differs in its number alone, since nobody knows what else a version changes.
    std::string program = bytes_of(VXL_BINARY);
    const std::string number = version(), other = number.substr(0, number.size() - 1) + "z";
    for (size_t i = 0; (i = program.find(number, i)) != program.npos; i += number.size())
        program.replace(i, number.size(), other);
    put_bytes(folder / "other", program);
    std::filesystem::permissions(folder / "other", std::filesystem::perms::owner_all);
    ASSERT_THAT(run_line("./other --version").out, HasSubstr("voxelume " + other + "\n"));
    const std::string line = std::string("./other ") + kLine + "--resume";
    const ProgramResult result = run_line(line);
    EXPECT_EQ(result.exit_code, 0);
    EXPECT_THAT(result.err, HasSubstr("8 files are of another scene, file, option or version, "));
    EXPECT_THAT(run_line(line).err, HasSubstr("4 of 4 frames are there already\n"));
    EXPECT_EQ(count_rendered("--resume"), 8);
    EXPECT_EQ(pictures(), whole);
}

TEST_F(CliResumeTest, AChangedCompanionOfAMeshMakesFramesStale) {
    put_bytes(
        folder / "tetrahedron.obj",
        "mtllib paint.mtl\nusemtl paint\nvt 0 0\nvt 1 0\nvt 0 1\n" + textured_faces(kTetrahedron));
    put_bytes(folder / "paint.mtl", "newmtl paint\nmap_Kd paint.png\n");
    write_paint(0.8f);
    ASSERT_EQ(count_rendered(""), 8);
    EXPECT_EQ(count_rendered("--resume"), 0);
    write_paint(0.3f);
    EXPECT_EQ(count_rendered("--resume"), 8);
    put_bytes(folder / "paint.mtl", "newmtl paint\nmap_Kd paint.png\nKd 0.5 0.5 0.5\n");
    EXPECT_EQ(count_rendered("--resume"), 8);
    std::filesystem::remove(folder / "paint.png");
    EXPECT_EQ(count_rendered("--resume"), 8);
    EXPECT_EQ(count_rendered("--resume"), 0);
}

TEST_F(CliResumeTest, ChangedValuesNextToAHeaderMakeFramesStale) {
    put_bytes(folder / "a.nhdr",
              "NRRD0004\ntype: uint8\ndimension: 3\nsizes: 4 4 4\nencoding: raw\n"
              "data file: a.raw\n\n");
    put_bytes(folder / "a.raw", std::string(64, '\1'));
    write_moving_scene([](Json& scene) {
        scene["models"]["thing"] = {{"voxels", "a.nhdr"}, {"fit", 0.8}};
    });
    ASSERT_EQ(count_rendered(""), 8);
    EXPECT_EQ(count_rendered("--resume"), 0);
    put_bytes(folder / "a.raw", std::string(32, '\1') + std::string(32, char(0)));
    EXPECT_EQ(count_rendered("--resume"), 8);
}

TEST_F(CliResumeTest, MoreFramesLeaveTheFirstOnesAsTheyAre) {
    ASSERT_EQ(count_rendered(""), 8);
    write_moving_scene([](Json& scene) { scene["animation"]["frames"] = 6; });
    EXPECT_EQ(count_rendered("--overwrite changed"), 4);
}

TEST_F(CliResumeTest, NeverKeepsWhateverIsThere) {
    put_bytes(folder / "f.1.exr", "mine");
    EXPECT_EQ(count_rendered("--overwrite never"), 7);
    EXPECT_EQ(bytes_of(folder / "f.1.exr"), "mine");
    const ProgramResult result = run(std::string(kLine) + "--overwrite never");
    EXPECT_EQ(result.exit_code, 0);
    EXPECT_THAT(result.err, HasSubstr("4 of 4 frames are there already"));
}

TEST_F(CliResumeTest, StatisticsAreWrittenWhereNothingIsLeftToRender) {
    ASSERT_EQ(count_rendered(""), 8);
    ASSERT_EQ(count_rendered("--resume --stats-json s.json"), 0);
    EXPECT_EQ(Json::parse(bytes_of(folder / "s.json")).at("frames").size(), 0u);
    EXPECT_THAT(expect_failure(2, "render scene.json -o a.png --stats-json -"),
                HasSubstr("--stats-json -: "));
}

TEST_F(CliResumeTest, VolumesWithHeadersCarryTheHashToo) {
    const std::string line =
        "render scene.json --volume v.#.nrrd --volume v.#.vdb --volume v.#.ply --volume v.#.raw";
    ASSERT_EQ(run(line).exit_code, 0);
    const ProgramResult result = run(line + " --resume --progress json");
    ASSERT_EQ(result.exit_code, 0) << result.err;
    EXPECT_THAT(result.err, AllOf(HasSubstr("v.1.raw"), Not(HasSubstr("v.1.ply")),
                                  Not(HasSubstr("v.1.nrrd")), Not(HasSubstr("v.1.vdb"))));
}

TEST_F(CliResumeTest, DamagedHeadersOfSlicesArentWaitedFor) {
    const std::string line = "render scene.json --frames 1 --volume s.#.%03d.png --resume -q";
    ASSERT_EQ(run(line).exit_code, 0);
    const std::string header = bytes_of(folder / "s.1.json");
    for (const char* count : {"9000000000000", "-1", "0", "3000000000", "1e99"}) {
        Json damaged = Json::parse(header);
        damaged["shape"][2] = Json::parse(count);
        put_bytes(folder / "s.1.json", damaged.dump());
        EXPECT_EQ(run(line).exit_code, 0) << count;
        EXPECT_EQ(bytes_of(folder / "s.1.json"), header) << count;
    }
}

TEST_F(CliResumeTest, ACropMakesImagesStaleAndNoVolume) {
    const std::string line =
        "render scene.json --frames 1,2 -o c.#.exr --volume c.#.nrrd --progress json ";
    ASSERT_EQ(run(line + "--crop 2,3,9,7").exit_code, 0);
    const auto time = [&] { return std::filesystem::last_write_time(folder / "c.2.nrrd"); };
    const std::string volume = bytes_of(folder / "c.2.nrrd"), image = bytes_of(folder / "c.2.exr");
    const auto before = time();
    EXPECT_THAT(run(line + "--resume --crop 2,3,9,7").err, HasSubstr("2 of 2 frames are there"));
    ASSERT_EQ(run(line + "--resume").exit_code, 0);
    EXPECT_EQ(time(), before);
    EXPECT_NE(bytes_of(folder / "c.2.exr"), image);
    ASSERT_EQ(run(line).exit_code, 0);
    EXPECT_EQ(bytes_of(folder / "c.2.nrrd"), volume);
    EXPECT_THAT(expect_failure(2, "render scene.json --volume c.nrrd --crop 2,3,9,7"),
                HasSubstr("--crop is of images, and no -o names one"));
}

TEST_F(CliResumeTest, AKilledRunGoesOnToTheSameFilesAndWritesNoneTwice) {
    ASSERT_EQ(count_rendered(""), 8);
    const auto whole = pictures();
    for (const char* seconds : {"0.05", "0.1", "0.2", "0.3", "0.5", "0.8"}) {
        for (const auto& [name, bytes] : whole) std::filesystem::remove(folder / name);
        run_line(fmt::format("timeout -s KILL {} voxelume {} -q", seconds, kLine));
        const auto finished = times();
        ASSERT_EQ(run(std::string(kLine) + "--resume -q").exit_code, 0);
        EXPECT_EQ(pictures(), whole) << seconds;
        for (const auto& [name, time] : finished) EXPECT_EQ(times().at(name), time) << name;
    }
}

}  // namespace
}  // namespace voxelume
