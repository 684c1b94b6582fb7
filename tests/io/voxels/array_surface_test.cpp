// SPDX-License-Identifier: Apache-2.0
// The field of a smooth surface through an array, node by node.
#include <gmock/gmock.h>

#include <cmath>
#include <random>

#include "kernels/shared/voxel.h"
#include "runtime/io/arrays/array_voxels.hpp"
#include "runtime/io/arrays/cell_bits.hpp"
#include "tests/support/file_fixture.hpp"
#include "tests/support/writers/array_writer.hpp"

namespace voxelume {
namespace {

/// The value of a model at a node: its distance in units, or far inside or outside.
int distance_at(const VoxelModel& model, const glm::ivec3& node) {
    const glm::ivec3 bricks = model.frame.bricks(), brick = node / 16, in = node % 16;
    const uint32_t slot =
        model.slots[size_t(brick.x) + size_t(bricks.x) * size_t(brick.y + bricks.y * brick.z)];
    if (slot == kBrickInside) return -32767;
    if (slot == kBrickOutside) return 32767;
    return model.distance[slot * size_t(4096) + size_t(in.x + 16 * in.y + 256 * in.z)];
}

/// An array of numbers, and where its cells lie in the model.
struct Numbers {
    CellArray array;
    std::vector<float> values;

