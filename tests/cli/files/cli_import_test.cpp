// SPDX-License-Identifier: Apache-2.0
// Model files on the command line: render, check and import.
#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "runtime/import/scene_of_file.hpp"
#include "runtime/io/image/exr.hpp"
#include "runtime/io/image/png.hpp"
#include "tests/support/program_runner.hpp"
#include "tests/support/writers/vox_writer.hpp"

namespace voxelume {

using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

class CliImportTest : public ProgramTest {
  protected:
    void SetUp() override {
        ProgramTest::SetUp();
        put_bytes(folder / "wedge.obj",
                  "v 0 0 0\nv 3 0 0\nv 0 2 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\n"
                  "f 2 3 4\nf 3 1 4\n");
        put_bytes(
            folder / "scene.json",
            R"({"voxelume": 1, "models": {"m": {"shape": "sphere", "radius": 1, "surface": "smooth"}},
                      "objects": [{"model": "m"}]})");
    }
};

TEST_F(CliImportTest, AMeshRendersWithoutAScene) {
    const ProgramResult result =
        run("render wedge.obj -o a.exr --size 32x24 --samples 1 --view 10,20 --background 0,0.5,0");
    EXPECT_EQ(result.exit_code, 0) << result.err;
    const Image image = read_exr(folder / "a.exr");
    EXPECT_EQ(image.width, 32);
    EXPECT_EQ(image.height, 24);
    EXPECT_EQ(image.id_planes.at("objectId")[12 * 32 + 16], 1u);
    EXPECT_NEAR(image.planes.at("G")[0], 0.5f, 0.01f);
    EXPECT_EQ(image.planes.at("R")[0], 0.0f);
    EXPECT_EQ(run("check wedge.obj").exit_code, 0);
}

TEST_F(CliImportTest, ATransparentPictureKeepsItsAlpha) {
    const auto has_gaps = [&](const char* name) {
        const Picture picture = read_png(folder / name);
        EXPECT_EQ(picture.pixels[12 * 32 + 16][3], 255) << name;
        return picture.pixels[0] == std::array<uint8_t, 4>{0, 0, 0, 0};
    };
    const std::string size = " --size 32x24 --samples 1";
    ASSERT_EQ(run("render wedge.obj scene.json -o {name}.png --transparent" + size).exit_code, 0);
    EXPECT_TRUE(has_gaps("wedge.png"));
    EXPECT_TRUE(has_gaps("scene.png"));
    ASSERT_EQ(run("render wedge.obj -o opaque.png" + size).exit_code, 0);
    EXPECT_FALSE(has_gaps("opaque.png"));
    ASSERT_EQ(run("import wedge.obj --transparent -o wedge.json" + size.substr(0, 13)).exit_code,
              0);
    EXPECT_THAT(bytes_of(folder / "wedge.json"), Not(HasSubstr("\"ground\"")));
    for (const char* part : {"1/2", "2/2"})
        ASSERT_EQ(run("render wedge.json -o parts.png --samples 1 --shard " + std::string(part))
                      .exit_code,
                  0);
    ASSERT_EQ(run("merge parts.png.1-of-2.shard parts.png.2-of-2.shard").exit_code, 0);
    EXPECT_EQ(bytes_of(folder / "parts.png"), bytes_of(folder / "wedge.png"));
}

TEST_F(CliImportTest, ImportWritesWhatRenderShows) {
    ASSERT_EQ(run("render wedge.obj -o a.exr --size 32x24 --view iso").exit_code, 0);
    const ProgramResult result = run("import wedge.obj -o wedge.json --size 32x24 --view iso");
    EXPECT_EQ(result.exit_code, 0) << result.err;
    EXPECT_THAT(result.err, IsEmpty());
    ASSERT_EQ(run("render wedge.json -o b.exr").exit_code, 0);
    EXPECT_EQ(read_exr(folder / "a.exr").planes, read_exr(folder / "b.exr").planes);
    EXPECT_EQ(run("import wedge.obj --size 32x24 --view iso").out, bytes_of(folder / "wedge.json"));
    std::filesystem::create_directory(folder / "scenes");
    EXPECT_THAT(run("import wedge.obj -o scenes/wedge.json").err, HasSubstr("--assets"));
}

TEST_F(CliImportTest, HelpAndManualNameTheEndingsOfAllModelFiles) {
    const std::vector<std::string> endings = model_file_endings();
    for (const char* known : {".obj", ".glb", ".vox", ".npy", ".nii.gz", ".hdr", ".img", ".qb"})
        EXPECT_THAT(endings, testing::Contains(known));
    const std::string manual = bytes_of(VXL_SOURCE_DIR "/scenes/manual/model_files.md");
    for (const std::string& ending : endings) {
        EXPECT_TRUE(is_model_file("name" + ending)) << ending;
        for (const char* command : {"render", "check", "import", "info", "view"})
            EXPECT_THAT(run(std::string(command) + " --help").out, HasSubstr(ending)) << command;
        // The manual says once that pairs may end in ".gz", and that slices have numbers.
        const bool is_own = ending != ".hdr.gz" && ending != ".img.gz" && ending != "0001.png";
        if (is_own) {
            EXPECT_THAT(manual, HasSubstr("`" + ending + "`"));
        }
    }
}

TEST_F(CliImportTest, AModelFileIsViewedAsAVolumetricImage) {
    const ProgramResult result = run("view wedge.obj -o a.html -o a.png --size 200x160");
    EXPECT_EQ(result.exit_code, 0) << result.err;
    EXPECT_THAT(bytes_of(folder / "a.html"), HasSubstr("<html"));
    EXPECT_GT(bytes_of(folder / "a.png").size(), 1000u);
}

