// SPDX-License-Identifier: Apache-2.0
// The commands render, check and voxelize on good input; cli_bad_input_test.cpp has bad input.
#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "runtime/io/image/exr.hpp"
#include "runtime/io/image/png.hpp"
#include "runtime/io/vdb/vdb.hpp"
#include "tests/cli/scene_program.hpp"
#include "tests/support/setting.hpp"

namespace voxelume {

using testing::HasSubstr;
using testing::IsEmpty;
using testing::StartsWith;

class CliRenderTest : public SceneProgramTest {};

TEST_F(CliRenderTest, OneSceneRendersToBothFormatsAtOnce) {
    const ProgramResult result = run("render scene.json -o out.exr -o out.png");
    EXPECT_EQ(result.exit_code, 0) << result.err;
    EXPECT_THAT(result.out, IsEmpty());
    EXPECT_THAT(result.err, StartsWith("20x12 in "));
    EXPECT_THAT(result.err, HasSubstr(" 240 sight and "));
    const Image image = read_exr(folder / "out.exr");
    EXPECT_EQ(image.width, 20);
    EXPECT_EQ(image.height, 12);
    EXPECT_EQ(image.id_planes.at("objectId")[6 * 20 + 10], 1u);
    EXPECT_EQ(image.id_planes.at("objectId")[0], 0u);
    EXPECT_GT(image.planes.at("R")[6 * 20 + 10], image.planes.at("B")[6 * 20 + 10]);
    EXPECT_EQ(image.attributes.at("scene"), "scene.json");
    EXPECT_EQ(read_png(folder / "out.png").width, 20);
}

TEST_F(CliRenderTest, AFileHasTheChannelsThatAreAskedFor) {
    ASSERT_EQ(run("render scene.json -o all.exr --stats-json all.json").exit_code, 0);
    ASSERT_EQ(run("render scene.json -o z.exr --channels Z,N --stats-json z.json").exit_code, 0);
    ASSERT_EQ(run("render scene.json -o zp.exr -o zp.png --channels Z,N").exit_code, 0);
    ASSERT_EQ(run("render scene.json -o all.png").exit_code, 0);
    const Image all = read_exr(folder / "all.exr");
    for (const char* name : {"z.exr", "zp.exr"}) {
        const Image some = read_exr(folder / name);
        EXPECT_EQ(some.planes.size(), 4u) << name;
        EXPECT_TRUE(some.id_planes.empty()) << name;
        for (const auto& [channel, plane] : some.planes)
            EXPECT_EQ(plane, all.planes.at(channel)) << name << " " << channel;
    }
    EXPECT_EQ(bytes_of(folder / "zp.png"), bytes_of(folder / "all.png"));
    const Json full = Json::parse(bytes_of(folder / "all.json"));
    const Json unlit = Json::parse(bytes_of(folder / "z.json"));
    EXPECT_TRUE(full["launches"].contains("trace_shadows"));
    EXPECT_FALSE(unlit["launches"].contains("trace_shadows"));
    EXPECT_EQ(unlit["shadow_rays"], 0);
    EXPECT_EQ(unlit["allocated_bytes"]["image"], 4 * 20 * 12 * 4);
    EXPECT_THAT(expect_failure(2, "render scene.json -o a.exr --channels Z,Q"),
                HasSubstr("\"Q\" is none of"));
}

TEST_F(CliRenderTest, AVolumeAlongsideAFileWithoutColorIsPlannedAndMadeWithAllItNeeds) {
    const std::string both = "render scene.json -o z.exr --volume v.nrrd --channels ";
    EXPECT_EQ(run(both + "Z --dry-run").out, run(both + "RGBA,Z --dry-run").out);
    EXPECT_EQ(run("render scene.json --dry-run").out, run("check scene.json").out);
    ASSERT_EQ(run(both + "Z").exit_code, 0);
    ASSERT_EQ(run("render scene.json --volume alone.nrrd").exit_code, 0);
    EXPECT_EQ(bytes_of(folder / "v.nrrd"), bytes_of(folder / "alone.nrrd"));
    EXPECT_EQ(read_exr(folder / "z.exr").planes.size(), 1u);
}

TEST_F(CliRenderTest, OptionsComeInAnyOrder) {
    const std::vector<std::string> lines = {
        "render scene.json -o out.exr --size 8x6 -q", "render -q --size 8x6 -o out.exr scene.json",
        "render --size=8x6 scene.json -q --output out.exr",
        "render -o out.exr scene.json --assets . --size 8x6 --quiet"};
    for (const std::string& line : lines) {
        const ProgramResult result = run(line);
        EXPECT_EQ(result.exit_code, 0) << line << "\n" << result.err;
        EXPECT_EQ(read_exr(folder / "out.exr").width, 8) << line;
        std::filesystem::remove(folder / "out.exr");
    }
}

TEST_F(CliRenderTest, EndingsAndSizesMayHaveCapitals) {
    ASSERT_EQ(run("render scene.json --size 10X6 -o A.PNG -o B.Exr --volume C.NRRD").exit_code, 0);
    ASSERT_EQ(run("render scene.json --size 10x6 -o a.png -o b.exr --volume c.nrrd").exit_code, 0);
    EXPECT_EQ(bytes_of(folder / "A.PNG"), bytes_of(folder / "a.png"));
    EXPECT_EQ(bytes_of(folder / "B.Exr"), bytes_of(folder / "b.exr"));
    EXPECT_EQ(bytes_of(folder / "C.NRRD"), bytes_of(folder / "c.nrrd"));
    for (const char* size : {"10y6", "10x", "10x6x", "x6"})
        expect_failure(2, fmt::format("render scene.json --size {} -o a.png", size));
}

TEST_F(CliRenderTest, TheLastLineHasTheSizeOfWhatWasMade) {
    EXPECT_THAT(run("render scene.json -o a.png").err, StartsWith("20x12 in "));
    EXPECT_THAT(run("render scene.json --volume a.nrrd").err, StartsWith("16x12x9 voxels in "));
    EXPECT_THAT(run("render scene.json -o a.png --volume a.nrrd").err,
                StartsWith("20x12 and 16x12x9 voxels in "));
}

TEST_F(CliRenderTest, WhatASceneLeavesOutIsFoundAndToldByCheck) {
    put_bytes(folder / "m.obj", kTetrahedron);
    put_bytes(folder / "scene.json", R"({
  "voxelume": 1, "render": {"size": [64, 48]},
  "models": {"thing": {"mesh": "m.obj", "fit": 2, "surface": "smooth"}}, "objects": [{"model": "thing"}]
})");
    const ProgramResult check = run("check scene.json");
    EXPECT_EQ(check.exit_code, 0) << check.err;
    EXPECT_THAT(check.out, HasSubstr("model \"thing\": m.obj scaled by 2, smooth"));
    EXPECT_THAT(check.out, HasSubstr("The scene has no \"lights\", so one shines from the "
                                     "observer's upper left.\n"));
    EXPECT_THAT(check.out,
                HasSubstr("To keep it, copy:\n  \"world\": {\"voxel_size\": 0.007813, "));
    const Json fitted = Json::parse(run("check --json scene.json").out)["fitted"];
    EXPECT_EQ(fitted["world"]["bounds"]["min"][0], -1.031316);
    EXPECT_EQ(fitted["lights"].size(), 1u);
    const ProgramResult render = run("render scene.json -o fitted.exr");
    ASSERT_EQ(render.exit_code, 0) << render.err;
    EXPECT_THAT(render.err,
                StartsWith("note: scene.json: has no \"lights\", so one shines from the observer's "
                           "upper left; \"lights\": [] is dark\n"));
    EXPECT_EQ(run("render scene.json -q -o fitted.exr").err, "");
    Json copied = Json::parse(bytes_of(folder / "scene.json"));
    copied.update(fitted);
    put_bytes(folder / "scene.json", copied.dump());
    const ProgramResult of_copy = run("render scene.json -o copied.exr");
    EXPECT_EQ(of_copy.exit_code, 0) << of_copy.err;
    EXPECT_THAT(of_copy.err, testing::Not(HasSubstr("note:")));
    EXPECT_EQ(read_exr(folder / "fitted.exr").planes, read_exr(folder / "copied.exr").planes);
    EXPECT_FALSE(Json::parse(run("check --json scene.json").out).contains("fitted"));
}

