// SPDX-License-Identifier: Apache-2.0
// Arrays and files of voxels on the command line: render, import, info, convert and voxelize.
#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "runtime/io/image/exr.hpp"
#include "tests/cli/scene_program.hpp"
#include "tests/support/writers/array_writer.hpp"
#include "tests/support/writers/png_writer.hpp"

namespace voxelume {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

class CliVoxelFilesTest : public ProgramTest {
  protected:
    /// A ball of 20 x 16 x 12 cells whose values fall off from its middle.
    void put_ball() {
        std::vector<float> values;
        for (int x = 0; x < 20; ++x)
            for (int y = 0; y < 16; ++y)
                for (int z = 0; z < 12; ++z) {
                    const double dx = x - 9.5, dy = y - 7.5, dz = z - 5.5;
                    values.push_back(float(30 - dx * dx - dy * dy - dz * dz));
                }
        put_bytes(folder / "ball.npy", npy_bytes("<f4", "20, 16, 12", bytes_of_values(values)));
    }
    nlohmann::json info(const std::string& name) {
        return nlohmann::json::parse(run("info --json " + name).out);
    }
};

TEST_F(CliVoxelFilesTest, ANameWithHashesIsAStackOfSlices) {
    // The stack begins at 9 and goes on to 10; slice 4 lies apart, slice008x is another name.
    const std::vector<std::string> rows = {std::string(1, '\7') + std::string(2, '\0')};
    for (const char* name : {"s 009.png", "s 010.png", "s 1000.png", "s 008x.png", "s 0007.png"})
        put_bytes(folder / name, png_of_rows(3, 8, 0, rows));
    EXPECT_EQ(run("check 's ###.png'").exit_code, 0);
    const auto scene = nlohmann::json::parse(run("import 's ###.png'").out);
    EXPECT_EQ(scene.at("models").at("s 009").at("voxels"), "s 009.png");
    EXPECT_EQ(scene.at("models").at("s 009").at("surface"), "cubes");
    EXPECT_EQ(info("'s ###.png'")["file"], "s 009.png");
    EXPECT_EQ(info("'s ###.png'")["size"], nlohmann::json({3, 1, 2}));
    EXPECT_EQ(run("convert 's ###.png' slices.vox").exit_code, 0);
    EXPECT_EQ(run("voxelize 's ###.png' -o stack.npy").exit_code, 0);
    const ProgramResult none = run("render 't##.png' -o a.png");
    EXPECT_EQ(none.exit_code, run("render none.json -o a.png").exit_code);
    EXPECT_THAT(none.err, HasSubstr("no file has such a name"));
    EXPECT_THAT(run("render none##.json -o a.png").err, HasSubstr("no such file"));
}

TEST_F(CliVoxelFilesTest, AnArrayOfValuesIsASmoothSurfaceWithoutAScene) {
    put_ball();
    const ProgramResult result = run("render ball.npy -o a.exr --size 32x24 --samples 1");
    EXPECT_EQ(result.exit_code, 0) << result.err;
    EXPECT_EQ(read_exr(folder / "a.exr").id_planes.at("objectId")[12 * 32 + 16], 1u);
    const auto scene = nlohmann::json::parse(run("import ball.npy").out);
    EXPECT_EQ(scene["models"]["ball"]["surface"], "smooth");
    const double iso = scene["models"]["ball"]["iso"];
    EXPECT_GT(iso, -100);
    EXPECT_LT(iso, 20);
    const auto report = info("ball.npy");
    EXPECT_EQ(report["kind"], "numpy array");
    EXPECT_THAT(report["size"], ElementsAre(20, 16, 12));
    EXPECT_NEAR(double(report["threshold"]), iso, 0.01 * std::abs(iso) + 0.01);
}

TEST_F(CliVoxelFilesTest, LabelsHaveColoursAndZMayBeUp) {
    std::vector<uint8_t> values(4 * 2 * 3);
    values[0] = 1;
    values[23] = 2;
    put_bytes(folder / "l.npy", npy_bytes("|u1", "4, 2, 3", bytes_of_values(values)));
    const auto scene = nlohmann::json::parse(run("import l.npy --up z").out);
    EXPECT_EQ(scene["models"]["l"]["label"], "each");
    EXPECT_THAT(scene["objects"][0]["turn"], ElementsAre(0, -90, 0));
    EXPECT_EQ(info("l.npy")["labels"].size(), 2u);
    EXPECT_EQ(run("render l.npy --up z -o l.png --size 16x12 --samples 1").exit_code, 0);
}

TEST_F(CliVoxelFilesTest, VoxelsAreConvertedAndStayTheSame) {
    std::vector<uint8_t> values(5 * 4 * 3 * 3);
    for (size_t i = 0; i < values.size(); ++i) values[i] = i % 7 == 0 ? uint8_t(i + 1) : 0;
    put_bytes(folder / "a.npy", npy_bytes("|u1", "5, 4, 3, 3", bytes_of_values(values)));
    for (const char* pair : {"a.npy a.vox", "a.vox b.nrrd", "b.nrrd b.npy", "b.npy b.vox"}) {
        const ProgramResult result = run(std::string("convert ") + pair);
        EXPECT_EQ(result.exit_code, 0) << pair << result.err;
        EXPECT_THAT(result.err, IsEmpty()) << pair;
    }
    EXPECT_EQ(bytes_of(folder / "a.vox"), bytes_of(folder / "b.vox"));
    EXPECT_THAT(run("convert a.vox a.binvox").err, HasSubstr("note: a .binvox has no colours"));
    EXPECT_THAT(run("convert missing.npy a.vox").err, HasSubstr("no such file"));
    EXPECT_EQ(info("a.vox")["voxels"], info("a.binvox")["voxels"]);
}

TEST_F(CliVoxelFilesTest, VoxelizedCubesAreWrittenForOtherPrograms) {
    put_bytes(folder / "a.obj",
              "v 0 0 0\nv 3 0 0\nv 0 2 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\n"
              "f 2 3 4\nf 3 1 4\n");
    const ProgramResult result =
        run("voxelize a.obj --surface cubes --resolution 20 -o a.vox -o a.npy -o a.binvox");
    EXPECT_EQ(result.exit_code, 0) << result.err;
    EXPECT_EQ(run("convert a.npy b.vox").exit_code, 0);
    EXPECT_EQ(bytes_of(folder / "a.vox"), bytes_of(folder / "b.vox"));
    EXPECT_EQ(run("voxelize a.obj --resolution 20 -o c.vox").exit_code, 0);
    EXPECT_EQ(bytes_of(folder / "a.vox"), bytes_of(folder / "c.vox"));
    EXPECT_THAT(run("voxelize a.obj --surface smooth -o d.vox").err, HasSubstr("cubes alone"));
    EXPECT_THAT(run("voxelize a.obj --resolution 20 -o e.vxm -o e.vox").err,
                HasSubstr("e.vox: files of this format hold cubes alone: add --surface cubes"));
    EXPECT_FALSE(std::filesystem::exists(folder / "e.vxm"));
    for (const char* output : {"f.vox", "f.nrrd", "f.raw"}) {
        const ProgramResult converted = run(std::string("convert a.obj ") + output);
        EXPECT_EQ(converted.exit_code, 2) << output;
        EXPECT_THAT(converted.err, HasSubstr("a.obj: is a mesh, whose voxels `voxelume voxelize`"));
    }
}

TEST_F(CliVoxelFilesTest, OpacityStaysInOpenVdb) {
    std::vector<uint8_t> values(5 * 4 * 3 * 4);
    for (size_t i = 0; i < values.size(); ++i) values[i] = uint8_t(1 + i * 37 % 255);
    put_bytes(folder / "a.npy", npy_bytes("|u1", "5, 4, 3, 4", bytes_of_values(values)));
    for (const char* pair : {"a.npy a.vdb", "a.vdb b.npy", "a.npy c.npy"}) {
        const ProgramResult result = run(std::string("convert ") + pair);
        EXPECT_EQ(result.exit_code, 0) << pair << result.err;
        EXPECT_THAT(result.err, IsEmpty()) << pair;
    }
    EXPECT_EQ(bytes_of(folder / "b.npy"), bytes_of(folder / "c.npy"));
    const std::string bytes = bytes_of(folder / "b.npy");
    const std::string kept(values.begin(), values.end());
    EXPECT_THAT(bytes, HasSubstr(kept)) << "red, green, blue and opacity of each cell";
}

// The middles of 294 voxels lie in this tetrahedron; a field of distances has its edges rounded.
TEST_F(CliVoxelFilesTest, TheInsideOfASmoothSurfaceBecomesCubes) {
    put_bytes(folder / "t.obj",
              "v 0 0 0\nv 3 0 0\nv 0 2 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\n"
              "f 2 3 4\nf 3 1 4\n");
    ASSERT_EQ(run("voxelize t.obj --resolution 20 -o t.vxm -o t.vdb").exit_code, 0);
    for (const char* command : {"voxelize t.vxm -o {}", "voxelize t.vdb -o {}", "convert t.vxm {}"})
        for (const char* output : {"a.vox", "a.binvox"}) {
            const ProgramResult result = run(fmt::format(fmt::runtime(command), output));
            EXPECT_EQ(result.exit_code, 0) << result.err;
            EXPECT_THAT(result.err, HasSubstr("note: a smooth surface became the cubes inside it"));
            EXPECT_NEAR(info(output)["voxels"].get<double>(), 294, 30) << command << output;
            std::filesystem::remove(folder / output);
        }
    ASSERT_EQ(run("voxelize t.obj --resolution 20 --surface exact -o e.vxm").exit_code, 0);
    EXPECT_THAT(run("voxelize e.vxm -o e.vox").err, HasSubstr("voxelize the mesh again, as cubes"));
}

TEST_F(CliVoxelFilesTest, WhatCubesDontHoldIsSaid) {
    put_bytes(folder / "s.json", R"({"voxelume": 1, "world": {"voxel_size": 0.1},
        "materials": {"lamp": {"emission": [1, 1, 1]}},
        "models": {"ball": {"shape": "sphere", "radius": 0.3}},
        "objects": [{"model": "ball", "material": "lamp"}]})");
    EXPECT_THAT(run("voxelize s.json -o s.kv6").err, HasSubstr("became plain colours"));
    EXPECT_THAT(run("voxelize s.json -o s.vox").err, Not(HasSubstr("plain colours")));
    EXPECT_THAT(run("info s.vox").out, HasSubstr("emit"));
    EXPECT_THAT(run("convert s.vox t.vox").err, Not(HasSubstr("plain colours")));
    EXPECT_EQ(bytes_of(folder / "t.vox"), bytes_of(folder / "s.vox"));
    EXPECT_EQ(run("voxelize s.json -o s###.npy").exit_code, 0);  // as render names its frame
    EXPECT_TRUE(std::filesystem::exists(folder / "s001.npy"));
}

