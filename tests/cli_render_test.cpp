// The commands render, check and voxelize: what they make of good input, and of bad.
#include <gmock/gmock.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "runtime/io/exr.hpp"
#include "runtime/io/png.hpp"
#include "runtime/io/vdb.hpp"
#include "tests/program_runner.hpp"

namespace voxelume {

using testing::HasSubstr;
using testing::IsEmpty;
using testing::MatchesRegex;
using testing::StartsWith;

namespace {

using Json = nlohmann::json;

constexpr const char* kScene = R"({
  "voxelume": 1,
  "world": {"voxel_size": 0.1, "bounds": {"min": [0, 0, 0], "max": [3, 2, 1]},
            "ambient": [0.3, 0.3, 0.3]},
  "materials": {"brick": {"color": [0.7, 0.3, 0.2]}},
  "models": {"thing": {"shape": "box", "size": [1.2, 0.8, 0.4], "surface": "cubes"}},
  "objects": [{"name": "thing", "model": "thing", "material": "brick", "position": [1.5, 1, 0.5]}],
  "lights": [{"name": "sun", "type": "directional", "direction": [0.2, -0.5, -1]}],
  "observer": {"position": [1.5, 1, 4], "look_at": [1.5, 1, 0.5],
               "display": {"shape": "pyramid", "angles": [45, 34], "near": 0.1, "far": 8,
                           "voxels": [16, 12, 9]}},
  "render": {"size": [20, 12]}
})";

constexpr const char* kTriangle = "v 0 0 0\nv 1 0 0\nv 0 0.7 0\nf 1 2 3\n";

constexpr const char* kTetrahedron =
    "v 0 0 0\nv 1 0 0\nv 0 0.7 0\nv 0 0 0.5\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n";

}  // namespace

class CliRenderTest : public ProgramTest {
  protected:
    void SetUp() override {
        ProgramTest::SetUp();
        ASSERT_FALSE(HasFatalFailure());
        write_scene([](Json&) {});
    }

    /// The good scene after a change, as scene.json.
    template <class Change>
    void write_scene(const Change& change) {
        Json scene = Json::parse(kScene);
        change(scene);
        put_bytes(folder / "scene.json", scene.dump(1));
    }

    void write_mesh_scene(const std::string& mesh, const std::string& bytes) {
        put_bytes(folder / mesh, bytes);
        write_scene([&](Json& scene) {
            scene["models"]["thing"] = {{"mesh", mesh}, {"surface", "cubes"}};
        });
    }

    /// Everything in the folder but what the runner itself puts there.
    std::vector<std::string> names() const {
        std::vector<std::string> found;
        for (const auto& entry : std::filesystem::directory_iterator(folder)) {
            const std::string name = entry.path().filename();
            if (name != "stdout.txt" && name != "stderr.txt") found.push_back(name);
        }
        std::ranges::sort(found);
        return found;
    }

    /// A failure is told in one line, with this code, and leaves no file behind.
    std::string expect_failure(int code, const std::string& arguments) const {
        const std::vector<std::string> before = names();
        const ProgramResult result = run(arguments);
        EXPECT_EQ(result.exit_code, code) << arguments << "\n" << result.err;
        EXPECT_THAT(result.err, MatchesRegex("voxelume: [^\n]+\n")) << arguments;
        EXPECT_THAT(result.out, IsEmpty()) << arguments;
        EXPECT_EQ(names(), before) << arguments;
        return result.err;
    }
    std::string expect_render_failure(int code) const {
        return expect_failure(code, "render scene.json -o out.exr -o out.png");
    }
};

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

TEST_F(CliRenderTest, AssetsAreFoundBesideTheSceneByOptionAndByEnvironment) {
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
    for (const char* stage : {"load", "voxelize", "place", "index", "image", "total"})
        EXPECT_TRUE(stats["seconds"].contains(stage)) << stage;
    EXPECT_GT(stats["kernel_ms"]["trace_closest"], 0);
}