TEST_F(CliRenderTest, AMeshThatASceneIsFittedToIsReadOnce) {
    put_bytes(folder / "m.obj", kTetrahedron);
    put_bytes(folder / "scene.json", R"({"voxelume": 1, "render": {"size": [16, 12]},
        "models": {"thing": {"mesh": "m.obj", "unit": "cm", "surface": "smooth"}}, "objects": [{"model": "thing"}]})");
    for (const char* option : {"", " --no-cache"}) {
        ASSERT_EQ(
            run(fmt::format("render scene.json -o a.png --stats-json s.json{}", option)).exit_code,
            0);
        EXPECT_EQ(Json::parse(bytes_of(folder / "s.json"))["triangles"], 4);
    }
}

TEST_F(CliRenderTest, TwoOutputsOfOneNameAreRefused) {
    for (const char* outputs :
         {"-o a.exr -o a.exr", "-o a.exr -o ./a.exr", "-o a.exr --volume a.exr",
          "-o a.png --stats-json a.png", "--frames 1-2 -o f.#.png -o f.#.png"})
        EXPECT_THAT(expect_failure(2, std::string("render scene.json ") + outputs),
                    HasSubstr("two outputs are one file; give each a name of its own"));
}

TEST_F(CliRenderTest, QuietSaysNothingAndAPipeGetsNoControlCharacters) {
    EXPECT_THAT(run("render scene.json -o out.exr -q").err, IsEmpty());
    for (const char c : run("render scene.json -o out.exr -v").err)
        EXPECT_TRUE(c == '\n' || (c >= 0x20 && c != 0x7f)) << int(c);
}