TEST_F(CliVoxelFilesTest, DamagedFilesAreRefusedByTheReaderThatTheirNameNames) {
    put_ball();
    put_bytes(folder / "t.obj", "v 0 0 0\nv 3 0 0\nv 0 2 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\n");
    ASSERT_EQ(
        run("voxelize t.obj --resolution 4 --surface cubes -o a.vxm -o a.vdb -o a.vox -o a.kv6 "
            "-o a.binvox -o a.npy -o a.nrrd")
            .exit_code,
        0);
    const std::pair<const char*, const char*> kinds[] = {
        {"npy", "not a numpy array"},     {"nrrd", "not a NRRD file"},
        {"kv6", "not a KV6 file"},        {"binvox", "not a binvox file"},
        {"gox", "not a Goxel file"},      {"qb", "not a Qubicle file"},
        {"vox", "not a MagicaVoxel"},     {"vxm", "not a voxelume model"},
        {"vdb", "readable OpenVDB file"}, {"nii", "too short for a NIfTI file"}};
    const auto expect = [&](const std::string& file, const char* words) {
        for (const char* command : {"info {}", "check {}", "render {} -q -o o.png",
                                    "convert {} o.vox", "voxelize {} -o o.vxm"}) {
            const std::string line = fmt::format(fmt::runtime(command), file);
            const ProgramResult result = run(line);
            EXPECT_EQ(result.exit_code, 4) << line;
            EXPECT_EQ(std::ranges::count(result.err, '\n'), 1) << line << result.err;
            EXPECT_THAT(result.err, HasSubstr(file)) << line;
            EXPECT_EQ(result.err.find("OpenVDB") == std::string::npos, !file.ends_with(".vdb"))
                << line << result.err;
            EXPECT_THAT(result.err, HasSubstr(words)) << line;
            EXPECT_FALSE(std::filesystem::exists(folder / "o.png")) << line;
            EXPECT_FALSE(std::filesystem::exists(folder / "o.vox")) << line;
        }
    };
    for (const auto& [ending, words] : kinds) {
        const std::string whole = std::string("a.") + ending;
        put_bytes(folder / ("b." + std::string(ending)),
                  "words that are no voxels, forty at least");
        expect(std::string("b.") + ending, words);
        if (!std::filesystem::exists(folder / whole)) continue;
        const std::string bytes = bytes_of(folder / whole);
        ASSERT_EQ(run("info " + whole).exit_code, 0) << whole;
        put_bytes(folder / ("c." + std::string(ending)), "XXXX" + bytes.substr(4));
        expect(std::string("c.") + ending, words);
        put_bytes(folder / ("d." + std::string(ending)), bytes.substr(0, bytes.size() / 3));
        expect(std::string("d.") + ending, "");
    }
}

