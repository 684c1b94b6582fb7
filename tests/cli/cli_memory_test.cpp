// SPDX-License-Identifier: Apache-2.0
// The memory that a scene takes is reported, and refused where it is too much.
#include <gmock/gmock.h>

#include "tests/cli/scene_program.hpp"

namespace voxelume {
namespace {

using testing::HasSubstr;

class CliMemoryTest : public SceneProgramTest {};

TEST_F(CliMemoryTest, CheckTellsProgramsWhetherTheSceneFits) {
    write_scene([](Json& scene) {
        const Json ball = {{"shape", "sphere"}, {"radius", 0.45}};
        scene["models"]["thing"] = {{"shape", "intersection"}, {"parts", {ball, ball}}};
        scene["world"]["voxel_size"] = 0.016;
    });
    const auto plan = [&](const char* option, int code) {
        const ProgramResult result = run(fmt::format("check scene.json --json {}", option));
        EXPECT_EQ(result.exit_code, code) << result.err;
        return Json::parse(result.out);
    };
    const Json fits = plan("", 0);
    EXPECT_EQ(fits["verdict"], "fits");
    EXPECT_LE(fits["most MB"], fits["device MB"]);
    setenv("VOXELUME_MEMORY_MB", "1", 1);
    const Json may = plan("", 0), not_at_all = plan("--size 800x600", 8);
    unsetenv("VOXELUME_MEMORY_MB");
    EXPECT_EQ(may["verdict"], "may fit");
    EXPECT_EQ(may["device MB"], 1.05);
    EXPECT_LT(may["least MB"], 1.05);
    EXPECT_GT(may["most MB"], 1.05);
    EXPECT_EQ(not_at_all["verdict"], "doesn't fit");
    EXPECT_GT(not_at_all["least MB"], 1.05);
}

TEST_F(CliMemoryTest, AMemoryLimitRefusesWhatNeedsMoreBeforeItIsTaken) {
    put_bytes(folder / "scene.json",
              R"({"voxelume": 1, "models": {"m": {"shape": "sphere", "radius": 0.3,
"surface": "cubes"}},
"world": {"resolution": 16}, "objects": [{"model": "m"}], "render": {"size": [32, 24]}})");
    const ProgramResult fits = run("render scene.json -q -o a.png --memory-limit 1GiB");
    EXPECT_EQ(fits.exit_code, 0) << fits.err;
    EXPECT_TRUE(std::filesystem::exists(folder / "a.png"));
    for (const char* command : {"render scene.json -q -o b.png --memory-limit 200MB",
                                "check scene.json -q --memory-limit 0.2G"}) {
        const ProgramResult refused = run(command);
        EXPECT_EQ(refused.exit_code, 8) << command << refused.err;
        EXPECT_THAT(refused.err + refused.out,
                    HasSubstr("take 300 MB of main memory, of which this process may take 200 MB"))
            << command;
    }
    const ProgramResult fine =
        run("render scene.json -q -o b.png --memory-limit 500MB --set world.resolution=4000");
    EXPECT_EQ(fine.exit_code, 8) << fine.err;
    EXPECT_THAT(fine.err, HasSubstr(": use voxels larger than "));
    EXPECT_FALSE(std::filesystem::exists(folder / "b.png"));
    for (const char* size :
         {"12", "GB", "-1GB", "1e300GB", "nanGB", "1 GB", "0MB", "0.0000001MB", "1XB"}) {
        const ProgramResult wrong = run(fmt::format("check scene.json --memory-limit '{}'", size));
        EXPECT_EQ(wrong.exit_code, 2) << size;
        EXPECT_THAT(wrong.err, HasSubstr("give a size like 500MB or 2.5GB")) << size;
    }
}

}  // namespace
}  // namespace voxelume