TEST_F(CliRenderTest, ADeviceIsChosenByOptionThenByEnvironment) {
    EXPECT_EQ(run("render scene.json -o out.exr --device cpu").exit_code, 0);
    EXPECT_THAT(expect_failure(6, "render scene.json -o new.exr --device quantum"),
                HasSubstr("\"quantum\""));
    setenv("VOXELUME_DEVICE", "steam", 1);
    EXPECT_THAT(expect_failure(6, "render scene.json -o new.exr"), HasSubstr("\"steam\""));
    EXPECT_EQ(run("render scene.json -o out.exr --device cpu").exit_code, 0);
    unsetenv("VOXELUME_DEVICE");
}

TEST_F(CliRenderTest, AssetsAreFoundNextToTheSceneByOptionAndByEnvironment) {
    std::filesystem::create_directory(folder / "models");
    write_mesh_scene("models/tetrahedron.obj", kTetrahedron);
    write_scene([](Json& scene) {
        scene["models"]["thing"] = {{"mesh", "tetrahedron.obj"}, {"surface", "cubes"}};
    });
    EXPECT_THAT(expect_render_failure(4), HasSubstr("there is no file \"tetrahedron.obj\""));
    EXPECT_EQ(run("render scene.json -o out.exr --assets models").exit_code, 0);
    setenv("VOXELUME_ASSETS", (folder / "models").c_str(), 1);
    EXPECT_EQ(run("render scene.json -o out.exr").exit_code, 0);
    unsetenv("VOXELUME_ASSETS");
}

TEST_F(CliRenderTest, StatisticsCountRaysAndTimeStagesAndKernels) {
    ASSERT_EQ(run("render scene.json -o out.exr --stats-json stats.json").exit_code, 0);
    const Json stats = Json::parse(bytes_of(folder / "stats.json"));
    EXPECT_EQ(stats["sight_rays"], 240);
    EXPECT_GT(stats["shadow_rays"], 0);
    EXPECT_LE(stats["shadow_rays"], 240);
    EXPECT_GT(stats["world_bytes"], 0);
    EXPECT_GE(stats["peak_device_bytes"], stats["world_bytes"]);
    for (const char* stage :
         {"open", "load", "voxelize", "place", "index", "image", "write", "total"})
        EXPECT_TRUE(stats["seconds"].contains(stage)) << stage;
    EXPECT_GT(stats["kernel_ms"]["trace_closest"], 0);
}

TEST_F(CliRenderTest, ShadowRaysAreCountedOverAllBatchesAndLights) {
    write_scene([](Json& scene) {
        scene["lights"].push_back(scene["lights"][0]);
        scene["lights"][1]["name"] = "moon";
        scene["render"]["samples"] = 4;
    });
    const Setting batch("VOXELUME_BATCH", "131072");
    // The image takes two batches; without shadows it takes no shadow rays.
    ASSERT_EQ(run("render scene.json -o a.exr --size 512x128 --stats-json two.json").exit_code, 0);
    write_scene([](Json& scene) { scene["render"]["samples"] = 4; });
    ASSERT_EQ(run("render scene.json -o a.exr --size 512x128 --stats-json one.json").exit_code, 0);
    const Json two = Json::parse(bytes_of(folder / "two.json"));
    const Json one = Json::parse(bytes_of(folder / "one.json"));
    EXPECT_EQ(one["launches"]["trace_closest"], 2);
    EXPECT_GT(one["shadow_rays"], 0);
    EXPECT_EQ(two["shadow_rays"].get<int>(), 2 * one["shadow_rays"].get<int>());
}

TEST_F(CliRenderTest, FramesGetFilesOfTheirOwn) {
    EXPECT_EQ(run("render scene.json --frames 1-5x2 -o frame.###.png -o still.exr").exit_code, 0);
    EXPECT_THAT(names(), testing::ElementsAre("frame.001.png", "frame.003.png", "frame.005.png",
                                              "scene.json", "still0001.exr", "still0003.exr",
                                              "still0005.exr"));
    EXPECT_EQ(bytes_of(folder / "frame.001.png"), bytes_of(folder / "frame.005.png"));
    EXPECT_THAT(expect_failure(2, "render scene.json --frames 5-1 -o a.exr"), HasSubstr("1-5"));
}