TEST_F(CliVoxelFilesTest, ARenamedFileIsReadByWhatItBeginsWith) {
    put_bytes(folder / "t.obj", "v 0 0 0\nv 3 0 0\nv 0 2 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\n");
    ASSERT_EQ(
        run("voxelize t.obj --resolution 4 --surface cubes -o a.vxm -o a.vdb -o a.vox -o a.npy")
            .exit_code,
        0);
    for (const char* ending : {"vxm", "vdb", "vox"}) {
        const std::string copy = std::string(ending) + ".npy";
        std::filesystem::copy_file(folder / (std::string("a.") + ending), folder / copy);
        EXPECT_EQ(run("info " + copy).exit_code, 0) << ending;
        EXPECT_EQ(run("convert " + copy + " o.vox").exit_code, 0) << ending;
    }
}

TEST_F(CliVoxelFilesTest, ObjectsOfAFileAreLeftOutByTheirNames) {
    const std::string file = "voxelize '" VXL_SOURCE_DIR "/scenes/lighthouse.vox' -o a.vox";
    ASSERT_EQ(run(file).exit_code, 0);
    const auto voxels = [&] {
        return nlohmann::json::parse(run("info a.vox --json").out)["voxels"].get<int>();
    };
    const int all = voxels();
    ASSERT_EQ(run(file + " --without tower").exit_code, 0);
    EXPECT_LT(voxels(), all);
    EXPECT_EQ(run(file + " --without nobody").exit_code, 2);
}

TEST_F(CliVoxelFilesTest, AMeshIsOneModelOfAVox) {
    put_bytes(folder / "wedge.obj", kTetrahedron);
    const ProgramResult result = run("voxelize wedge.obj -o a.vox");
    ASSERT_EQ(result.exit_code, 0) << result.err;
    const auto report = nlohmann::json::parse(run("info a.vox --json").out);
    EXPECT_EQ(report["models"], 1);
    EXPECT_GE(report["model list"][0]["size"][0], 254);
}

}  // namespace voxelume
