// SPDX-License-Identifier: Apache-2.0
// Samples that are added to the images of earlier runs.
#include <gmock/gmock.h>

#include <cmath>
#include <set>

#include "runtime/io/image/exr.hpp"
#include "runtime/io/image/png.hpp"
#include "tests/cli/scene_program.hpp"

namespace voxelume {
namespace {

using testing::HasSubstr;

class CliContinueTest : public SceneProgramTest {
  protected:
    void SetUp() override {
        SceneProgramTest::SetUp();
        // A box that the corners of pixels miss, in light that paths find.
        write_scene([](Json& scene) { scene["objects"][0]["turn"] = {20, 30, 10}; });
    }

    void render(const std::string& options) const {
        const ProgramResult result = run("render scene.json --float -q " + options);
        ASSERT_EQ(result.exit_code, 0) << options << "\n" << result.err;
    }

    void expect_same_files(const std::string& a, const std::string& b) const {
        EXPECT_FALSE(bytes_of(folder / a).empty());
        EXPECT_TRUE(bytes_of(folder / a) == bytes_of(folder / b)) << a << " and " << b;
    }

    /// Expects that an image of 2 and 6 more samples has the bytes of one with 8.
    void expect_continued(const std::string& options) const {
        SCOPED_TRACE(options);
        render(options + " --samples 2 -o two.exr");
        render(options + " --samples 8 -o eight.exr");
        render(options + " --samples 8 -o more.exr --continue two.exr");
        expect_same_files("eight.exr", "more.exr");
    }
};

TEST_F(CliContinueTest, HasTheBytesOfOneRun) {
    expect_continued("");
    expect_continued("--light global --channels RGBA,distance,materialId --multi-part");
    expect_continued("--channels RGBA");
    expect_continued("--channels Z,P,N --crop 3,2,13,9");
    expect_continued("--channels objectId,P --device all/2");
}

TEST_F(CliContinueTest, GoesOnWithPartsOfTheLight) {
    write_scene([](Json& scene) {
        scene["objects"][0]["turn"] = {20, 30, 10};
        scene["lights"][0]["group"] = "key";
    });
    const std::string all = "RGBA,albedo,direct,indirect,shadow,lights";
    expect_continued("--channels " + all);
    expect_continued("--light global --channels " + all);
    expect_continued("--light global --channels indirect,shadow,albedo,samples --device all/2");
    expect_continued("--channels direct,lights --crop 3,2,13,9 --multi-part");
    expect_continued("--channels P,objectId,motion");
}

TEST_F(CliContinueTest, RanksMattesAgain) {
    expect_continued("--channels RGBA,CryptoObject,CryptoMaterial");
    expect_continued("--channels CryptoMaterial --multi-part");
    expect_continued("--channels CryptoObject,albedo,Z --device all/2");
}

TEST_F(CliContinueTest, TracesPartsOfTheLightThatAreMissing) {
    const auto sight_rays = [this](const std::string& options) {
        render(options + " --stats-json stats.json");
        return Json::parse(bytes_of(folder / "stats.json")).at("sight_rays").get<int>();
    };
    // The colour and its parts share sight rays.
    render("--samples 4 -o four.exr --channels RGBA,albedo,direct");
    EXPECT_EQ(sight_rays("--samples 6 -o six.exr --channels RGBA,albedo,direct "
                         "--continue four.exr"),
              20 * 12 * 2);
}

TEST_F(CliContinueTest, GoesOnWithAllChannelsByNoise) {
    write_scene([](Json& scene) { scene["lights"][0]["group"] = "key"; });
    const std::string line =
        "--light global --channels RGBA,samples,noise,variance,albedo,direct,indirect,shadow,"
        "lights,CryptoObject,P,objectId,motion ";
    for (const char* layout : {"", "--multi-part ", "--device all/2 "}) {
        SCOPED_TRACE(layout);
        render(line + layout + "-o much.exr --samples 64 --noise 0.2");
        render(line + layout + "-o little.exr --samples 256 --noise 0.05");
        render(line + layout + "-o more.exr --samples 256 --noise 0.05 --continue much.exr");
        expect_same_files("little.exr", "more.exr");
    }
}

TEST_F(CliContinueTest, GoesOnFromFilesThatWereContinued) {
    render("--samples 1 -o image.exr");
    for (const int samples : {2, 8, 24})
        render(fmt::format("--samples {} -o image.exr --continue image.exr", samples));
    render("--samples 24 -o whole.exr");
    expect_same_files("image.exr", "whole.exr");
}

TEST_F(CliContinueTest, TracesWhatIsMissing) {
    const auto sight_rays = [this](const std::string& options) {
        render(options + " --stats-json stats.json");
        return Json::parse(bytes_of(folder / "stats.json")).at("sight_rays").get<int>();
    };
    EXPECT_EQ(sight_rays("--samples 4 -o four.exr"), 20 * 12 * 4);
    EXPECT_EQ(sight_rays("--samples 6 -o six.exr --continue four.exr"), 20 * 12 * 2);
}

TEST_F(CliContinueTest, TakesTheFilesOfFrames) {
    write_scene([](Json& scene) {
        scene["animation"] = Json::parse(R"({"frames": 3, "tracks": [{
            "target": "objects[0].turn", "keys": [{"frame": 1, "value": [0, 0, 0]},
                                                  {"frame": 3, "value": [9, 9, 9]}]}]})");
    });
    render("--samples 2 -o few.####.exr");
    render("--samples 5 -o many.####.exr");
    render("--samples 5 -o more.####.exr --continue few.####.exr");
    for (const int frame : {1, 2, 3})
        expect_same_files(fmt::format("many.{:04}.exr", frame),
                          fmt::format("more.{:04}.exr", frame));
}

