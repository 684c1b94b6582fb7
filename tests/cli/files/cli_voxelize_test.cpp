// SPDX-License-Identifier: Apache-2.0
// Scenes, meshes with materials and files of voxels as voxels, read back cell by cell.
#include <array>
#include <set>

#include "tests/cli/scene_program.hpp"
#include "tests/support/writers/array_writer.hpp"
#include "tests/support/writers/gltf_writer.hpp"

namespace voxelume {

using testing::HasSubstr;

namespace {

/// A numpy array of bytes (x, y, z, 4), x slowest: red, green, blue and opacity.
struct ColorCells {
    std::array<int, 3> size{};
    std::string bytes;

    std::array<int, 4> at(int x, int y, int z) const {
        std::array<int, 4> color{};
        for (size_t c = 0; c < 4; ++c)
            color[c] = uint8_t(bytes[size_t((x * size[1] + y) * size[2] + z) * 4 + c]);
        return color;
    }
};

/// The shape of an array without colours.
std::array<int, 3> shape_of(const std::string& npy) {
    std::array<int, 3> shape{};
    EXPECT_EQ(std::sscanf(npy.c_str() + npy.find("'shape': ("), "'shape': (%d, %d, %d)",
                          shape.data(), &shape[1], &shape[2]),
              3);
    return shape;
}

ColorCells cells_of(const std::string& npy) {
    const size_t shape = npy.find("'shape': (");
    ColorCells cells;
    int channels = 0;
    EXPECT_EQ(std::sscanf(npy.c_str() + shape, "'shape': (%d, %d, %d, %d)", cells.size.data(),
                          &cells.size[1], &cells.size[2], &channels),
              4);
    EXPECT_EQ(channels, 4);
    cells.bytes = npy.substr(npy.find('\n', shape) + 1);
    return cells;
}

}  // namespace

class CliVoxelizeTest : public SceneProgramTest {
  protected:
    /// A block that turns from red to blue in three frames.
    void write_changing_scene() {
        write_scene([](Json& scene) {
            scene["animation"] = {{"frames", 3},
                                  {"tracks",
                                   {{{"target", "materials.brick.color"},
                                     {"keys",
                                      {{{"frame", 1}, {"value", {1, 0, 0}}},
                                       {{"frame", 3}, {"value", {0, 0, 1}}}}}}}}};
        });
    }
};

TEST_F(CliVoxelizeTest, ASceneBecomesTheCubesOfItsWorldInTheirColors) {
    // Boxes that fill whole voxels: 12 x 8 x 4 of them, and 2 x 2 x 2 on top, half opaque.
    write_scene([](Json& scene) {
        scene["world"]["bounds"] = {{"min", {0, 0, 0}}, {"max", {3, 2, 1}}};
        scene["materials"] = {{"brick", {{"color", {1, 0.21223076, 0}}}},
                              {"glass", {{"color", {0, 0, 1}}, {"opacity", 0.5}}}};
        scene["models"]["thing"]["set"] = "solid";
        scene["models"]["top"] = {
            {"shape", "box"}, {"size", {0.2, 0.2, 0.2}}, {"surface", "cubes"}, {"set", "solid"}};
        scene["objects"][0]["position"] = {1.5, 1, 0.5};
        scene["objects"][0]["placement"] = "instance";
        scene["objects"].push_back(
            {{"model", "top"}, {"material", "glass"}, {"position", {1, 1.5, 0.5}}});
    });
    const ProgramResult result = run("voxelize scene.json -o s.npy -o s.vxm -o s.vdb -o s.vox");
    ASSERT_EQ(result.exit_code, 0) << result.err;
    EXPECT_THAT(result.err, HasSubstr("2 objects to 12x10x4 voxels of 0.1 m"));
    const ColorCells cells = cells_of(bytes_of(folder / "s.npy"));
    EXPECT_EQ(cells.size, (std::array{12, 10, 4}));
    for (int x = 0; x < 12; ++x)
        for (int y = 0; y < 10; ++y)
            for (int z = 0; z < 4; ++z) {
                const bool is_brick = y < 8;
                const bool is_top = y >= 8 && x < 2 && z >= 1 && z < 3;
                const std::array<int, 4> expected = is_brick ? std::array{255, 127, 0, 255}
                                                    : is_top ? std::array{0, 0, 255, 127}
                                                             : std::array{0, 0, 0, 0};
                EXPECT_EQ(cells.at(x, y, z), expected) << x << " " << y << " " << z;
            }
    for (const char* copy : {"s.nrrd", "t.vdb", "s.kv6"})  // as of no display
        EXPECT_EQ(run(fmt::format("convert s.vdb {}", copy)).exit_code, 0) << copy;
    for (const char* copy : {"s.vxm", "s.vdb", "s.nrrd", "t.vdb"}) {
        ASSERT_EQ(run(fmt::format("convert {} copy.npy", copy)).exit_code, 0) << copy;
        const ColorCells read = cells_of(bytes_of(folder / "copy.npy"));
        EXPECT_EQ(read.size, cells.size) << copy;
        EXPECT_EQ(read.at(11, 7, 3), cells.at(11, 7, 3)) << copy;
        std::filesystem::remove(folder / "copy.npy");
    }
    ASSERT_EQ(run("convert s.vxm copy.npy").exit_code, 0);
    EXPECT_EQ(bytes_of(folder / "copy.npy"), bytes_of(folder / "s.npy"));
}

TEST_F(CliVoxelizeTest, AWorldAndAFileTakeOtherVoxels) {
    write_scene([](Json& scene) {
        scene["models"]["thing"]["set"] = "solid";
        scene["objects"][0]["position"] = {1.6, 1, 0.6};
    });
    ASSERT_EQ(run("voxelize scene.json --voxel-size 0.2 -o s.npy").exit_code, 0);
    EXPECT_EQ(cells_of(bytes_of(folder / "s.npy")).size, (std::array{6, 4, 2}));
    const std::string file(4 * 4 * 4 * 4, '\xff');
    put_bytes(folder / "block.npy", npy_bytes("|u1", "4, 4, 4, 4", file));
    ASSERT_EQ(run("voxelize block.npy --voxel-size 2 -o b.vox").exit_code, 0);
    EXPECT_EQ(Json::parse(run("info b.vox --json").out)["voxels"], 8);
    ASSERT_EQ(run("voxelize block.npy -o c.vox").exit_code, 0);
    EXPECT_EQ(Json::parse(run("info c.vox --json").out)["voxels"], 64);
}

TEST_F(CliVoxelizeTest, TheInsideOfASolidHasItsColor) {
    // There are 60 cubes along each side, and some bricks of 16 are full.
    write_scene([](Json& scene) {
        scene["world"] = {{"voxel_size", 0.02}};
        scene["materials"]["brick"] = {{"color", {1, 0, 0}}, {"opacity", 0.5}};
        scene["models"]["thing"] = {
            {"shape", "box"}, {"size", {1.2, 1.2, 1.2}}, {"surface", "cubes"}, {"set", "solid"}};
        scene["objects"][0]["position"] = {0, 0, 0};
    });
    ASSERT_EQ(run("voxelize scene.json -o s.npy -o s.vdb").exit_code, 0);
    const ColorCells cells = cells_of(bytes_of(folder / "s.npy"));
    ASSERT_EQ(cells.size, (std::array{60, 60, 60}));
    for (size_t i = 0; i < cells.bytes.size(); i += 4)
        ASSERT_EQ(cells.bytes.compare(i, 4, "\xff\0\0\x7f", 4), 0) << i;
}

TEST_F(CliVoxelizeTest, AResolutionCountsVoxelsOfWhatIsShown) {
    put_bytes(folder / "block.npy", npy_bytes("|u1", "6, 4, 2, 4", std::string(192, '\xff')));
    ASSERT_EQ(run("voxelize block.npy --resolution 12 -o b.npy").exit_code, 0);
    const ColorCells cells = cells_of(bytes_of(folder / "b.npy"));
    EXPECT_EQ(*std::ranges::max_element(cells.size), 12);
    EXPECT_EQ(*std::ranges::min_element(cells.size), 4);
}

TEST_F(CliVoxelizeTest, AScanHasTheVoxelsThatItsPictureHas) {
    // Noise from 0 to 3 around a block of values of 90.
    std::vector<float> values;
    for (int i = 0; i < 10 * 10 * 10; ++i) {
        const int x = i / 100, y = i / 10 % 10, z = i % 10;
        const bool is_block =
            std::max({std::abs(2 * x - 9), std::abs(2 * y - 9), std::abs(2 * z - 9)}) < 4;
        values.push_back((is_block ? 90.0f : 0.0f) + 0.01f * float(i * 37 % 300));
    }
    put_bytes(folder / "scan.npy", npy_bytes("<f4", "10, 10, 10", bytes_of_values(values)));
    put_bytes(folder / "labels.npy", npy_bytes("|u1", "1, 1, 4", std::string("\0\1\2\2", 4)));
    for (const char* command : {"voxelize {} -o {}", "convert {} {}"}) {
        const auto made = [&](const char* from) {
            EXPECT_EQ(run(fmt::format(fmt::runtime(command), from, "made.vox")).exit_code, 0);
            return Json::parse(run("info made.vox --json").out);
        };
        EXPECT_EQ(made("scan.npy")["voxels"], 64) << command;
        EXPECT_EQ(made("labels.npy")["voxels"], 3) << command;
        EXPECT_EQ(made("labels.npy")["colors used"], 2) << command;
    }
}

TEST_F(CliVoxelizeTest, FramesOfAMovingGltfAreThoseOfItsScene) {
    GltfWriter writer = triangle_gltf();
    writer.json["animations"] = {
        {{"channels", {{{"sampler", 0}, {"target", {{"node", 0}, {"path", "scale"}}}}}},
         {"samplers",
          {{{"input", writer.accessor(std::vector<float>{0, 1}, "SCALAR", 1)},
            {"output", writer.accessor(std::vector<float>{1, 1, 1, 2, 1, 1}, "VEC3", 3)}}}}}};
    put_bytes(folder / "a.glb", writer.glb());
    ASSERT_EQ(run("voxelize a.glb -o a.####.npy --frames 1,25 --resolution 40").exit_code, 0);
    const auto width = [&](const char* name) { return cells_of(bytes_of(folder / name)).size[0]; };
    EXPECT_NEAR(width("a.0025.npy"), 2 * width("a.0001.npy"), 2);
    ASSERT_EQ(run("voxelize a.glb -o b.npy --frame 25 --resolution 20").exit_code, 0);
    EXPECT_NEAR(width("b.npy"), 20, 1);
}

TEST_F(CliVoxelizeTest, ObjectsAreLeftOutByTheirNames) {
    write_scene([](Json& scene) {
        scene["objects"].push_back(scene["objects"][0]);
        scene["objects"][0]["name"] = "left";
        scene["objects"][1]["name"] = "right";
        scene["objects"][1]["position"] = {3, 0, 0};
    });
    ASSERT_EQ(run("voxelize scene.json -o both.npy").exit_code, 0);
    ASSERT_EQ(run("voxelize scene.json -o left.npy --without right").exit_code, 0);
    const auto width = [&](const char* name) { return cells_of(bytes_of(folder / name)).size[0]; };
    EXPECT_GT(width("both.npy"), width("left.npy"));
    const ProgramResult result = run("voxelize scene.json -o c.npy --without rihgt");
    EXPECT_EQ(result.exit_code, 2);
    EXPECT_THAT(result.err, HasSubstr("did you mean \"right\"?"));
}

TEST_F(CliVoxelizeTest, AFrameOfASceneThatMovesIsChosen) {
    write_changing_scene();
    EXPECT_EQ(run("voxelize scene.json --frame 4 -o s.npy").exit_code, 2);
    ASSERT_EQ(run("voxelize scene.json --frame 3 -o s.npy").exit_code, 0);
    EXPECT_EQ(cells_of(bytes_of(folder / "s.npy")).at(0, 0, 0), (std::array{0, 0, 255, 255}));
}

TEST_F(CliVoxelizeTest, AMeshHasTheColorsOfItsMaterials) {
    put_bytes(folder / "m.mtl", "newmtl red\nKd 1 0 0\nnewmtl green\nKd 0 1 0\n");
    put_bytes(folder / "m.obj",
              "mtllib m.mtl\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 1 0 1\nv 1 1 1\n"
              "v 0 1 1\nusemtl red\nf 1 2 3 4\nusemtl green\nf 5 6 7 8\n");
    ASSERT_EQ(run("voxelize m.obj --resolution 8 -o m.npy").exit_code, 0);
    const ColorCells cells = cells_of(bytes_of(folder / "m.npy"));
    EXPECT_EQ(cells.at(4, 4, 0), (std::array{255, 0, 0, 255}));
    EXPECT_EQ(cells.at(4, 4, cells.size[2] - 1), (std::array{0, 255, 0, 255}));
    EXPECT_EQ(cells.at(4, 4, cells.size[2] / 2), (std::array{0, 0, 0, 0}));
}

TEST_F(CliVoxelizeTest, PointsAndLinesAreCubesOfTheirPlaces) {
    put_bytes(folder / "p.obj", "v 0 0 0 1 0 0\nv 7 0 0 0 1 0\nv 7 7 7 0 1 0\np 1\nl 2 3\n");
    ASSERT_EQ(run("voxelize p.obj --voxel-size 1.01 -o p.vxm").exit_code, 0);
    EXPECT_THAT(run("info p.vxm").out, HasSubstr("cubes"));
    ASSERT_EQ(run("voxelize p.obj --voxel-size 1.01 -o p.npy").exit_code, 0);
    const ColorCells cells = cells_of(bytes_of(folder / "p.npy"));
    EXPECT_EQ(cells.size, (std::array{7, 7, 7}));
    EXPECT_EQ(cells.at(0, 0, 0), (std::array{255, 0, 0, 255}));
    for (int i = 0; i < 7; ++i) EXPECT_EQ(cells.at(6, i, i), (std::array{0, 255, 0, 255})) << i;
    for (int i = 1; i < 6; ++i) EXPECT_EQ(cells.at(i, 0, 0)[3], 0) << i;
    const auto refused = run("voxelize p.obj --surface exact -o p.vxm");
    EXPECT_EQ(refused.exit_code, 4);
    EXPECT_THAT(refused.err, HasSubstr("nothing but cubes can be made"));
}

TEST_F(CliVoxelizeTest, NumberedFilesAreFramesWithVoxelsOfOneSize) {
    for (const int number : {1, 2, 4})
        put_bytes(folder / fmt::format("m.{:04}.obj", number),
                  fmt::format("v 0 0 0\nv {} 0 0\nv 0 1 0\nv 0 0 1\n"
                              "f 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n",
                              number));
    const ProgramResult all = run("voxelize m.####.obj -o v.####.npy -o v.%04d.vox --resolution 8");
    ASSERT_EQ(all.exit_code, 0) << all.err;
    EXPECT_THAT(all.err, HasSubstr("1 gap; the first begins at m.0003.obj"));
    for (const int number : {1, 2, 4}) {
        // Triangles that lie between two voxels belong to both.
        EXPECT_EQ(shape_of(bytes_of(folder / fmt::format("v.{:04}.npy", number))),
                  (std::array{8 * number + 2, 10, 10}));
        EXPECT_FALSE(bytes_of(folder / fmt::format("v.{:04}.vox", number)).empty());
    }
    ASSERT_EQ(run("voxelize m.####.obj --frames 2 -o one.npy --voxel-size 0.5 -q").exit_code, 0);
    EXPECT_EQ(shape_of(bytes_of(folder / "one0002.npy")), (std::array{6, 4, 4}));
}

TEST_F(CliVoxelizeTest, FramesThatAreMissingOrShareAFileAreRefusedBeforeAnyIsWritten) {
    put_bytes(folder / "t.obj", kTetrahedron);
    put_bytes(folder / "m.0002.obj", kTetrahedron);
    for (const auto& [code, words, message] :
         {std::tuple{4, "m.####.obj --frames 1-8 -o v.####.vox",
                     "7 of the 8 files are missing: m.0001.obj, m.0003.obj"},
          {4, "n.####.obj -o v.####.vox", "no file has such a name"},
          {2, "t.obj -o v.####.vox", "a mesh is one frame"},
          {2, "m.####.obj -o v.####.vox --frame 2", "--frames chooses among numbered ones"},
          {2, "m.####.obj -o v.####.vox -o v.%04d.vox", "v.0002.vox"},
          {2, "scene.json --frames 1-2 -o v.####.vox", "no frame 2: the last one is 1"},
          {2, "scene.json --frames 1 --frame 1 -o v.####.vox", "excludes"}})
        EXPECT_THAT(expect_failure(code, fmt::format("voxelize {}", words)), HasSubstr(message));
    put_bytes(folder / "w.0001.vox", "VOX ");
    EXPECT_THAT(expect_failure(2, "voxelize w.####.vox -o w.####.vox"),
                HasSubstr("would replace a file"));
}

TEST_F(CliVoxelizeTest, AllFramesOfASceneAreWritten) {
    write_changing_scene();
    ASSERT_EQ(run("voxelize scene.json -o s.##.npy").exit_code, 0);
    EXPECT_EQ(cells_of(bytes_of(folder / "s.01.npy")).at(0, 0, 0), (std::array{255, 0, 0, 255}));
    EXPECT_EQ(cells_of(bytes_of(folder / "s.03.npy")).at(0, 0, 0), (std::array{0, 0, 255, 255}));
}

TEST_F(CliVoxelizeTest, OptionsOfOtherInputsAreRefused) {
    put_bytes(folder / "t.obj", kTetrahedron);
    for (const char* option : {"--surface smooth", "--set solid", "--normals surface"})
        EXPECT_THAT(expect_failure(2, fmt::format("voxelize scene.json -o a.vox {}", option)),
                    HasSubstr("is for meshes"));
    EXPECT_THAT(expect_failure(2, "voxelize t.obj -o a.vox --frame 2"), HasSubstr("for scenes"));
    EXPECT_THAT(expect_failure(2, "voxelize scene.json -o a.vox --frame 2"),
                HasSubstr("the last one is 1"));
    EXPECT_THAT(expect_failure(4, "voxelize none.json -o a.vox"), HasSubstr("no such file"));
    write_scene([](Json& scene) { scene["objects"] = Json::array(); });
    EXPECT_THAT(expect_failure(4, "voxelize scene.json -o a.vox"), HasSubstr("no voxels"));
    EXPECT_THAT(expect_failure(8, "voxelize scene.json -o a.vox --voxel-size 1e-6"),
                HasSubstr("more than 65536"));
}

}  // namespace voxelume
