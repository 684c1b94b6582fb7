// SPDX-License-Identifier: Apache-2.0
// Small files that stand for much work or memory are refused by their counts, before either.
#include <gmock/gmock.h>

#include <map>
#include <random>

#include "runtime/assets/voxel_model_file.hpp"
#include "runtime/io/arrays/array_voxels.hpp"
#include "runtime/io/voxel_art/block_colors.hpp"
#include "runtime/io/voxel_art/cell_bricks.hpp"
#include "runtime/io/voxel_file_table.hpp"
#include "runtime/io/voxels/voxel_limits.hpp"
#include "tests/support/file_fixture.hpp"
#include "tests/support/voxel_cells.hpp"
#include "tests/support/writers/array_writer.hpp"
#include "tests/support/writers/art_writer.hpp"

namespace voxelume {

using testing::HasSubstr;

class VoxelBoundsTest : public FileTest {
  protected:
    std::string refusal(const std::string& name, const std::string& bytes,
                        Surface surface = Surface::cubes, const VoxelValues& values = {}) {
        const auto file = folder / name;
        put_bytes(file, bytes);
        return error_of([&] { read_voxel_model(file, surface, 0, values); }).what();
    }
};

/// A compressed Qubicle matrix of one slice, all of one colour.
std::string full_slice(uint32_t side) {
    return std::string(1, '\0') +
           bytes_of_all(side, side, 1u, 0, 0, 0, 2u, side * side, 0xFF0000FFu, 6u);
}

std::string qb_of(uint32_t compressed, uint32_t matrices) {
    return bytes_of_all(257u, 0u, 1u, compressed, 0u, matrices);
}

TEST_F(VoxelBoundsTest, QubicleCellsAreCountedBeforeTheyAreSet) {
    EXPECT_THAT(refusal("a.qb", qb_of(1, 1) + full_slice(32768)), HasSubstr("268435456 cells"));
    std::string many = qb_of(1, 17);
    for (int i = 0; i < 17; ++i) many += full_slice(4096);
    EXPECT_THAT(refusal("b.qb", many), HasSubstr("268435456 cells"));
    // Matrices without cells have slices without end.
    std::string none = qb_of(0, 30000);
    for (int i = 0; i < 30000; ++i)
        none += std::string(1, '\0') + bytes_of_all(0u, 65536u, 65536u, 0, 0, 0);
    EXPECT_THAT(refusal("c.qb", none), HasSubstr("no voxels"));
}

TEST_F(VoxelBoundsTest, BricksAreCountedBeforeMemoryIsTaken) {
    // 16384 x 16384 cells lie in 2^20 bricks of 16 KiB.
    const std::string slice = qb_of(1, 1) + full_slice(16384);
    EXPECT_THAT(
        refusal("a.qb", slice),
        HasSubstr("more than 16644 bricks of 16 x 16 x 16, and 16644 are possible in a file "
                  "of 65 bytes"));
    const std::string large = slice + std::string(1 << 16, '\0');  // what follows isn't read
    EXPECT_THAT(refusal("a.qb", large), HasSubstr("262144 are possible"));
    put_bytes(folder / "b", "x");
    const InputFile file(folder / "b");
    CellBricks bricks({0, 0, 0}, {40, 16, 16}, file);
    int rounds = 0;
    bricks.fill([&] {
        ++rounds;
        bricks.set({0, 0, 0}, 1);
        bricks.set({39, 15, 15}, 2);
    });
    EXPECT_EQ(rounds, 2);
    EXPECT_EQ(bricks.model().voxels(), 2u);
}

TEST_F(VoxelBoundsTest, SmallFilesDontSpanIndicesOfGigabytes) {
    const auto cell_at = [](int place) {
        return std::string(1, '\0') + bytes_of_all(1u, 1u, 1u, place, place, place, 0xFF0000FFu);
    };
    EXPECT_THAT(refusal("a.qb", qb_of(0, 2) + cell_at(0) + cell_at(9000)),
                HasSubstr("33890304 bricks of 16 are possible in a file of 82 bytes"));
    put_bytes(folder / "b.qb", qb_of(0, 2) + cell_at(0) + cell_at(4000));
    EXPECT_EQ(read_voxel_model(folder / "b.qb", Surface::cubes, 0, {}).voxels(), 2u);
    put_bytes(folder / "c.qb", qb_of(1, 1) + full_slice(1500));
    EXPECT_EQ(read_voxel_model(folder / "c.qb", Surface::cubes, 0, {}).voxels(), 2250000u);
}

TEST_F(VoxelBoundsTest, ModelsReachAsFarAsNumbersHaveRoom) {
    put_bytes(folder / "b", "x");
    const InputFile file(folder / "b");
    GridFrame frame;
    frame.size = {16, 16, 16};
    check_reach(frame, file);
    frame.voxel_edge = glm::dvec3(1, 1e308, 1);  // whose end has no number
    EXPECT_THAT(error_of([&] { check_reach(frame, file); }).what(),
                HasSubstr("its voxels lie inf m away, and at most 1e+30 m are possible"));
    frame.voxel_edge = glm::dvec3(1);
    frame.origin.z = -1e31;
    EXPECT_THAT(error_of([&] { check_reach(frame, file); }).what(), HasSubstr("1e+31 m away"));
}

TEST_F(VoxelBoundsTest, BinvoxRunsAreAddedUpFirst) {
    std::string runs = "#binvox 1\ndim 510 510 511\nscale 1\ndata\n";
    for (int i = 0; i < 510 * 2 * 511; ++i) runs += "\1\xff";
    runs.resize(runs.size() - 2);
    EXPECT_THAT(refusal("a.binvox", runs), HasSubstr("truncated"));
}

TEST_F(VoxelBoundsTest, SmoothSurfacesOfGzipHaveFewerCells) {
    const std::string head = "NRRD0005\ntype: uchar\ndimension: 3\nencoding: gzip\n";
    const std::string zeros = gzipped(std::string(1 << 20, '\0'));
    std::string members;
    for (int i = 0; i < 300; ++i) members += zeros;
    EXPECT_THAT(refusal("a.nrrd", head + "sizes: 1024 1024 257\n\n" + members, Surface::smooth),
                HasSubstr("at most: save it raw"));
    EXPECT_THAT(
        refusal("b.nrrd", head + "sizes: 1024 1024 1\n\n" + zeros, Surface::smooth, {.iso = 0.5}),
        HasSubstr("its values go from 0 to 0"));
}

TEST_F(VoxelBoundsTest, SchematicsOfAirAndOfLongNamesAreRefusedAtOnce) {
    using W = NbtWriter;
    const auto schematic = [](int side, const std::string& name, const std::string& data) {
        return W::compound("Schematic", W::whole("Width", int16_t(side)) +
                                            W::whole("Height", int16_t(side)) +
                                            W::whole("Length", int16_t(side)) +
                                            W::compound("Palette", W::whole(name, int32_t{0})) +
                                            W::bytes("BlockData", data));
    };
    EXPECT_THAT(refusal("a.schem", schematic(640, "air", "")), HasSubstr("no voxels"));
    EXPECT_THAT(refusal("b.schem", schematic(1025, "air", "")), HasSubstr("1073741824 at most"));
    EXPECT_THAT(refusal("c.schem", schematic(1, std::string(257, 'o'), std::string(1, '\0'))),
                HasSubstr("more than 256 bytes"));
    const std::string zeros = gzipped(std::string(1 << 24, '\0'));
    std::string members;
    for (int i = 0; i < 33; ++i) members += zeros;
    EXPECT_THAT(refusal("d.schem", members), HasSubstr("becomes more than the 512 MiB"));
}

// Cells of 3 bits, some of which straddle two longs, in longs that are mostly zeros; and the same
// bits where the number 0 is no air.
TEST_F(VoxelBoundsTest, LongsOfZerosAreAirWhereTheFirstBlockIs) {
    using W = NbtWriter;
    const glm::ivec3 size(7, 9, 5);
    std::mt19937 random(5);
    std::vector<uint64_t> longs(15);
    std::map<uint32_t, uint32_t> numbers;
    for (int i = 0; i < 12; ++i) numbers[uint32_t(random() % 315)] = uint32_t(1 + random() % 4);
    numbers[21] = 3;  // begins at bit 63
    for (const auto& [cell, number] : numbers) {
        longs[cell * 3 / 64] |= uint64_t{number} << cell * 3 % 64;
        if (cell * 3 % 64 > 61) longs[cell * 3 / 64 + 1] |= number >> (64 - cell * 3 % 64);
    }
    const auto xyz = [](const std::string& name, const glm::ivec3& v) {
        return W::compound(name, W::whole("x", v.x) + W::whole("y", v.y) + W::whole("z", v.z));
    };
    for (const std::string first : {"air", "clay"}) {
        const std::vector<std::string> names = {first, "stone", "dirt", "sand", "gold_block"};
        std::vector<std::string> palette;
        for (const std::string& name : names) palette.push_back(W::words("Name", name));
        const std::string region = W::compound(
            "one", xyz("Position", {0, 0, 0}) + xyz("Size", size) +
                       W::compounds("BlockStatePalette", palette) + W::longs("BlockStates", longs));
        VoxelCells expected;
        for (uint32_t cell = 0; cell < 315; ++cell) {
            const auto found = numbers.find(cell);
            if (found == numbers.end() && first == "air") continue;
            const std::string& name = names[found == numbers.end() ? 0 : found->second];
            expected[{int(cell % 7), int(cell / 35), int(cell / 7 % 5)}] = {block_color(name).color,
                                                                            ""};
        }
        const auto file = folder / "a.litematic";
        put_bytes(file, gzipped(W::compound("", W::compound("Regions", region))));
        EXPECT_EQ(cells_of(read_voxel_model(file, Surface::cubes)), expected) << first;
    }
}

TEST_F(VoxelBoundsTest, FarApartAndTinyValuesHaveAThreshold) {
    const auto put = [&](const std::string& shape, const std::vector<double>& values) {
        put_bytes(folder / "a.npy", npy_bytes("<f8", shape, bytes_of_values(values)));
        return folder / "a.npy";
    };
    const auto threshold = [&](double low, double high) {
        const auto file = put("2, 2, 2", {low, high, low, high, high, low, high, low});
        return summary_of_array(voxel_file_format(file)->array(file)).threshold;
    };
    EXPECT_EQ(threshold(-1.7e308, 1.7e308), 0);
    EXPECT_EQ(threshold(0, 5e-324), 5e-324);
    // The surface between them is found too.
    const auto file = put("4, 1, 1", {-1.7e308, 1.7e308, -1.7e308, 1.7e308});
    EXPECT_FALSE(read_voxel_model(file, Surface::smooth, 0, {.iso = 0.0}).coordinates.empty());
}

TEST_F(VoxelBoundsTest, VoxelsAreLongEnoughForTheirPlace) {
    const auto nrrd = [](const std::string& edge, const std::string& origin) {
        return "NRRD0005\ntype: uchar\ndimension: 3\nspace: 3D-right-handed\n"
               "sizes: 1 1 1\nencoding: raw\nspace units: \"m\" \"m\" \"m\"\n"
               "space directions: (" +
               edge + ",0,0) (0,1,0) (0,0,1)\nspace origin: (" + origin + ",0,0)\n\n\1";
    };
    put_bytes(folder / "a.nrrd", nrrd("1e-8", "0"));
    EXPECT_EQ(read_voxel_model(folder / "a.nrrd", Surface::cubes).frame.voxel_edge.x, 1e-8);
    EXPECT_THAT(refusal("b.nrrd", nrrd("1e-10", "0")), HasSubstr("at least 1e-09 m"));
    EXPECT_THAT(refusal("c.nrrd", nrrd("1e-6", "1e7")), HasSubstr("c.nrrd"));
}

TEST_F(VoxelBoundsTest, ALayerHasEachBlockOnce) {
    const auto chunk = [](const std::string& letters, const std::string& content) {
        return letters + bytes_of_all(int32_t(content.size())) + content + bytes_of_all(0);
    };
    EXPECT_THAT(refusal("a.gox", "GOX " + bytes_of_all(2) + chunk("BL16", "x") +
                                     chunk("LAYR", bytes_of_all(2, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0))),
                HasSubstr("two blocks at one place"));
}

}  // namespace voxelume