TEST_F(CliContinueTest, GoesOnWithTheWaysOfThings) {
    write_scene([](Json& scene) {
        scene["animation"] = Json::parse(R"({"frames": 2, "tracks": [{
            "target": "objects[0].position", "keys": [{"frame": 1, "value": [0, 0, 0]},
                                                      {"frame": 2, "value": [0.3, 0.1, 0]}]}]})");
    });
    const std::string options = "--frames 1 --channels RGBA,P,objectId,motion ";
    render(options + "--samples 2 -o two.####.exr");
    render(options + "--samples 8 -o eight.####.exr");
    render(options + "--samples 8 -o more.####.exr --continue two.####.exr");
    expect_same_files("eight.0001.exr", "more.0001.exr");
}

TEST_F(CliContinueTest, GoesOnByNoiseWhereTilesNeedIt) {
    const std::string line = "--light global --channels RGBA,Z,samples,noise -o ";
    render(line + "much.exr --samples 64 --noise 0.2");
    render(line + "little.exr --samples 512 --noise 0.04");
    render(line + "more.exr --samples 512 --noise 0.04 --continue much.exr --stats-json s.json");
    expect_same_files("little.exr", "more.exr");
    const Image much = read_exr(folder / "much.exr"), little = read_exr(folder / "little.exr");
    double missing = 0;
    for (size_t i = 0; i < little.planes.at("samples").size(); ++i)
        missing += double(little.planes.at("samples")[i]) - double(much.planes.at("samples")[i]);
    EXPECT_EQ(Json::parse(bytes_of(folder / "s.json")).at("sight_rays"), missing);
    EXPECT_THAT(expect_failure(2,
                               "render scene.json --float --light global --noise 0.3 "
                               "--channels RGBA,Z,samples,noise -o out.exr "
                               "--continue much.exr"),
                HasSubstr("noise of 0.2 by at most 64 samples"));
}

TEST_F(CliContinueTest, ShowsHowManySamplesPixelsHave) {
    const auto plane = [this](const std::string& options, const char* name) {
        render(options + " --channels samples,noise -o image.exr");
        const Plane<float> values = read_exr(folder / "image.exr").planes.at(name);
        return std::set<float>(values.begin(), values.end());
    };
    EXPECT_EQ(plane("--samples 3", "samples"), std::set{3.0f});
    EXPECT_EQ(plane("--samples 3", "noise"), std::set{INFINITY});
    const std::set<float> noises = plane("--samples 64 --noise 0.05", "noise");
    EXPECT_GE(noises.size(), 2u);
    EXPECT_LT(*noises.rbegin(), 1);
    write_scene([](Json& scene) { scene["render"]["adaptive"] = 0.1; });
    EXPECT_EQ(plane("--samples 4", "samples"), (std::set{1.0f, 4.0f}));
}

