// SPDX-License-Identifier: Apache-2.0
// Images that are larger than --memory-limit: the files are those of a run without it.
#include <gmock/gmock.h>
#include <sys/resource.h>
#include <sys/wait.h>

#include "runtime/base/sanitizers.hpp"
#include "tests/cli/scene_program.hpp"

namespace voxelume {
namespace {

using testing::HasSubstr;

/// The program counts 300 MB of the limit for itself, so the image may take a hundred.
constexpr const char* kLimit = " --memory-limit 400MB";
constexpr double kLimitBytes = 400e6;

class CliBandsTest : public SceneProgramTest {
  protected:
    void SetUp() override {
        SceneProgramTest::SetUp();
        write_scene([](Json& scene) { scene["render"]["size"] = {1501, 997}; });
    }

    Json statistics() const { return Json::parse(bytes_of(folder / "stats.json")); }

    /// The bytes of main memory that a run of the program takes at most.
    double peak_of(const std::string& arguments) const {
        const pid_t child = fork();
        if (child == 0) {
            const std::string line = fmt::format("cd '{}' && exec '{}' {} 2>stderr.txt",
                                                 folder.string(), VXL_BINARY, arguments);
            execl("/bin/sh", "sh", "-c", line.c_str(), nullptr);
            _exit(127);
        }
        int status = 0;
        rusage usage{};
        EXPECT_EQ(wait4(child, &status, 0, &usage), child);
        EXPECT_EQ(status, 0) << bytes_of(folder / "stderr.txt");
        return double(usage.ru_maxrss) * 1024;
    }

    /// Renders whole and in bands, into the same files.
    void expect_same_files(const std::string& options, const char* limit = kLimit) const {
        SCOPED_TRACE(options);
        const std::string line = "render scene.json -q --stats-json stats.json -o a.exr -o a.png ";
        ASSERT_EQ(run(line + options).exit_code, 0) << bytes_of(folder / "stderr.txt");
        EXPECT_EQ(statistics()["bands"], 1);
        const std::string exr = bytes_of(folder / "a.exr"), png = bytes_of(folder / "a.png");
        ASSERT_EQ(run(line + options + limit).exit_code, 0) << bytes_of(folder / "stderr.txt");
        EXPECT_GT(statistics()["bands"], 1);
        EXPECT_TRUE(bytes_of(folder / "a.exr") == exr);
        EXPECT_TRUE(bytes_of(folder / "a.png") == png);
        EXPECT_EQ(run("info --verify a.exr").exit_code, 0);
    }
};

TEST_F(CliBandsTest, FilesAreThoseOfAWholeImage) {
    expect_same_files("");
    expect_same_files(
        "--float --png-bits 16 --view-transform agx --samples 2 "
        "--set render.filter=gaussian");
    expect_same_files("--channels RGBA,Z,N,P,objectId,materialId,samples,motion --exposure 1");
}

TEST_F(CliBandsTest, FilesOfSeveralPartsAreThoseOfAWholeImage) {
    expect_same_files(
        "--multi-part --channels RGBA,Z,N,CryptoObject,CryptoMaterial,lights,direct "
        "--samples 2");
}

TEST_F(CliBandsTest, FilesInGlobalLightWithANoiseAreThoseOfAWholeImage) {
    write_scene([](Json& scene) { scene["render"] = {{"size", {701, 597}}, {"light", "global"}}; });
    expect_same_files("--noise 0.1 --samples 64 --channels RGBA,samples,noise",
                      " --memory-limit 345MB");
}

TEST_F(CliBandsTest, PartsOfImagesAreThoseOfOneInOnePiece) {
    expect_same_files("--crop 3,5,1480,903");
}

TEST_F(CliBandsTest, FramesAreThoseOfWholeImages) {
    write_scene([](Json& scene) {
        scene["render"]["size"] = {1501, 997};
        scene["animation"] = Json::parse(R"({"tracks": [{"target": "objects.thing.position",
            "keys": [{"frame": 1, "value": [1, 1, 0.5]}, {"frame": 3, "value": [2, 1, 0.5]}]}]})");
    });
    const std::string line = "render scene.json -q --frames 1-2 -o f.#.exr";
    ASSERT_EQ(run(line).exit_code, 0);
    const std::string first = bytes_of(folder / "f.1.exr"), second = bytes_of(folder / "f.2.exr");
    const ProgramResult banded = run(line + kLimit + " --stats-json stats.json");
    ASSERT_EQ(banded.exit_code, 0) << banded.err;
    EXPECT_GT(statistics()["bands"], 2);
    EXPECT_TRUE(bytes_of(folder / "f.1.exr") == first);
    EXPECT_TRUE(bytes_of(folder / "f.2.exr") == second);
    const ProgramResult again = run("render scene.json --frames 1-2 -o f.#.exr --resume");
    EXPECT_THAT(again.err, HasSubstr("2 of 2 frames are there already"));
}

TEST_F(CliBandsTest, VolumetricImagesAlongsideThemAreWhole) {
    const std::string line =
        "render scene.json -q --stats-json stats.json -o a.png --volume a.nrrd";
    ASSERT_EQ(run(line).exit_code, 0);
    const std::string png = bytes_of(folder / "a.png"), volume = bytes_of(folder / "a.nrrd");
    ASSERT_EQ(run(line + " --memory-limit 330MB").exit_code, 0);
    EXPECT_GT(statistics()["bands"], 1);
    EXPECT_TRUE(bytes_of(folder / "a.png") == png);
    EXPECT_TRUE(bytes_of(folder / "a.nrrd") == volume);
}