TEST_F(CliImportTest, InfoListsWhatAMagicaVoxelFileHolds) {
    const ProgramResult result = run("info --json '" VXL_SOURCE_DIR "/scenes/lighthouse.vox'");
    EXPECT_EQ(result.exit_code, 0) << result.err;
    const auto report = nlohmann::json::parse(result.out);
    EXPECT_EQ(report["kind"], "MagicaVoxel file");
    EXPECT_EQ(report["version"], 200);
    EXPECT_EQ(report["models"], 4);
    EXPECT_EQ(report["objects"], 11);
    EXPECT_EQ(report["layers"], 1);
    EXPECT_EQ(report["colors used"], 12);
    EXPECT_EQ(report["model list"][2]["size"], nlohmann::json({12, 3, 2}));
    EXPECT_EQ(report["model list"][2]["objects"], 8);
    EXPECT_EQ(report["object list"][2]["object"], "tower");
    EXPECT_EQ(report["object list"][2]["at"], nlohmann::json({5, 6, 34}));
    EXPECT_EQ(report["object list"][5]["mirrored"], true);
    EXPECT_EQ(report["material list"][0]["material"], "glass 7");
    EXPECT_FALSE(report.contains("not shown"));
}

TEST_F(CliImportTest, InfoListsWhatASceneHolds) {
    const std::string scene = " '" VXL_SOURCE_DIR "/scenes/turntable.json'";
    const ProgramResult result = run("info --json" + scene);
    EXPECT_EQ(result.exit_code, 0) << result.err;
    const auto report = nlohmann::json::parse(result.out);
    EXPECT_EQ(report["kind"], "scene");
    EXPECT_EQ(report["frames"], 72);
    EXPECT_EQ(report["display"], "box");
    EXPECT_EQ(report["models"][1]["of"], "torus");
    EXPECT_EQ(report["objects"].size(), report["models"].size());
    // Models are looked for as `render` does.
    put_bytes(folder / "a.json", R"({"voxelume": 1, "models": {"a": {"mesh": "wedge.obj"}},
        "objects": [{"model": "a"}]})");
    EXPECT_EQ(run("info a.json").exit_code, 0);
    std::filesystem::create_directory(folder / "models");
    std::filesystem::rename(folder / "wedge.obj", folder / "models/wedge.obj");
    EXPECT_EQ(run("info a.json").exit_code, 4);
    EXPECT_EQ(run("info a.json --assets models").exit_code, 0);
    put_bytes(folder / "a.json", "{\n\"objects\": [,]}");
    EXPECT_THAT(run("info a.json").err, HasSubstr("a.json:2:13: "));
    put_bytes(folder / "a.json", "{\"device\": 1}");
    EXPECT_THAT(run("info a.json").err, HasSubstr("is neither a scene"));
}

TEST_F(CliImportTest, InfoSaysWhichFluxesAreCut) {
    VoxWriter writer;
    writer.model({2, 1, 1}, {{0, 0, 0, 1}, {1, 0, 0, 2}});
    writer.material(1, {{"_type", "_emit"}, {"_flux", "8"}});
    writer.material(2, {{"_type", "_emit"}, {"_flux", "9.5"}});
    put_bytes(folder / "bright.vox", writer.bytes());
    const auto report = nlohmann::json::parse(run("info --json bright.vox").out);
    EXPECT_EQ(report["not shown"], nlohmann::json({"1 fluxes above 8, which are 8 here"}));
}

TEST_F(CliImportTest, ChoicesThatMakeNoSenseAreUsageErrors) {
    const auto refused = [&](const char* arguments) {
        const ProgramResult result = run(arguments);
        EXPECT_EQ(result.exit_code, 2) << arguments;
        return result.err;
    };
    EXPECT_THAT(refused("render scene.json -o a.png --view top"), HasSubstr("for model files"));
    EXPECT_THAT(refused("check scene.json --no-ground"), HasSubstr("--ground"));
    EXPECT_THAT(refused("render wedge.obj -o a.png --view fornt"),
                HasSubstr("did you mean \"front\"?"));
    EXPECT_THAT(refused("render wedge.obj -o a.png --view 10"), HasSubstr("LONGITUDE,LATITUDE"));
    EXPECT_THAT(refused("render wedge.obj -o a.png --view 0,91"), HasSubstr("-90..90"));
    EXPECT_THAT(refused("render wedge.obj -o a.png --view iso --fov 30"), HasSubstr("parallel"));
    EXPECT_THAT(refused("render wedge.obj -o a.png --background red"), HasSubstr("#rrggbb"));
    EXPECT_THAT(refused("render wedge.obj -o a.png --up x"), HasSubstr("--up"));
    EXPECT_THAT(refused("render scene.json -o a.png --clip walk"), HasSubstr("--clip"));
    EXPECT_THAT(refused("render wedge.obj -o a.png --spacing 1"), HasSubstr("have a spacing"));
    EXPECT_THAT(refused("render wedge.obj -o a.png --spacing 1,2"), HasSubstr("0.5,0.5,2"));
    EXPECT_THAT(refused("render wedge.obj -o a.png --clip walk"),
                HasSubstr("only glTF files have clips; leave \"walk\" out"));
    EXPECT_THAT(refused("import scene.json -o b.json"), HasSubstr("model file"));
    EXPECT_EQ(run("render none.obj -o a.png").exit_code, 4);
}

}  // namespace voxelume
