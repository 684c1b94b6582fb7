// SPDX-License-Identifier: Apache-2.0
// Images of a shutter that stays open, by the program.
#include <gmock/gmock.h>

#include "runtime/io/image/exr.hpp"
#include "tests/cli/scene_program.hpp"

namespace voxelume {
namespace {

using testing::HasSubstr;

class CliShutterTest : public SceneProgramTest {
  protected:
    void SetUp() override {
        SceneProgramTest::SetUp();
        open_shutter([](Json&) {});
    }

    /// Writes a scene whose box turns and flies while a shutter is open.
    template <class Change>
    void open_shutter(const Change& change) {
        write_scene([&](Json& scene) {
            scene["observer"]["shutter"] = 0.5;
            scene["lights"][0]["group"] = "key";
            scene["animation"] = Json::parse(R"({"frames": 3, "tracks": [
                {"target": "objects.thing.turn", "keys": [{"frame": 1, "value": [0, 0, 0]},
                                                          {"frame": 3, "value": [90, 40, 0]}]},
                {"target": "objects.thing.position",
                 "keys": [{"frame": 1, "value": [1, 1, 0.5]},
                          {"frame": 3, "value": [2, 1, 0.5]}]}]})");
            change(scene);
        });
    }

    /// Renders frame 2 by itself.
    void render(const std::string& options, int frame = 2) const {
        const ProgramResult result =
            run(fmt::format("render scene.json --frames {} --float -q {}", frame, options));
        ASSERT_EQ(result.exit_code, 0) << options << "\n" << result.err;
    }

    void expect_same_files(const std::string& a, const std::string& b) const {
        EXPECT_FALSE(bytes_of(folder / a).empty());
        EXPECT_TRUE(bytes_of(folder / a) == bytes_of(folder / b)) << a << " and " << b;
    }

    Json statistics(const std::string& options, int frame = 2) const {
        render(options + " --stats-json stats.json", frame);
        return Json::parse(bytes_of(folder / "stats.json"));
    }
};

TEST_F(CliShutterTest, GoesOnToTheBytesOfOneRun) {
    for (const char* options :
         {"--channels RGBA,Z,P,N,objectId,CryptoObject --crop 3,2,13,9",
          "--light global --channels RGBA,albedo,direct,indirect,shadow,lights,samples",
          "--channels P,Z,CryptoMaterial,lights --device all/2 --multi-part"}) {
        SCOPED_TRACE(options);
        const std::string line = std::string(options) + " ";
        render(line + "--samples 4 -o few.####.exr");
        render(line + "--samples 9 -o many.####.exr");
        render(line + "--samples 9 -o more.####.exr --continue few.####.exr");
        expect_same_files("many.0002.exr", "more.0002.exr");
    }
}

TEST_F(CliShutterTest, GoesOnByNoise) {
    const std::string line =
        "--light global --channels RGBA,samples,noise,variance,albedo,CryptoObject,Z ";
    render(line + "-o much.####.exr --samples 32 --noise 0.2");
    render(line + "-o little.####.exr --samples 64 --noise 0.05");
    render(line + "-o more.####.exr --samples 64 --noise 0.05 --continue much.####.exr");
    expect_same_files("little.0002.exr", "more.0002.exr");
}

/// Sums of 32 floats, or means of sums of halves, are each right within 31 half units of the last
/// bit, 1.9e-6.
TEST_F(CliShutterTest, TilesWithAllSamplesShowAllMoments) {
    const std::string line = "--light global --samples 32 --channels RGBA ";
    render(line + "-o plain.####.exr");
    render(line + "-o noise.####.exr --noise 0.0001");
    const Image plain = read_exr(folder / "plain.0002.exr");
    const Image noise = read_exr(folder / "noise.0002.exr");
    for (const char* plane : {"R", "G", "B", "A"})
        for (size_t i = 0; i < plain.planes.at(plane).size(); ++i) {
            const float value = plain.planes.at(plane)[i];
            ASSERT_NEAR(noise.planes.at(plane)[i], value, 4e-6f * value) << plane << i;
        }
}

TEST_F(CliShutterTest, StatisticsCountMoments) {
    EXPECT_EQ(statistics("--samples 6 -o image.####.exr")["frames"][0]["moments"], 6);
    EXPECT_EQ(statistics("--samples 6 -o image.####.exr", 3)["frames"][0]["moments"], 1);
    const Json one = statistics("--samples 1 -o image.####.exr");
    EXPECT_EQ(one["frames"][0]["moments"], 1);
    ASSERT_EQ(one["warnings"].size(), 1u);
    EXPECT_EQ(one["warnings"][0]["kind"], "one_moment");
    EXPECT_THAT(one["warnings"][0]["text"], HasSubstr("give \"render\" more \"samples\""));
}

TEST_F(CliShutterTest, AnImageIsMadeAgainWhereAFileOfAnyMomentChanged) {
    for (const char* name : {"m.1.obj", "m.2.obj"}) put_bytes(folder / name, kTetrahedron);
    open_shutter([](Json& scene) {
        scene["models"]["thing"] = {{"mesh", "m.#.obj"}, {"sequence", {{"first", 1}, {"last", 2}}}};
        scene["animation"]["tracks"] = Json::array();
        scene["observer"]["shutter"] = 2;
    });
    const std::string line = "--frames 1 --samples 4 -o a.####.exr --overwrite changed";
    const auto render = [&] {
        const ProgramResult result = run("render scene.json " + line);
        EXPECT_EQ(result.exit_code, 0) << result.err;
        return bytes_of(folder / "a.0001.exr");
    };
    const std::string before = render();
    EXPECT_TRUE(render() == before);
    put_bytes(folder / "m.2.obj",
              "v 0 0 0\nv 2 0 0\nv 0 2 0\nv 0 0 2\n"
              "f 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n");
    EXPECT_FALSE(render() == before);
}

TEST_F(CliShutterTest, RefusesWhatLooksAtOneMoment) {
    EXPECT_THAT(expect_failure(2,
                               "render scene.json --frames 2 --samples 4 -o a.####.exr "
                               "--channels RGBA,motion"),
                HasSubstr("leave the observer's shutter out"));
    open_shutter([](Json& scene) {
        scene["render"]["samples"] = 4;
        scene["render"]["adaptive"] = 0.1;
    });
    EXPECT_THAT(expect_failure(3, "render scene.json -o a.####.exr"),
                HasSubstr("render.adaptive: compares pixels at one moment"));
    open_shutter([](Json& scene) { scene["observer"]["shutter"] = 101; });
    EXPECT_THAT(expect_failure(3, "check scene.json"), HasSubstr("observer.shutter"));
}

}  // namespace
}  // namespace voxelume