TEST_F(CliBandsTest, TakeNoMoreMemoryThanTheLimit) {
    // 6 million pixels of 48 bytes, 288 MB on the device and in main memory alike.
    const std::string line =
        "render scene.json -q -o a.exr -o a.png --size 3000x2000 "
        "--stats-json stats.json ";
    const double whole = peak_of(line), limited = peak_of(line + kLimit);
    if (!kHasSanitizer) {  // which takes memory of its own
        EXPECT_LT(limited, kLimitBytes);
    }
    EXPECT_LT(statistics()["peak_device_bytes"], kLimitBytes);
    EXPECT_LT(limited, whole - 100e6) << whole;
}

TEST_F(CliBandsTest, AreToldByCheck) {
    const ProgramResult text = run(std::string("check scene.json --size 3000x2000") + kLimit);
    EXPECT_EQ(text.exit_code, 0) << text.err;
    EXPECT_THAT(text.out, testing::ContainsRegex(
                              "the image is rendered in [0-9]+ bands of [0-9]+ rows, as memory"));
    const Json plan =
        Json::parse(run(std::string("check scene.json --json --size 3000x2000") + kLimit).out);
    EXPECT_EQ(plan["verdict"], "fits");
    EXPECT_GT(plan["bands"], 2);
    EXPECT_LT(plan["most MB"], 100);
    EXPECT_EQ(Json::parse(run("check scene.json --json").out)["bands"], 1);
}

TEST_F(CliBandsTest, WhatNeedsAWholeImageIsRefusedWithWhatToDo) {
    const auto refused = [&](const std::string& arguments) {
        const ProgramResult result =
            run("render scene.json -q --size 3000x2000 " + arguments + kLimit);
        EXPECT_EQ(result.exit_code, 8) << arguments << result.err;
        EXPECT_THAT(result.err, testing::MatchesRegex("voxelume: [^\n]+\n"));
        EXPECT_EQ(names(), std::vector<std::string>{"scene.json"});
        return result.err;
    };
    EXPECT_THAT(refused("-o a.exr --time 5"), HasSubstr("ask for a noise or for samples instead"));
    EXPECT_THAT(refused("-o -"), HasSubstr("only files are written in bands: write it to a file"));
    EXPECT_THAT(refused("-o a.png --stereo 0.1"), HasSubstr("ask for smaller views"));
    const ProgramResult check =
        run(std::string("check scene.json --time 5 --size 3000x2000") + kLimit);
    EXPECT_EQ(check.exit_code, 8) << check.err;
    EXPECT_THAT(check.err, HasSubstr("ask for a noise or for samples instead of a time"));
}

TEST_F(CliBandsTest, AreRefusedForTheImageWhereNotEvenTheSmallestFits) {
    const ProgramResult result = run("check scene.json --size 3000x2000 --memory-limit 305MB");
    EXPECT_EQ(result.exit_code, 8) << result.err;
    EXPECT_THAT(result.err, testing::ContainsRegex(
                                "an image of 3000x2000 pixels needs .*: render a smaller one"));
}

TEST_F(CliBandsTest, SamplesAreNotAddedToAnImageInBands) {
    ASSERT_EQ(run("render scene.json -q --float -o a.exr").exit_code, 0);
    const std::string before = bytes_of(folder / "a.exr");
    const ProgramResult result = run(
        std::string("render scene.json -q --float -o a.exr --continue a.exr --samples 2") + kLimit);
    EXPECT_EQ(result.exit_code, 8) << result.err;
    EXPECT_THAT(result.err,
                HasSubstr("samples are added to whole images: render it again from the start"));
    EXPECT_TRUE(bytes_of(folder / "a.exr") == before);
}

TEST_F(CliBandsTest, AnInterruptedRunLeavesNothing) {
    const ProgramResult result =
        run_line(fmt::format("sh -c 'voxelume render scene.json -q -o a.exr -o a.png --multi-part "
                             "--size 4000x6000 --samples 16 {} & "
                             "until ls .a.exr*.tmp 2>/dev/null; do sleep 0.05; done; "
                             "kill -TERM $! && wait $!'",
                             kLimit));
    EXPECT_EQ(result.exit_code, 143) << result.err;
    EXPECT_EQ(names(), std::vector<std::string>{"scene.json"});
}

TEST_F(CliBandsTest, AFullDiskLeavesNothing) {
    std::filesystem::create_directory(folder / "out");
    const auto render = [&](long number) {
        return run_line(
            fmt::format("env LD_PRELOAD='{}' VXL_WRITE_FAULT='{}':{}:28 VXL_WRITE_COUNTS=counts "
                        "voxelume render scene.json -q --multi-part -o out/a.exr -o out/a.png {}",
                        VXL_WRITE_FAULTS, (folder / "out").string(), number, kLimit));
    };
    ASSERT_EQ(render(0).exit_code, 0) << bytes_of(folder / "stderr.txt");
    const long count = std::stol(bytes_of(folder / "counts"));
    EXPECT_GT(count, 20);
    for (const long number : {1L, 2L, 3L, count / 3, count / 2, count - 6}) {
        std::filesystem::remove_all(folder / "out");
        std::filesystem::create_directory(folder / "out");
        const ProgramResult result = render(number);
        EXPECT_EQ(result.exit_code, 5) << number;
        EXPECT_THAT(result.err, HasSubstr("can't be written: the disk is full"));
        for (const auto& entry : std::filesystem::directory_iterator(folder / "out"))
            EXPECT_EQ(entry.path().filename(), "a.exr") << number;  // which may be whole
    }
}

}  // namespace
}  // namespace voxelume