    float at(int x, int y, int z) const {
        return values[size_t(x) + size_t(array.counts.x) * size_t(y + array.counts.y * z)];
    }
    float at_node(const glm::ivec3& node) const {
        glm::ivec3 cell;
        for (int i = 0; i < 3; ++i) {
            const int axis = array.axis[i], count = array.counts[axis];
            cell[axis] = array.sign[i] > 0 ? node[i] - 4 : count - 1 - (node[i] - 4);
        }
        return at(cell.x, cell.y, cell.z);
    }
};

}  // namespace

using ArraySurfaceTest = FileTest;

// Axes in other orders and mirrored, rows of more than a word, and values that are no numbers.
TEST_F(ArraySurfaceTest, NodesAtTheSurfaceHaveTheirValuesAndOthersTheirSides) {
    std::mt19937 random(3);
    const std::array<glm::ivec3, 3> axes = {glm::ivec3(0, 1, 2), {2, 0, 1}, {1, 0, 2}};
    const float iso = 5;
    for (const glm::ivec3& axis : axes) {
        Numbers numbers;
        CellArray& array = numbers.array;
        array.data = folder / "a.raw";
        array.type = CellType::f32;
        array.counts = {70, 23, 19};
        array.axis = axis;
        array.sign = {random() % 2 == 0 ? 1 : -1, -1, 1};
        for (int z = 0; z < 19; ++z)
            for (int y = 0; y < 23; ++y)
                for (int x = 0; x < 70; ++x)
                    numbers.values.push_back(std::sin(0.2f * float(x)) * 9 + float(y) - float(z));
        numbers.values[3456] = NAN;
        numbers.values[5678] = INFINITY;
        put_bytes(array.data, bytes_of_values(numbers.values));

        const VoxelModel model = surface_of_array(array, {.iso = iso});
        const glm::ivec3 first(4), end = array.size() + 4;
        float steepest = 0;
        const auto for_each_pair = [&](const auto& use) {
            for (int z = first.z; z < end.z; ++z)
                for (int y = first.y; y < end.y; ++y)
                    for (int x = first.x; x < end.x; ++x)
                        for (int i = 0; i < 3; ++i) {
                            const glm::ivec3 node(x, y, z);
                            glm::ivec3 next = node;
                            if (++next[i] == end[i]) continue;
                            const float a = numbers.at_node(node), b = numbers.at_node(next);
                            if (!std::isfinite(a) || !std::isfinite(b)) continue;
                            if ((a > iso) != (b > iso)) use(node, a, next, b);
                        }
        };
        for_each_pair([&](const glm::ivec3&, float a, const glm::ivec3&, float b) {
            steepest = std::max(steepest, std::abs(a - b));
        });
        ASSERT_GT(steepest, 1);
        const auto expect_value = [&](const glm::ivec3& node, float value) {
            const float units = std::clamp((iso - value) / steepest * float(kDistanceUnitsPerVoxel),
                                           -32767.0f, 32767.0f);
            EXPECT_NEAR(float(distance_at(model, node)), units, 1)
                << node.x << ' ' << node.y << ' ' << node.z;
        };
        for_each_pair([&](const glm::ivec3& a_node, float a, const glm::ivec3& b_node, float b) {
            expect_value(a_node, a);
            expect_value(b_node, b);
        });
        for (int z = first.z; z < end.z; ++z)
            for (int y = first.y; y < end.y; ++y)
                for (int x = first.x; x < end.x; ++x)
                    ASSERT_EQ(distance_at(model, {x, y, z}) < 0,
                              numbers.at_node({x, y, z}) >
                                  iso + steepest / float(2 * kDistanceUnitsPerVoxel))
                        << x << ' ' << y << ' ' << z;
    }
}

// Bytes have a separate table; other numbers with the same value are stored alike.
TEST_F(ArraySurfaceTest, BytesStoreWhatWiderNumbersDo) {
    std::mt19937 random(6);
    CellArray array;
    array.data = folder / "a.raw";
    array.counts = {45, 19, 21};
    array.sign = {-1, 1, 1};
    array.slope = 0.75;
    array.intercept = -3;
    std::vector<int8_t> bytes(size_t(45) * 19 * 21);
    for (int8_t& byte : bytes) byte = int8_t(random());
    for (const bool is_signed : {false, true}) {
        array.type = is_signed ? CellType::i8 : CellType::u8;
        put_bytes(array.data, bytes_of_values(bytes));
        const VoxelModel model = surface_of_array(array, {.iso = 20.25});
        std::vector<int16_t> words;
        for (const int8_t byte : bytes)
            words.push_back(is_signed ? int16_t(byte) : int16_t(uint8_t(byte)));
        array.type = CellType::i16;
        put_bytes(array.data, bytes_of_values(words));
        const VoxelModel wide = surface_of_array(array, {.iso = 20.25});
        EXPECT_EQ(model.slots, wide.slots);
        EXPECT_EQ(model.distance, wide.distance);
        EXPECT_GT(std::ranges::count_if(model.distance, [](int16_t d) { return d != 32767; }),
                  9000);
    }
}

// Values close to `iso` at the end once went on through the nodes around the array, as rods.
TEST_F(ArraySurfaceTest, NothingIsNearTheSurfaceTwoNodesBeyondTheEnd) {
    std::mt19937 random(5);
    CellArray array;
    array.data = folder / "a.raw";
    array.counts = {3, 19, 21};
    std::vector<uint8_t> values(size_t(3) * 19 * 21);
    for (uint8_t& value : values) value = uint8_t(random());
    put_bytes(array.data, bytes_of_values(values));
    const VoxelModel model = surface_of_array(array, {.iso = 127.5});
    int beyond = 0;
    for (int z = 0; z < model.frame.size.z; ++z)
        for (int y = 0; y < model.frame.size.y; ++y)
            for (int x = 0; x < model.frame.size.x; ++x) {
                const glm::ivec3 node(x, y, z);
                const glm::ivec3 off =
                    glm::abs(node - glm::clamp(node, glm::ivec3(4), array.counts + 3));
                if (std::max({off.x, off.y, off.z}) < 2) continue;
                EXPECT_GE(distance_at(model, node), kDistanceUnitsPerVoxel) << x << " " << y;
                ++beyond;
            }
    EXPECT_GT(beyond, 1000);
}

TEST(CellBits, SixteenOfARowBeginAnywhere) {
    const std::array<int, 7> set = {0, 3, 17, 62, 64, 66, 99};
    CellBits bits({100, 2, 1});
    for (const int x : set) bits.row(1, 0)[x / 64] |= uint64_t{1} << x % 64;
    for (int from = 0; from < 100; ++from)
        for (int i = 0; i < 16; ++i)
            EXPECT_EQ(bits.from(from, 1, 0) >> i & 1,
                      std::ranges::count(set, from + i) > 0 ? 1u : 0u)
                << from << " " << i;
}

TEST(CellBits, CellsSpreadAlongEachAxis) {
    std::mt19937 random(4);
    for (const glm::ivec3& counts : {glm::ivec3(130, 7, 5), {64, 9, 3}, {3, 1, 12}, {40, 30, 40}}) {
        CellBits bits(counts);
        std::vector<glm::ivec3> set;
        for (int i = 0; i < 6; ++i) {
            const glm::ivec3 cell(random() % unsigned(counts.x), random() % unsigned(counts.y),
                                  random() % unsigned(counts.z));
            bits.row(cell.y, cell.z)[cell.x / 64] |= uint64_t{1} << cell.x % 64;
            set.push_back(cell);
        }
        bits.dilate(2);
        for (int z = 0; z < counts.z; ++z)
            for (int y = 0; y < counts.y; ++y)
                for (int x = 0; x < counts.x; ++x) {
                    const bool is_near = std::ranges::any_of(set, [&](const glm::ivec3& cell) {
                        return std::abs(cell.x - x) <= 2 && std::abs(cell.y - y) <= 2 &&
                               std::abs(cell.z - z) <= 2;
                    });
                    ASSERT_EQ(bits({x, y, z}), is_near) << x << ' ' << y << ' ' << z;
                }
    }
}

}  // namespace voxelume
