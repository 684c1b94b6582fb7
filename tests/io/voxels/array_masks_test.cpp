// SPDX-License-Identifier: Apache-2.0
// Arrays of masks: one for each of several labels, of one channel, and of full bricks.
#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "runtime/assets/voxel_model_file.hpp"
#include "runtime/io/arrays/array_voxels.hpp"
#include "tests/support/file_fixture.hpp"
#include "tests/support/voxel_cells.hpp"
#include "tests/support/writers/array_writer.hpp"

namespace voxelume {

class ArrayMasksTest : public FileTest {
  protected:
    std::filesystem::path put(const std::string& name, const std::string& bytes) {
        put_bytes(folder / name, bytes);
        return folder / name;
    }
    VoxelModel cubes(const std::filesystem::path& file) {
        return read_voxel_model(file, Surface::cubes, 0, {});
    }
};

TEST_F(ArrayMasksTest, ColoursOfZeroAndOneAreNoneAndAllOfAColour) {
    // Masks of three labels, one behind the other: (1, 1, 3) cells, and the same with an opacity.
    const VoxelCells expected = {{{0, 0, 0}, {0x0000FF, ""}}, {{0, 0, 1}, {0xFFFF00, ""}}};
    const std::vector<uint8_t> masks = {1, 0, 0, 0, 1, 1, 0, 0, 0};
    for (const char* type : {"|u1", "|b1"})
        EXPECT_EQ(
            cells_of(cubes(put("m.npy", npy_bytes(type, "1, 1, 3, 3", bytes_of_values(masks))))),
            expected);
    EXPECT_EQ(cells_of(cubes(put("w.npy", npy_bytes("<u2", "1, 1, 3, 3",
                                                    bytes_of_values(std::vector<uint16_t>(
                                                        masks.begin(), masks.end())))))),
              expected);
    // Fortran's order has all reds first.
    const std::vector<uint8_t> planes = {1, 0, 0, 0, 1, 0, 0, 1, 0};
    EXPECT_EQ(cells_of(cubes(
                  put("f.npy", npy_bytes("|u1", "1, 1, 3, 3", bytes_of_values(planes), true)))),
              expected);
    // One number above 1, and they are colours as they are.
    const std::vector<uint8_t> colors = {1, 0, 0, 0, 1, 2, 0, 0, 0};
    EXPECT_EQ(
        cells_of(cubes(put("c.npy", npy_bytes("|u1", "1, 1, 3, 3", bytes_of_values(colors))))),
        (VoxelCells{{{0, 0, 0}, {0x000001, ""}}, {{0, 0, 1}, {0x020100, ""}}}));
}

TEST_F(ArrayMasksTest, OneChannelIsValues) {
    const std::vector<uint8_t> values = {0, 3, 3, 0};
    EXPECT_EQ(
        cells_of(cubes(put("a.npy", npy_bytes("|u1", "1, 2, 2, 1", bytes_of_values(values))))),
        (VoxelCells{{{0, 0, 1}, {}}, {{0, 1, 0}, {}}}));
}

// The codes of bytes are turned row by row, other labels cell by cell.
TEST_F(ArrayMasksTest, BytesOfAllOrdersAndDirectionsOfAxesHaveTheLabelsOfWiderNumbers) {
    std::mt19937 random(8);
    CellArray array;
    array.data = folder / "a.raw";
    array.counts = {35, 18, 17};
    std::vector<uint8_t> bytes(size_t(35) * 18 * 17);
    for (uint8_t& byte : bytes) byte = uint8_t(random() % 5);
    std::vector<uint16_t> words(bytes.begin(), bytes.end());
    const VoxelValues labels{.each_label = true};
    std::array<int, 3> order = {0, 1, 2};
    do {
        for (int signs = 0; signs < 8; ++signs) {
            array.axis = {order[0], order[1], order[2]};
            for (int i = 0; i < 3; ++i) array.sign[i] = signs >> i & 1 ? -1 : 1;
            array.type = CellType::u8;
            put("a.raw", bytes_of_values(bytes));
            VoxelModel model = cubes_of_array(array, labels);
            model.widen_colors();
            array.type = CellType::u16;
            put("a.raw", bytes_of_values(words));
            EXPECT_TRUE(cells_of(model) == cells_of(cubes_of_array(array, labels))) << signs;
        }
    } while (std::ranges::next_permutation(order).found);
}

// Bricks of 16 x 16 x 16 that are full are found at once.
TEST_F(ArrayMasksTest, FullBricksLackTheCellsThatAreNoVoxels) {
    const glm::ivec3 size(37, 48, 50);
    std::vector<uint8_t> values(size_t(size.x * size.y * size.z), 1);
    VoxelCells expected;
    for (int x = 0; x < size.x; ++x)
        for (int y = 0; y < size.y; ++y)
            for (int z = 0; z < size.z; ++z) expected[{x, y, z}] = {};
    for (const int missing : {-1, 0, 12345, 60000, int(values.size()) - 1}) {
        if (missing >= 0) {
            values[size_t(missing)] = 0;
            expected.erase({missing / (48 * 50), missing / 50 % 48, missing % 50});
        }
        EXPECT_EQ(
            cells_of(cubes(put("a.npy", npy_bytes("|u1", "37, 48, 50", bytes_of_values(values))))),
            expected);
    }
}

}  // namespace voxelume
