// SPDX-License-Identifier: Apache-2.0
// Stacks of PNG slices, which the test writes itself: values, colours, and what is refused.
#include <gmock/gmock.h>
#include <sys/stat.h>

#include <limits>
#include <map>

#include "runtime/import/scene_of_file.hpp"
#include "runtime/io/arrays/array_density.hpp"
#include "runtime/io/arrays/array_files.hpp"
#include "runtime/io/arrays/array_voxels.hpp"
#include "runtime/io/voxel_file_table.hpp"
#include "tests/support/file_fixture.hpp"
#include "tests/support/voxel_cells.hpp"
#include "tests/support/writers/png_writer.hpp"

namespace voxelume {
namespace {

using testing::HasSubstr;

/// 5 x 3 pixels of 16 bits, each of another value.
uint16_t value_in_stack(int x, int row, int slice) {
    return uint16_t(1000 * slice + 100 * row + x + 300);
}

std::string deep_slice(int slice) {
    std::vector<std::string> rows(3);
    for (int row = 0; row < 3; ++row)
        for (int x = 0; x < 5; ++x) {
            const uint16_t value = value_in_stack(x, row, slice);
            rows[size_t(row)] += {char(value >> 8), char(value)};
        }
    return png_of_rows(5, 16, 0, rows);
}

class PngStackTest : public FileTest {
  protected:
    /// Slices 8 to 11 of another stack's, and others that don't belong to it.
    std::filesystem::path deep_stack() {
        for (int slice = 0; slice < 4; ++slice)
            put_bytes(folder / fmt::format("ct{:03}.png", 8 + slice), deep_slice(slice));
        put_bytes(folder / "ct013.png", deep_slice(7));
        put_bytes(folder / "ct12.png", deep_slice(7));
        return folder / "ct008.png";
    }

    std::string refused_stack(const std::filesystem::path& file) {
        return error_of([&] { summary_of_array(read_png_stack_header(file)); }).what();
    }
};

}  // namespace

TEST_F(PngStackTest, BeginsAtTheFileAndEndsBeforeTheFirstThatIsMissing) {
    const CellArray array = read_png_stack_header(deep_stack());
    EXPECT_EQ(array.size(), glm::ivec3(5, 3, 4));
    EXPECT_EQ(array.type, CellType::u16);
    const ArraySummary summary = summary_of_array(array);
    EXPECT_EQ(summary.min, 300);
    EXPECT_EQ(summary.max, 3504);
    EXPECT_EQ(read_png_stack_header(folder / "ct010.png").size(), glm::ivec3(5, 3, 2));
    EXPECT_EQ(voxel_format_named("slice7.PNG")->name, "stack of PNG slices");
    EXPECT_EQ(voxel_format_named("picture.png"), nullptr);
}

TEST_F(PngStackTest, HasItsFirstRowAboveAndItsFirstSliceBefore) {
    const auto density = read_array_density(read_png_stack_header(deep_stack()), glm::dmat4(1));
    std::array<float, 5 * 3 * 4> values{};
    density->sample_values({0.5, 0.5, 0.5}, glm::dvec3(1), {5, 3, 4}, values);
    for (int z = 0; z < 4; ++z)
        for (int y = 0; y < 3; ++y)
            for (int x = 0; x < 5; ++x)
                EXPECT_EQ(values[size_t((z * 3 + y) * 5 + x)], value_in_stack(x, 2 - y, 3 - z));
}

TEST_F(PngStackTest, LiesAsFarApartAsItsSpacing) {
    const std::filesystem::path first = deep_stack();
    ImportOptions options;
    options.spacing = {0.5, 0.25, 2};
    AssetStore assets;
    const std::string text = scene_of_file(first, "ct008.png", options, assets);
    EXPECT_THAT(text, HasSubstr("\"scale\": [0.5, 0.25, 2]}"));
    EXPECT_THAT(text, HasSubstr("\"world\": {\"voxel_size\": [0.5, 0.25, 2]"));
    options.up = UpAxis::z;
    EXPECT_THAT(scene_of_file(first, "ct008.png", options, assets),
                HasSubstr("\"world\": {\"voxel_size\": [0.5, 2, 0.25]"));
}

TEST_F(PngStackTest, OfColoursIsCubes) {
    // The second slice has a row of red and a row of blue, the first one green between black.
    put_bytes(folder / "a1.png",
              png_of_rows(2, 8, 2, {std::string(6, '\0'), std::string("\0\xff\0\0\0\0", 6)}));
    put_bytes(folder / "a2.png", png_of_rows(2, 8, 2,
                                             {std::string("\xff\0\0\xff\0\0", 6),
                                              std::string("\0\0\xff\0\0\xff", 6)}));
    const VoxelModel model = read_voxel_file(*voxel_file_format(folder / "a1.png"),
                                             folder / "a1.png", Surface::cubes, {});
    const VoxelCells cells = cells_of(model);
    std::map<std::array<int, 3>, uint32_t> colors;
    for (const auto& [cell, shown] : cells) colors[cell] = shown.color;
    const std::map<std::array<int, 3>, uint32_t> expected = {{{0, 0, 1}, 0x00FF00},
                                                             {{0, 0, 0}, 0xFF0000},
                                                             {{1, 0, 0}, 0xFF0000},
                                                             {{0, 1, 0}, 0x0000FF},
                                                             {{1, 1, 0}, 0x0000FF}};
    EXPECT_EQ(colors, expected);
}

/// The stack ended there without a word.
TEST_F(PngStackTest, WithASliceThatIsNoPlainFileIsRefused) {
    const std::filesystem::path first = deep_stack(), third = folder / "ct010.png";
    const auto expect_named = [&] {
        EXPECT_THAT(refused_stack(first),
                    HasSubstr("ct010.png: the name of a slice, and no plain file of the folder"));
        std::filesystem::remove(third);
    };
    std::filesystem::remove(third);
    ASSERT_EQ(mkfifo(third.c_str(), 0600), 0);
    expect_named();
    std::filesystem::create_directory(third);
    expect_named();
    std::filesystem::create_symlink("nowhere", third);
    expect_named();
    EXPECT_EQ(read_png_stack_header(first).size(), glm::ivec3(5, 3, 2));
}

TEST_F(PngStackTest, ThatIsDamagedOrUnevenIsRefused) {
    const std::filesystem::path first = deep_stack();
    put_bytes(folder / "ct010.png", png_of_rows(4, 16, 0, {std::string(8, '\1')}));
    EXPECT_THAT(refused_stack(first), HasSubstr("ct010.png: is a slice of 4 x 1 pixels of 16 bits, "
                                                "and the first has 5 x 3 of 16"));
    put_bytes(folder / "ct010.png", deep_slice(2).substr(0, 60));
    EXPECT_THAT(refused_stack(first), HasSubstr("ct010.png: not a whole PNG"));
    put_bytes(first, "no picture");
    EXPECT_THAT(refused_stack(first), HasSubstr("not a whole PNG"));
    std::string huge = deep_slice(0);
    huge.replace(16, 8, big_endian(60000) + big_endian(60000));
    huge.replace(8, 25, png_chunk("IHDR", huge.substr(16, 13)));
    put_bytes(first, huge);
    EXPECT_THAT(refused_stack(first), HasSubstr("declares 60000 x 60000 pixels"));
}

}  // namespace voxelume
