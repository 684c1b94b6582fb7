// SPDX-License-Identifier: Apache-2.0
// Files of voxel editors and games, voxel by voxel.
#include <gmock/gmock.h>

#include "runtime/assets/voxel_model_file.hpp"
#include "runtime/io/image/png.hpp"
#include "runtime/io/voxel_art/block_colors.hpp"
#include "runtime/io/voxel_art/voxel_art.hpp"
#include "tests/support/file_fixture.hpp"
#include "tests/support/voxel_cells.hpp"
#include "tests/support/writers/art_writer.hpp"

namespace voxelume {

using testing::Contains;
using testing::HasSubstr;
using testing::IsEmpty;

class VoxelArtTest : public FileTest {
  protected:
    std::filesystem::path put(const std::string& name, const std::string& bytes) {
        put_bytes(folder / name, bytes);
        return folder / name;
    }
    VoxelCells cells(const std::string& name, const std::string& bytes) {
        return cells_of(read_voxel_model(put(name, bytes), Surface::cubes));
    }
    std::string refusal(const std::string& name, const std::string& bytes) {
        const auto file = put(name, bytes);
        return error_of([&] { read_voxel_model(file, Surface::cubes); }).what();
    }
    /// Every shorter file is refused with its name, and none crashes.
    void expect_truncations_refused(const std::string& name, const std::string& bytes,
                                    size_t last) {
        for (size_t size = 0; size < last; ++size)
            EXPECT_THAT(refusal(name, bytes.substr(0, size)), HasSubstr(name)) << size;
    }
};

/// Qubicle's header, and a matrix with its name.
std::string qb_head(uint32_t colors, uint32_t towards, uint32_t compressed, uint32_t matrices) {
    return bytes_of_all(uint32_t{257}, colors, towards, compressed, uint32_t{0}, matrices);
}

std::string qb_matrix(std::array<uint32_t, 3> size, std::array<int32_t, 3> at) {
    return std::string("\4name") + bytes_of_all(size[0], size[1], size[2], at[0], at[1], at[2]);
}

TEST_F(VoxelArtTest, QubicleMatricesLieXFastestThenY) {
    // 2 x 3 x 1 at (5, 6, 7): (0, 0), (1, 0), (0, 1), ...
    std::string bytes = qb_head(0, 1, 0, 1) + qb_matrix({2, 3, 1}, {5, 6, 7});
    for (const uint32_t word : {0xFF030201u, 0u, 0x01060504u, 0x00FFFFFFu, 0u, 0xFF090807u})
        append_value(bytes, word);
    const VoxelCells expected = {
        {{5, 6, 7}, {0x030201, ""}}, {{5, 7, 7}, {0x060504, ""}}, {{6, 8, 7}, {0x090807, ""}}};
    EXPECT_EQ(cells("a.qb", bytes), expected);
    expect_truncations_refused("a.qb", bytes, bytes.size());
    // These voxels are compressed, blue comes first, and Z points away: the slice before z = -7.
    std::string packed = qb_head(1, 0, 1, 2) + qb_matrix({2, 3, 1}, {5, 6, 7});
    for (const uint32_t word : {0xFF010203u, 0u, 0x01040506u, 2u, 2u, 0u, 0xFF070809u, 6u})
        append_value(packed, word);
    packed += qb_matrix({1, 1, 1}, {5, 6, 7}) + bytes_of_all(0xFF112233u, 6u);
    const VoxelCells covered = {
        {{5, 6, -8}, {0x332211, ""}}, {{5, 7, -8}, {0x060504, ""}}, {{6, 8, -8}, {0x090807, ""}}};
    EXPECT_EQ(cells("b.qb", packed), covered);
    EXPECT_THAT(read_qb(folder / "b.qb").notes, Contains("2 matrices, shown as one"));
    expect_truncations_refused("b.qb", packed, packed.size());
    std::string wrong = qb_head(0, 1, 1, 1) + qb_matrix({2, 3, 1}, {0, 0, 0}) +
                        bytes_of_all(2u, 7u, 0xFF000000u, 6u);
    EXPECT_THAT(refusal("c.qb", wrong), HasSubstr("more cells than its matrix"));
    EXPECT_THAT(refusal("d.qb", qb_head(0, 1, 1, 1) + qb_matrix({60000, 60000, 60000}, {0, 0, 0})),
                HasSubstr("truncated"));
    EXPECT_THAT(refusal("e.qb", qb_head(0, 1, 0, 0)), HasSubstr("no voxels"));
    EXPECT_THAT(refusal("f.qb", qb_head(9, 1, 0, 0)), HasSubstr("not a Qubicle file"));
}

TEST_F(VoxelArtTest, Kv6HasZDown) {
    // 2 x 3 x 9 voxels: two in column (0, 1), one in column (1, 2).
    std::string bytes = "Kvxl" + bytes_of_all(2, 3, 9, 1.0f, 1.5f, 4.5f, 3);
    for (const auto& [z, color] :
         {std::pair{4, "\x10\x20\x30"}, {8, "\x40\x50\x60"}, {0, "\1\2\3"}})
        bytes += color + std::string("\x80") + bytes_of_all(uint16_t(z)) + "\x3f\x11";
    bytes += bytes_of_all(2, 1, uint16_t{0}, uint16_t{2}, uint16_t{0}, uint16_t{0}, uint16_t{0},
                          uint16_t{1});
    const VoxelCells expected = {
        {{0, 4, 1}, {0x102030, ""}}, {{0, 0, 1}, {0x405060, ""}}, {{1, 8, 2}, {0x010203, ""}}};
    EXPECT_EQ(cells("a.kv6", bytes), expected);
    expect_truncations_refused("a.kv6", bytes, bytes.size());
}

TEST_F(VoxelArtTest, BinvoxHasYFastestAndAPlace) {
    const std::string head = "#binvox 1\ndim 4 4 4\ntranslate 1 -2 0.5\nscale 8\ndata\n";
    // Cells 1 to 3 are y 1 to 3 of (0, ., 0); cell 20 is (1, 0, 1).
    std::string bytes = head;
    for (const int c : {0, 1, 1, 3, 0, 16, 1, 1, 0, 43}) bytes += char(c);
    const VoxelModel model = read_voxel_model(put("a.binvox", bytes), Surface::cubes);
    EXPECT_EQ(model.frame.voxel_edge, glm::dvec3(2));
    VoxelModel unit = model;
    unit.frame.voxel_edge = glm::dvec3(1);
    unit.frame.origin = (model.frame.origin - glm::dvec3(1, -2, 0.5)) / 2.0;
    EXPECT_EQ(cells_of(unit),
              (VoxelCells{{{0, 1, 0}, {}}, {{0, 2, 0}, {}}, {{0, 3, 0}, {}}, {{1, 0, 1}, {}}}));
    expect_truncations_refused("a.binvox", bytes, bytes.size());
    EXPECT_THAT(refusal("e.binvox", "#binvox 1\ndim 1 1 1\nscale 1e-200\ndata\n\1\1"),
                HasSubstr("at least 1e-09 m"));
    EXPECT_THAT(refusal("b.binvox", head + "\1\xff"), HasSubstr("more cells than its size"));
    EXPECT_THAT(refusal("c.binvox", "#binvox 1\ndim 99999 9 9\nscale 1\ndata\n"),
                HasSubstr("at most 65536"));
    EXPECT_THAT(refusal("d.binvox", "#binvox 1\ndim four\n"), HasSubstr("no number"));
}

TEST_F(VoxelArtTest, GoxelLayersHaveZUpAndMayBeHidden) {
    // A block as a PNG of 64 x 64 pixels, made by our writer: a voxel at (3, 2, 1), red, one green.
    Image image;
    image.width = image.height = 64;
    std::vector<float> red(64 * 64), green(64 * 64), blue(64 * 64), alpha(64 * 64);
    const size_t index = 3 + 16 * 2 + 256 * 1;
    red[index] = alpha[index] = 1;
    green[0] = alpha[0] = 1;
    image.planes["R"] = red;
    image.planes["G"] = green;
    image.planes["B"] = blue;
    image.planes["A"] = alpha;
    write_png(folder / "block.png", image, {.keep_alpha = true});
    const auto chunk = [](const std::string& letters, const std::string& content) {
        return letters + bytes_of_all(int32_t(content.size())) + content + bytes_of_all(0);
    };
    const auto layer = [&](int x, int y, int z, char visible) {
        return chunk("LAYR", bytes_of_all(1, 0, x, y, z, 0) + bytes_of_all(7) + "visible" +
                                 bytes_of_all(1) + visible + bytes_of_all(0));
    };
    const std::string bytes = "GOX " + bytes_of_all(2) +
                              chunk("BL16", bytes_of(folder / "block.png")) + layer(0, 0, 0, 1) +
                              layer(16, -32, 48, 1) + layer(0, 0, 0, 0) + chunk("CAMR", "xx");
    const VoxelCells expected = {{{0, 0, -1}, {0x00FF00, ""}},
                                 {{3, 1, -3}, {0x0000FF, ""}},
                                 {{16, 48, 31}, {0x00FF00, ""}},
                                 {{19, 49, 29}, {0x0000FF, ""}}};
    EXPECT_EQ(cells("a.gox", bytes), expected);
    EXPECT_THAT(read_gox(folder / "a.gox").notes, Contains("1 hidden layers, not shown"));
    EXPECT_THAT(refusal("b.gox", "GOX " + bytes_of_all(2) + layer(0, 0, 0, 1)),
                HasSubstr("the file lacks"));
    // A file may end behind its first layer.
    expect_truncations_refused("a.gox", bytes, 192);
}

TEST_F(VoxelArtTest, SpongeSchematicsHaveAPaletteOfNames) {
    using W = NbtWriter;
    const std::string palette = W::compound(
        "Palette",
        W::whole("minecraft:air", int32_t{0}) + W::whole("minecraft:red_wool", int32_t{1}) +
            W::whole("minecraft:oak_log[axis=y]", int32_t{300}) + W::whole("mod:zzyx", int32_t{2}));
    const std::string size = W::whole("Width", int16_t{2}) + W::whole("Height", int16_t{1}) +
                             W::whole("Length", int16_t{3});
    // x fastest, then z. Number 300 takes two bytes: 0xAC 0x02.
    const std::string data("\1\0\xAC\2\0\0\2", 7);
    const std::string second =
        W::compound("Schematic", size + palette + W::bytes("BlockData", data));
    const VoxelCells expected = {{{0, 0, 0}, {block_color("red_wool").color, ""}},
                                 {{0, 0, 1}, {block_color("oak_log").color, ""}},
                                 {{1, 0, 2}, {block_color("zzyx").color, ""}}};
    EXPECT_EQ(cells("a.schem", gzipped(second)), expected);
    EXPECT_THAT(read_schematic(folder / "a.schem").notes,
                Contains(HasSubstr("1 kind of block has a colour made of its name: mod:zzyx")));
    const std::string third = W::compound(
        "",
        W::compound("Schematic", size + W::compound("Blocks", palette + W::bytes("Data", data))));
    EXPECT_EQ(cells("b.schem", gzipped(third)), expected);
    EXPECT_EQ(cells("plain.schem", third), expected);
    // Zeros that fill a block of a tape up are no data.
    EXPECT_EQ(cells("padded.schem", gzipped(third) + std::string(512, '\0')), expected);
    expect_truncations_refused("plain.schem", third, third.size());
    const std::string wrong = W::compound(
        "Schematic", size + palette + W::bytes("BlockData", std::string("\xAD\2\0\0\0\0\0", 7)));
    EXPECT_THAT(refusal("c.schem", wrong), HasSubstr("isn't in the palette"));
}

TEST_F(VoxelArtTest, OldSchematicsHaveNumbersAndData) {
    using W = NbtWriter;
    const std::string bytes =
        W::compound("Schematic", W::whole("Width", int16_t{3}) + W::whole("Height", int16_t{2}) +
                                     W::whole("Length", int16_t{1}) +
                                     W::bytes("Blocks", std::string("\1\0\x23\x23\0\xFE", 6)) +
                                     W::bytes("Data", std::string("\0\0\x0E\3\0\0", 6)));
    const VoxelCells expected = {{{0, 0, 0}, {block_color("stone").color, ""}},
                                 {{2, 0, 0}, {block_color("red_wool").color, ""}},
                                 {{0, 1, 0}, {block_color("light_blue_wool").color, ""}},
                                 {{2, 1, 0}, {block_color("block 254").color, ""}}};
    EXPECT_EQ(cells("a.schematic", gzipped(bytes)), expected);
    EXPECT_THAT(read_schematic(folder / "a.schematic").notes, Contains(HasSubstr("block 254")));
}

TEST_F(VoxelArtTest, LitematicNumbersStraddleLongs) {
    using W = NbtWriter;
    const auto xyz = [](const std::string& name, int x, int y, int z) {
        return W::compound(name, W::whole("x", int32_t(x)) + W::whole("y", int32_t(y)) +
                                     W::whole("z", int32_t(z)));
    };
    const std::vector<std::string> names = {"air", "stone", "dirt", "sand", "gold_block"};
    std::vector<std::string> palette;
    for (const std::string& name : names) palette.push_back(W::words("Name", "minecraft:" + name));
    // 3 bits each: cell 21 begins at bit 63.
    std::vector<uint64_t> longs(2);
    const auto put_number = [&](size_t cell, uint64_t number) {
        longs[cell * 3 / 64] |= number << cell * 3 % 64;
        if (cell * 3 % 64 > 61) longs[cell * 3 / 64 + 1] |= number >> (64 - cell * 3 % 64);
    };
    put_number(0, 1);
    put_number(21, 4);
    put_number(29, 3);
    const auto region = [&](const std::string& name, int sign, int at) {
        return W::compound(name, xyz("Position", at, 0, 0) + xyz("Size", sign * 5, 2, 3) +
                                     W::compounds("BlockStatePalette", palette) +
                                     W::longs("BlockStates", longs));
    };
    const auto file = [&](const std::string& regions) {
        return gzipped(W::compound("", W::compound("Regions", regions)));
    };
    // Cell 21 is x 1, z 1, y 1 of 5 x 2 x 3; cell 29 is x 4, z 2, y 1.
    const VoxelCells expected = {{{0, 0, 0}, {block_color("stone").color, ""}},
                                 {{1, 1, 1}, {block_color("gold_block").color, ""}},
                                 {{4, 1, 2}, {block_color("sand").color, ""}}};
    EXPECT_EQ(cells("a.litematic", file(region("one", 1, 7))), expected);
    // A region of negative size ends at its position: both lie in the same place.
    EXPECT_EQ(cells("b.litematic", file(region("one", 1, 7) + region("two", -1, 11))), expected);
    EXPECT_THAT(read_schematic(folder / "b.litematic").notes, Contains("2 regions, shown as one"));
    longs.resize(1);
    EXPECT_THAT(refusal("c.litematic", file(region("one", 1, 7))), HasSubstr("fewer blocks"));
}

TEST_F(VoxelArtTest, DeepAndEndlessTagsAreRefused) {
    using W = NbtWriter;
    std::string deep = "\x0a" + W::text("");
    for (int i = 0; i < 100; ++i) deep += "\x0a" + W::text("a");
    EXPECT_THAT(refusal("a.schem", deep), HasSubstr("deeper than 64 levels"));
    EXPECT_THAT(refusal("b.schem", "\x0a" + W::text("") + "\x09" + W::text("a") + "\1" +
                                       W::big(int32_t{2'000'000}) + std::string(2'000'000, 'x')),
                HasSubstr("more than 1000000 values"));
    EXPECT_THAT(refusal("c.schem",
                        "\x0a" + W::text("") + "\x07" + W::text("a") + W::big(int32_t{0x7FFFFFFF})),
                HasSubstr("more than the file holds"));
    EXPECT_THAT(refusal("d.schem", std::string("\x1f\x8b\x08\0\0\0\0\0\0\3xyz", 13)),
                HasSubstr("truncated"));
}

TEST_F(VoxelArtTest, BlocksHaveColoursByTheLongestPartOfTheirName) {
    EXPECT_EQ(block_color("minecraft:light_blue_wool").color,
              block_color("light_blue_carpet").color);
    EXPECT_NE(block_color("light_blue_wool").color, block_color("blue_wool").color);
    EXPECT_NE(block_color("red_sandstone").color, block_color("sandstone").color);
    EXPECT_NE(block_color("dark_oak_planks").color, block_color("oak_planks").color);
    EXPECT_GT(block_color("white_stained_glass").color >> 24, 100u);
    EXPECT_EQ(block_color("stone").color >> 24, 0u);
    EXPECT_TRUE(block_color("minecraft:cave_air").is_air);
    EXPECT_FALSE(block_color("mod:zzyx").is_known);
    EXPECT_EQ(block_color("mod:zzyx").color, block_color("other:zzyx[a=b]").color);
}

TEST_F(VoxelArtTest, VoxelsAloneHaveNoValuesAndNoSmoothSurface) {
    const auto file = put(
        "a.qb", qb_head(0, 1, 0, 1) + qb_matrix({1, 1, 1}, {0, 0, 0}) + bytes_of_all(0xFF010203u));
    EXPECT_THAT(error_of([&] { read_voxel_model(file, Surface::smooth); }).what(),
                HasSubstr("\"cubes\""));
    VoxelValues values;
    values.label = 3;
    EXPECT_THAT(error_of([&] { read_voxel_model(file, Surface::cubes, 0, values); }).what(),
                HasSubstr("leave out"));
}

}  // namespace voxelume