TEST_F(CliContinueTest, RefusesWhatHasNotTheBitsOfOneRun) {
    render("--samples 4 -o four.exr");
    render("--samples 3 -o three.exr");
    const std::string line = "render scene.json --float -o out.exr ";
    EXPECT_THAT(expect_failure(2, "render scene.json -o out.exr --samples 8 --continue four.exr"),
                HasSubstr("32-bit floats"));
    EXPECT_THAT(expect_failure(4, line + "--samples 8 --continue three.exr"),
                HasSubstr("three.exr: has 3 samples a pixel"));
    for (const int samples : {2, 4})
        EXPECT_THAT(
            expect_failure(2, line + fmt::format("--samples {} --continue four.exr", samples)),
            HasSubstr(fmt::format("has 4 samples a pixel, and {} are asked for", samples)));
    EXPECT_THAT(expect_failure(2, line + "--noise 0.1 --continue four.exr"),
                HasSubstr("channels RGBA, samples and noise"));
    EXPECT_THAT(expect_failure(2, line + "--noise 0.1 --channels RGBA,samples,noise "
                                         "--continue four.exr"),
                HasSubstr("has samples by their number"));
    EXPECT_THAT(expect_failure(2, line + "--samples 8 --dry-run --continue four.exr"),
                HasSubstr("leave out --continue"));
    EXPECT_THAT(expect_failure(2, line + "--samples 8 --continue ''"), HasSubstr("names no file"));
    EXPECT_THAT(expect_failure(2, line + "--samples 8 --shard 1/2 --continue four.exr"),
                HasSubstr("leave out --shard"));
    EXPECT_THAT(expect_failure(2, line + "--samples 8 --volume v.vdb --continue four.exr"),
                HasSubstr("flat images alone"));
    EXPECT_THAT(
        expect_failure(2, line + "--samples 8 --channels RGBA,variance --continue four.exr"),
        HasSubstr("channels variance"));
    EXPECT_THAT(expect_failure(2, line + "--samples 8 --channels RGBA,motion --continue four.exr"),
                HasSubstr("channels motion only where P and objectId"));
    EXPECT_THAT(expect_failure(2, line + "--samples 8 --channels P --continue four.exr"),
                HasSubstr("channels P only where"));
}

TEST_F(CliContinueTest, GoesOnWithTexturesByNoiseAlone) {
    put_bytes(folder / "cloth.obj",
              "mtllib cloth.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nvt 0 0\nvt 1 0\nvt 0 1\n"
              "usemtl cloth\nf 1/1 3/2 2/3\nf 1/1 2/2 4/3\nf 2/1 3/2 4/3\nf 3/1 1/2 4/3\n");
    put_bytes(folder / "cloth.mtl", "newmtl cloth\nKd 1 1 1\nmap_Kd paint.png\n");
    write_png(folder / "paint.png",
              {2, 1, {{"R", {0.9f, 0.1f}}, {"G", {0.2f, 0.8f}}, {"B", {0.4f, 0.5f}}}, {}, {}});
    write_scene([](Json& scene) {
        scene["models"]["thing"] = {{"mesh", "cloth.obj"}, {"surface", "exact"}};
    });
    render("--samples 2 -o two.exr");
    EXPECT_THAT(expect_failure(2,
                               "render scene.json --float -o out.exr --samples 8 "
                               "--continue two.exr"),
                HasSubstr("wear textures"));
    const std::string line = "--channels RGBA,samples,noise -o ";
    render(line + "much.exr --samples 64 --noise 0.5");
    render(line + "little.exr --samples 128 --noise 0.02");
    render(line + "more.exr --samples 128 --noise 0.02 --continue much.exr");
    expect_same_files("little.exr", "more.exr");
}

TEST_F(CliContinueTest, RefusesFilesOfSomethingElse) {
    render("--samples 4 -o four.exr");
    const std::string line = "render scene.json --float -o out.exr --samples 8 --continue ";
    EXPECT_THAT(expect_failure(4, line + "none.exr"), HasSubstr("none.exr"));
    EXPECT_THAT(expect_failure(4, line + "scene.json"), HasSubstr("scene.json"));
    EXPECT_THAT(expect_failure(4, line + "four.exr --channels RGBA"),
                HasSubstr("from another scene, frame, option or version"));
    EXPECT_THAT(expect_failure(4, line + "four.exr --size 21x12"), HasSubstr("another scene"));
    std::string bytes = bytes_of(folder / "four.exr");
    bytes[bytes.size() - 40] ^= 1;
    put_bytes(folder / "four.exr", bytes);
    EXPECT_THAT(expect_failure(4, line + "four.exr"), HasSubstr("isn't as it was written"));
}

}  // namespace
}  // namespace voxelume
