// SPDX-License-Identifier: Apache-2.0
// The memory that a scene takes is reported, and refused where it is too much.
#include <gmock/gmock.h>
#include <spawn.h>
#include <sys/resource.h>

#include <cstring>
#include <sstream>

#include "runtime/base/sanitizers.hpp"
#include "tests/cli/scene_program.hpp"
#include "tests/support/exhaustive.hpp"

namespace voxelume {
namespace {

using testing::HasSubstr;

extern "C" char** environ;

class CliMemoryTest : public SceneProgramTest {
  protected:
    /// The largest part of main memory that the program had at one time, in bytes.
    static double peak_of(const std::string& arguments) {
        const std::string line = fmt::format("exec '{}' {}", VXL_BINARY, arguments);
        const char* const words[] = {"sh", "-c", line.c_str(), nullptr};
        pid_t child = 0;
        EXPECT_EQ(posix_spawnp(&child, "sh", nullptr, nullptr, const_cast<char**>(words), environ),
                  0);
        int status = -1;
        rusage used{};
        EXPECT_EQ(wait4(child, &status, 0, &used), child);
        EXPECT_EQ(status, 0) << line;
        return 1024.0 * double(used.ru_maxrss);
    }

    /// Renders the scene as its options say, and holds the process against what the plan of such a
    /// run promises.
    void expect_promise_of_run_holds(const std::string& scene, const std::string& options) const {
        const std::string line =
            fmt::format("render -q --no-cache --overwrite always -o '{}' '{}'{}",
                        (folder / "a.exr").string(), scene, options);
        const ProgramResult planned = run(line + " --dry-run");
        ASSERT_EQ(planned.exit_code, 0) << planned.err;
        const size_t row = planned.out.find("whole process");
        ASSERT_NE(row, std::string::npos) << planned.out;
        std::istringstream words(planned.out.substr(row + std::strlen("whole process")));
        double promised = 0;
        std::string unit;
        words >> promised >> unit;
        promised *= unit == "GB" ? 1e9 : 1e6;
        const double peak = peak_of(line);
        EXPECT_LE(peak, promised);
        EXPECT_GE(peak, promised / 4);
        fmt::print("{}: {:.0f} of {:.0f} MB\n", scene, peak / 1e6, promised / 1e6);
    }

    /// Renders the scene as its options say, and holds the process against what `check` promises.
    void expect_promise_holds(const std::string& scene, const std::string& options) const {
        SCOPED_TRACE(scene + options);
        const std::string shown =
            fmt::format("'{}' --assets /usr/share/glmark2/models{}", scene, options);
        const ProgramResult planned = run("check -q --json " + shown);
        ASSERT_EQ(planned.exit_code, 0) << planned.err;
        const double promised = 1e6 * Json::parse(planned.out)["process MB"].get<double>();
        const double peak =
            peak_of(fmt::format("render -q --no-cache --frames 1 --overwrite always -o '{}' {}",
                                (folder / "a.exr").string(), shown));
        EXPECT_LE(peak, promised);
        fmt::print("{}{}: {:.0f} of {:.0f} MB\n", scene, options, peak / 1e6, promised / 1e6);
    }
};

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

/// Where no kernels are kept, the process compiles them, too.
TEST_F(CliMemoryTest, ProcessesTakeNoMoreThanCheckPromises) {
    if (kHasSanitizer) GTEST_SKIP() << "a sanitizer takes memory of its own";
    const std::filesystem::path scenes = VXL_SOURCE_DIR "/scenes";
    expect_promise_holds(scenes / "cubes.json", "");
    expect_promise_holds(scenes / "whitted.json", " --size 1600x1200");
    expect_promise_of_run_holds(scenes / "cubes.json",
                                " --size 1600x1200 --channels RGBA,Z,distance,P,N,objectId,"
                                "materialId,CryptoObject,CryptoMaterial,albedo,direct,indirect,"
                                "shadow,lights,samples");
    if (!is_exhaustive()) return;
    int tried = 2;
    for (const auto& entry : std::filesystem::directory_iterator(scenes)) {
        const std::filesystem::path scene = entry.path();
        if (scene.extension() != ".json" || scene.stem() == "voxelume.schema") continue;
        for (const char* options : {" --samples 2", " --size 1600x1200 --samples 1"}) {
            expect_promise_holds(scene, options);
            ++tried;
        }
    }
    EXPECT_GE(tried, 40);
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
