// SPDX-License-Identifier: Apache-2.0
// Bad input to the program gives the right exit code, one clear line, and leaves no file behind.
#include <gmock/gmock.h>

#include "tests/cli/scene_program.hpp"

namespace voxelume {

using testing::AllOf;
using testing::HasSubstr;
using testing::MatchesRegex;
using testing::Not;

class CliBadInputTest : public SceneProgramTest {};

TEST_F(CliBadInputTest, DamagedMeshesAreInputErrors) {
    write_mesh_scene("empty.obj", "");
    EXPECT_THAT(expect_render_failure(4), HasSubstr("empty.obj: the file is empty"));
    write_mesh_scene("bare.obj", "vn 0 0 1\n");
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

TEST_F(CliBadInputTest, FilesThatNothingReadsAreNamedByTheirEnding) {
    for (const char* ending : {"npz", "dcm", "fbx", "xyz"})
        for (const std::string& bytes :
             {std::string("PK\3\4 {}"), std::string("0 0 0\n"), std::string()}) {
            const std::string file = std::string("a.") + ending;
            put_bytes(folder / file, bytes);
            for (const char* command : {"render", "check"}) {
                const std::string line = std::string(command) + " " + file +
                                         (command == std::string("render") ? " -o o.png" : "");
                EXPECT_THAT(expect_failure(4, line),
                            AllOf(HasSubstr(file + ": files that end in ." + ending +
                                            " aren't read: scenes end in .json, and models in "
                                            ".obj .ply .stl"),
                                  HasSubstr(" .npy"), Not(HasSubstr("JSON"))));
            }
        }
    // A scene may have any name.
    std::filesystem::rename(folder / "scene.json", folder / "scene.txt");
    EXPECT_EQ(run("check scene.txt").exit_code, 0);
    put_bytes(folder / "scene.txt", "{\"voxelume\": 1,,}");
    EXPECT_THAT(expect_failure(3, "check scene.txt"), HasSubstr("this is not JSON"));
}

/// The library of JSON calls itself for each level, and 110,000 levels exhausted the stack.
TEST_F(CliBadInputTest, DeepJsonIsRefusedByEveryCommand) {
    const std::string deep = std::string(300'000, '[') + std::string(300'000, ']');
    const std::string member = "{\"zz\":" + deep + ",";
    const auto deepened = [&](const std::string& name) {
        std::string bytes = bytes_of(folder / name);
        const size_t frame = bytes.find("voxelume_frame:={");
        const size_t brace = frame == std::string::npos ? bytes.find('{') : bytes.find('{', frame);
        put_bytes(folder / name, bytes.replace(brace, 1, member));
    };
    ASSERT_EQ(run("render scene.json -q --volume v.nrrd --volume w.raw").exit_code, 0);
    ASSERT_EQ(run("render scene.json -q -o p.exr --shard 1/1").exit_code, 0);
    for (const char* name : {"v.nrrd", "w.json", "p.exr.1-of-1.shard"}) deepened(name);
    for (const char* name : {"v.nrrd", "w.raw"}) {
        expect_failure(4, std::string("info ") + name);
        expect_failure(4, std::string("convert ") + name + " o.nrrd");
        expect_failure(4, std::string("view ") + name + " -o o.png");
    }
    expect_failure(4, "merge p.exr.1-of-1.shard");
    expect_failure(5, "render scene.json --volume w.raw");
    put_bytes(folder / "a.gltf", member + "\"asset\":{\"version\":\"2.0\"}}");
    EXPECT_THAT(expect_failure(8, "check a.gltf"), HasSubstr("more than 64 levels"));
    put_bytes(folder / "peers.json", member + "\"size\":[4,4],\"rows\":[]}");
    expect_failure(4, "bench -q --peers peers.json");
    put_bytes(folder / "scene.json", member + "\"voxelume\":1}");
    EXPECT_THAT(expect_failure(3, "info scene.json"), HasSubstr("more than 64 levels"));
}

TEST_F(CliBadInputTest, WrongScenesNamePlaceAndNearestName) {
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

TEST_F(CliBadInputTest, WorldsBeyondMemoryAreRefusedBeforeItIsTaken) {
    const auto world_of = [&](int voxels) {
        write_scene([&](Json& scene) {
            scene["world"]["bounds"] = {{"min", {0, 0, 0}}, {"max", {1, 1, 1}}};
            scene["world"]["voxel_size"] = 1.0 / voxels;
            scene["models"]["thing"] = {
                {"shape", "sphere"}, {"radius", 0.49}, {"surface", "smooth"}};
            scene["objects"][0]["position"] = {0.5, 0.5, 0.5};
        });
    };
    world_of(65536);  // the table of bricks alone exceeds the memory
    EXPECT_THAT(expect_render_failure(8), HasSubstr("use voxels larger than"));
    world_of(65537);  // the scene's limit is exceeded
    EXPECT_THAT(expect_render_failure(8), HasSubstr("65536"));
    world_of(15000);  // the surface exceeds the memory
    EXPECT_THAT(expect_render_failure(8), HasSubstr("use voxels larger than"));
    EXPECT_EQ(run("check scene.json").exit_code, 8);
    world_of(400);
    EXPECT_EQ(run("check scene.json").exit_code, 0);
    setenv("VOXELUME_BUFFER_MB", "16", 1);
    EXPECT_THAT(expect_render_failure(8),
                AllOf(HasSubstr(" for its distances, and \""),
                      HasSubstr(" allows 16.8 MB in one piece: use voxels larger than 0.00")));
    const ProgramResult check = run("check scene.json");
    EXPECT_EQ(check.exit_code, 8);
    EXPECT_THAT(check.out, Not(HasSubstr("fits")));
    EXPECT_THAT(check.err, HasSubstr(" for its distances, and \""));
    EXPECT_EQ(Json::parse(run("check scene.json --json").out)["verdict"], "doesn't fit");
    unsetenv("VOXELUME_BUFFER_MB");
    world_of(100);
    EXPECT_THAT(expect_failure(8, "render scene.json --size 65536x65536 --time 5 -o out.exr"),
                HasSubstr("render a smaller one"));
}

TEST_F(CliBadInputTest, ModelsWithMoreVoxelsThanCanBeNumberedAreRefused) {
    write_mesh_scene("long.obj", "v 0 0 0\nv 1e30 0 0\nv 0 1 0\nf 1 2 3\n");
    EXPECT_THAT(
        expect_render_failure(8),
        HasSubstr("models.thing: the mesh is 1e+30 m long: if that is wrong, give its model "
                  "another \"unit\"; if not, use voxels of at least "));
}

TEST_F(CliBadInputTest, ExactMeshesThatAreFarTooLargeAreRefusedWithTheirUnit) {
    write_mesh_scene("long.obj", "v 0 0 0\nv 1e6 0 0\nv 0 1e6 0\nf 1 2 3\n");
    Json scene = Json::parse(bytes_of(folder / "scene.json"));
    scene["models"]["thing"]["surface"] = "exact";
    put_bytes(folder / "scene.json", scene.dump(1));
    EXPECT_THAT(expect_render_failure(8),
                HasSubstr("more than 16384: if that is wrong, give its model another \"unit\""));
}

TEST_F(CliBadInputTest, OutputsThatCantBeWrittenAreSaidBeforeTheWork) {
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

TEST_F(CliBadInputTest, WrongOptionsAreUsageErrors) {
    EXPECT_THAT(expect_failure(2, "render scene.json -o out.exr --asets x"),
                HasSubstr("did you mean \"--assets\"?"));
    for (const char* options :
         {"--size 3", "--size 0x4", "--size 9x9x9", "--samples 0", "--samples many",
          "--exposure bright", "more.json", "--frames 1-", "-o", "--stats-json out.exr"})
        expect_failure(2, fmt::format("render scene.json -o out.exr {}", options));
    put_bytes(folder / "triangle.obj", kTriangle);
    for (const char* options :
         {"", "-o a.obj", "-o a.vdb --voxel-size -1", "-o a.vdb --surface blocks",
          "-o a.vdb --resolution 9 --voxel-size 1", "-o a.vdb --set solid"})
        expect_failure(2, fmt::format("voxelize triangle.obj {}", options));
    EXPECT_THAT(expect_failure(2, "voxelize triangle.obj -o a.vdb --surface cube"),
                HasSubstr("did you mean \"cubes\"?"));
}

TEST_F(CliBadInputTest, AFileNameCantSteerTheTerminal) {
    const std::string error =
        expect_failure(4, "render \"$(printf 'a\\033[2J\\nb').json\" -o o.exr");
    EXPECT_THAT(error, HasSubstr("a?[2J?b.json"));
}

}  // namespace voxelume