TEST_F(CliRenderTest, CheckAndADryRunSayThePlanAndWriteNothing) {
    const std::vector<std::string> before = names();
    for (const char* line : {"check scene.json", "render scene.json --dry-run -o out.exr"}) {
        const ProgramResult result = run(line);
        EXPECT_EQ(result.exit_code, 0) << result.err;
        EXPECT_THAT(result.out, StartsWith("world: 30x20x10 voxels"));
        EXPECT_THAT(result.out, HasSubstr("model thing"));
        EXPECT_THAT(result.out, HasSubstr("\nfits: "));
    }
    EXPECT_EQ(names(), before);
    const Json plan = Json::parse(run("check --json scene.json").out);
    EXPECT_EQ(plan["grids"][0]["grid"], "model thing");
    EXPECT_EQ(plan["grids"].back()["voxels"], "30x20x10");
    ASSERT_EQ(plan["stages"].size(), 5u);
    EXPECT_EQ(plan["stages"][3]["stage"], "image");
    EXPECT_EQ(plan["stages"][4]["stage"], "volume");
    EXPECT_GT(plan["stages"][4]["MB"], 0);
}

TEST_F(CliRenderTest, TheVerdictIsOfWhatIsRendered) {
    write_scene([](Json& scene) { scene["observer"]["display"]["voxels"] = {64, 48, 36}; });
    const Json plan = Json::parse(run("check --json scene.json").out);
    const auto is_said = [&](size_t stage) {
        const auto kilobytes = plan["stages"][stage]["MB"].get<double>() * 1e3;
        return HasSubstr(fmt::format("at most {}.", int(kilobytes)));
    };
    const std::string volume = run("render scene.json --dry-run --volume v.nrrd").out;
    EXPECT_THAT(volume, is_said(4));
    EXPECT_THAT(volume, Not(HasSubstr("volumetric")));
    EXPECT_THAT(run("check scene.json").out, is_said(3));
    EXPECT_THAT(run("check scene.json").out,
                HasSubstr("a volumetric image of its display needs at most"));
}

TEST_F(CliRenderTest, AMeshBecomesAModelAndAVolumeAtOnce) {
    put_bytes(folder / "t.obj", kTetrahedron);
    const ProgramResult result = run("voxelize -o t.vxm t.obj --resolution 40 -o t.vdb");
    ASSERT_EQ(result.exit_code, 0) << result.err;
    EXPECT_THAT(result.err, StartsWith("4 triangles to 48x36x28 voxels of 0.025 m in "));
    EXPECT_THAT(run("info t.vxm").out, HasSubstr("surface         smooth\n"));
    const std::vector<VdbSummary> grids = read_vdb_summary(folder / "t.vdb").grids;
    ASSERT_EQ(grids.size(), 1u);
    EXPECT_EQ(grids[0].name, "surface");
    EXPECT_EQ(grids[0].grid_class, "level set");
    EXPECT_NEAR(grids[0].voxel_edges.x, 0.025, 1e-9);
}

TEST_F(CliRenderTest, SolidCubesFillTheirVolume) {
    put_bytes(folder / "t.obj", kTetrahedron);
    ASSERT_EQ(
        run("voxelize t.obj -o t.vdb --voxel-size 0.01 --surface cubes --set solid -q").exit_code,
        0);
    const std::vector<VdbSummary> grids = read_vdb_summary(folder / "t.vdb").grids;
    ASSERT_EQ(grids.size(), 1u);
    EXPECT_EQ(grids[0].name, "density");
    const double volume = 1 * 0.7 * 0.5 / 6 / 1e-6;  // voxels
    EXPECT_NEAR(double(grids[0].active_voxels), volume, 0.02 * volume);
}

TEST_F(CliRenderTest, InfoSaysWhetherAMeshIsClosedAndHowManyVoxelsItBecomes) {
    put_bytes(folder / "t.obj", kTetrahedron);
    const Json closed = Json::parse(run("info t.obj --json").out);
    EXPECT_EQ(closed["closed"], true);
    EXPECT_EQ(closed["as voxels"][1]["resolution"], 256);
    EXPECT_EQ(closed["as voxels"][1]["voxels"], "256x180x128");
    put_bytes(folder / "open.obj", kTriangle);
    EXPECT_EQ(Json::parse(run("info open.obj --json").out)["open edges"], 3);
}

}  // namespace voxelume