TEST_F(CliRenderTest, ShadowRaysAreCountedOverAllBatchesAndLights) {
    write_scene([](Json& scene) {
        scene["lights"].push_back(scene["lights"][0]);
        scene["lights"][1]["name"] = "moon";
        scene["render"]["samples"] = 4;
    });
    // Two batches; without shadows none.
    ASSERT_EQ(run("render scene.json -o a.exr --size 512x256 --stats-json two.json").exit_code, 0);
    write_scene([](Json& scene) { scene["render"]["samples"] = 4; });
    ASSERT_EQ(run("render scene.json -o a.exr --size 512x256 --stats-json one.json").exit_code, 0);
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
    EXPECT_EQ(plan["stages"].size(), 4u);
}

TEST_F(CliRenderTest, DamagedMeshesAreInputErrors) {
    write_mesh_scene("empty.obj", "");
    EXPECT_THAT(expect_render_failure(4), HasSubstr("empty.obj: the file is empty"));
    write_mesh_scene("bare.obj", "v 0 0 0\n");
    EXPECT_THAT(expect_render_failure(4), HasSubstr("bare.obj"));
    write_mesh_scene("nan.obj", "v 0 0 0\nv nan 0 0\nv 0 1 0\nf 1 2 3\n");
    EXPECT_THAT(expect_render_failure(4), HasSubstr("nan.obj:2: "));
    write_mesh_scene("range.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 9\n");
    EXPECT_THAT(expect_render_failure(4), HasSubstr("range.obj:4: the face names vertex 9"));
    write_mesh_scene("cut.ply",
                     "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
                     "property float z\nelement face 1\nproperty list uchar int vertex_indices\n"
                     "end_header\n0 0 0\n1 0 0\n");
    EXPECT_THAT(expect_render_failure(4), HasSubstr("cut.ply"));
    write_mesh_scene("gone.obj", "");
    std::filesystem::remove(folder / "gone.obj");
    EXPECT_THAT(expect_render_failure(4), HasSubstr("there is no file \"gone.obj\""));
    EXPECT_THAT(expect_failure(4, "render gone.json -o out.exr"), HasSubstr("gone.json"));
}

TEST_F(CliRenderTest, WrongScenesNamePlaceAndNearestName) {
    write_scene([](Json& scene) { scene["world"]["voxel_size"] = -0.1; });
    EXPECT_THAT(expect_render_failure(3), HasSubstr("world.voxel_size: must be above 0"));
    write_scene([](Json& scene) { scene["world"]["voxelsize"] = 0.1; });
    EXPECT_THAT(expect_render_failure(3), HasSubstr("did you mean \"voxel_size\"?"));
    write_scene([](Json& scene) { scene["objects"][0]["material"] = "brik"; });
    const std::string error = expect_render_failure(3);
    EXPECT_THAT(error, MatchesRegex("voxelume: scene.json:[0-9]+:[0-9]+: objects.*\n"));
    EXPECT_THAT(error, HasSubstr("no material named \"brik\"; did you mean \"brick\"?"));
    put_bytes(folder / "scene.json", "{\"voxelume\": 1,,}");
    expect_render_failure(3);
}

TEST_F(CliRenderTest, WorldsBeyondMemoryAreRefusedBeforeItIsTaken) {
    const auto world_of = [&](int voxels) {
        write_scene([&](Json& scene) {
            scene["world"]["bounds"] = {{"min", {0, 0, 0}}, {"max", {1, 1, 1}}};
            scene["world"]["voxel_size"] = 1.0 / voxels;
            scene["models"]["thing"] = {{"shape", "sphere"}, {"radius", 0.49}};
            scene["objects"][0]["position"] = {0.5, 0.5, 0.5};
        });
    };
    world_of(65536);  // the table of bricks alone
    EXPECT_THAT(expect_render_failure(8), HasSubstr("use voxels larger than"));
    world_of(65537);  // the scene's limit
    EXPECT_THAT(expect_render_failure(8), HasSubstr("65536"));
    world_of(15000);  // the surface
    EXPECT_THAT(expect_render_failure(8), HasSubstr("use voxels larger than"));
    EXPECT_EQ(run("check scene.json").exit_code, 8);
    world_of(100);
    EXPECT_THAT(expect_failure(8, "render scene.json --size 65536x65536 -o out.exr"),
                HasSubstr("render a smaller one"));
}

TEST_F(CliRenderTest, ModelsWithMoreVoxelsThanCanBeNumberedAreRefused) {
    write_mesh_scene("long.obj", "v 0 0 0\nv 1e30 0 0\nv 0 1 0\nf 1 2 3\n");
    EXPECT_THAT(expect_render_failure(8), HasSubstr("models.thing: the mesh is 1e+30 m long"));
}

TEST_F(CliRenderTest, OutputsThatCantBeWrittenAreSaidBeforeTheWork) {
    put_bytes(folder / "broken.json", "{");  // it isn't even read
    EXPECT_THAT(expect_failure(5, "render broken.json -o nowhere/out.exr"),
                HasSubstr("there is no folder nowhere; create it first"));
    EXPECT_THAT(expect_failure(5, "render broken.json -o out.exr --stats-json nowhere/stats.json"),
                HasSubstr("nowhere"));
    expect_failure(5, "render broken.json -o scene.json/out.exr");
    if (std::filesystem::exists("/sys/kernel"))  // not even root makes files here
        expect_failure(5, "render broken.json -o /sys/kernel/out.exr");
    EXPECT_THAT(expect_failure(2, "render scene.json -o out.jpg"), HasSubstr(".exr or .png"));
    EXPECT_THAT(expect_failure(2, "render scene.json"), HasSubstr("-o image.exr"));
}

TEST_F(CliRenderTest, WrongOptionsAreUsageErrors) {
    EXPECT_THAT(expect_failure(2, "render scene.json -o out.exr --asets x"),
                HasSubstr("did you mean \"--assets\"?"));
    for (const char* options :
         {"--size 3", "--size 0x4", "--size 9x9x9", "--samples 0", "--samples many",
          "--exposure bright", "more.json", "--frames 1-", "-o"})
        expect_failure(2, fmt::format("render scene.json -o out.exr {}", options));
    put_bytes(folder / "triangle.obj", kTriangle);
    for (const char* options :
         {"", "-o a.obj", "-o a.vdb --voxel-size -1", "-o a.vdb --surface blocks",
          "-o a.vdb --resolution 9 --voxel-size 1", "-o a.vdb --set solid"})
        expect_failure(2, fmt::format("voxelize triangle.obj {}", options));
    EXPECT_THAT(expect_failure(2, "voxelize triangle.obj -o a.vdb --surface cube"),
                HasSubstr("did you mean \"cubes\"?"));
}

TEST_F(CliRenderTest, AFileNameCantSteerTheTerminal) {
    const std::string error =
        expect_failure(4, "render \"$(printf 'a\\033[2J\\nb').json\" -o o.exr");
    EXPECT_THAT(error, HasSubstr("a?[2J?b.json"));
}

TEST_F(CliRenderTest, AMeshBecomesAModelAndAVolumeAtOnce) {
    put_bytes(folder / "t.obj", kTetrahedron);
    const ProgramResult result = run("voxelize -o t.vxm t.obj --resolution 40 -o t.vdb");
    ASSERT_EQ(result.exit_code, 0) << result.err;
    EXPECT_THAT(result.err, StartsWith("4 triangles to 48x36x28 voxels of 0.025 m in "));
    EXPECT_THAT(run("info t.vxm").out, HasSubstr("surface         smooth\n"));
    const std::vector<VdbSummary> grids = read_vdb_summary(folder / "t.vdb");
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
    const std::vector<VdbSummary> grids = read_vdb_summary(folder / "t.vdb");
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
