// SPDX-License-Identifier: Apache-2.0
// MagicaVoxel files: positions and palette entries voxel by voxel.
#include <gmock/gmock.h>

#include <random>

#include "runtime/assets/voxel_model_file.hpp"
#include "runtime/io/voxels/vox_voxels.hpp"
#include "tests/support/vox_fixture.hpp"

namespace voxelume {

using testing::ElementsAre;
using testing::HasSubstr;

class VoxTest : public VoxFileTest {};

TEST_F(VoxTest, ASingleModelStandsOnTheGroundWithTheDefaultPalette) {
    VoxWriter writer;
    writer.model({3, 2, 4}, {{0, 0, 0, 1}, {2, 1, 3, 255}, {2, 0, 3, 216}, {0, 1, 2, 0}});
    const VoxelModel model = read_voxel_model(put(writer.bytes()), Surface::cubes);
    // Worked out by hand: the model's middle corner is (1, 1, 2), and its foot lies at 0.
    const VoxelCells expected = {
        {{-1, 0, 0}, {0xFFFFFF, ""}}, {{1, 3, -1}, {0x111111, ""}}, {{1, 3, 0}, {0x0000EE, ""}}};
    EXPECT_EQ(cells_of(model), expected);
    EXPECT_EQ(shown_cells(folder / "a.vox"), expected);
    EXPECT_EQ(default_vox_palette()[2], 0xFFCCFFFFu);
    EXPECT_EQ(default_vox_palette()[36], 0xFF0000FFu);
    EXPECT_EQ(default_vox_palette()[37], 0xFFFFFFCCu);
    EXPECT_EQ(default_vox_palette()[215], 0xFF330000u);
    EXPECT_EQ(default_vox_palette()[255], 0xFF111111u);
}

TEST_F(VoxTest, AllRotationsAndMirrorsArePlacedVoxelByVoxel) {
    const std::vector<int> rotations = all_rotations();
    ASSERT_EQ(rotations.size(), 48u);
    const std::array<uint32_t, 256> colors = odd_palette();
    for (const std::array<int, 3>& size : {std::array{7, 4, 3}, {8, 5, 6}}) {
        VoxSample sample;
        sample.size = size;
        VoxWriter writer;
        writer.model(sample.size, sample.voxels);
        writer.palette(colors);
        VoxelCells expected;
        std::vector<int> children;
        writer.transform(0, 1, -1, {}, {{}});
        for (size_t i = 0; i < rotations.size(); ++i) {
            const glm::dvec3 t(20 * double(i % 8) - 60, 20 * double(i / 8) - 50, double(i) - 7);
            children.push_back(int(2 + 2 * i));
            writer.transform(int(2 + 2 * i), int(3 + 2 * i), 0, {},
                             {{{"_r", std::to_string(rotations[i])}, {"_t", text_of(t)}}});
            writer.shape(int(3 + 2 * i), {{0, {}}});
            add_oracle(sample, oracle_matrix(rotations[i], t), colors, expected);
        }
        writer.group(1, children);
        const auto file = put(writer.bytes(200));
        ASSERT_EQ(expected.size(), 48 * sample.voxels.size());
        EXPECT_EQ(cells_of(read_voxel_model(file, Surface::cubes)), expected);
        EXPECT_EQ(shown_cells(file), expected);
    }
}

TEST_F(VoxTest, NestedGroupsComposeAsMatricesDo) {
    std::mt19937 random(7);
    const std::vector<int> rotations = all_rotations();
    const std::array<uint32_t, 256> colors = odd_palette();
    for (int round = 0; round < 20; ++round) {
        const VoxSample sample;
        VoxWriter writer;
        writer.model(sample.size, sample.voxels);
        writer.palette(colors);
        // A chain of transforms and groups with a shape at every level.
        glm::dmat4 map(1);
        VoxelCells expected;
        int node = 0;
        for (int level = 0; level < 4; ++level) {
            const int byte = rotations[random() % rotations.size()];
            const glm::dvec3 t(int(random() % 41) - 20, int(random() % 41) - 20,
                               int(random() % 41) - 20);
            writer.transform(node, node + 1, -1, {},
                             {{{"_r", std::to_string(byte)}, {"_t", text_of(t)}}});
            map = map * oracle_matrix(byte, t);
            const bool is_last = level == 3;
            writer.group(node + 1,
                         is_last ? std::vector{node + 2} : std::vector{node + 2, node + 3});
            writer.shape(node + 2, {{0, {}}});
            add_oracle(sample, map, colors, expected);
            node += 3;
        }
        const auto file = put(writer.bytes());
        EXPECT_EQ(cells_of(read_voxel_model(file, Surface::cubes)), expected) << "round " << round;
        EXPECT_EQ(shown_cells(file), expected) << "round " << round;
    }
}

TEST_F(VoxTest, HiddenNodesAndLayersAreThereButNotShown) {
    const VoxSample sample;
    VoxWriter writer;
    writer.model(sample.size, sample.voxels);
    writer.transform(0, 1, -1, {}, {{}});
    writer.group(1, {2, 4, 6, 8});
    writer.transform(2, 3, 0, {{"_name", "shown"}}, {{{"_t", "1 2 3"}}});
    writer.shape(3, {{0, {}}});
    writer.transform(4, 5, 0, {{"_name", "hidden"}, {"_hidden", "1"}}, {{{"_t", "30 0 0"}}});
    writer.shape(5, {{0, {}}});
    writer.transform(6, 7, 5, {{"_name", "by layer"}}, {{{"_t", "60 0 0"}}});
    writer.shape(7, {{0, {}}});
    writer.transform(8, 9, 0, {{"_hidden", "1"}}, {{}});
    writer.group(9, {10});
    writer.transform(10, 11, 0, {{"_name", "shown"}}, {{{"_t", "90 0 0"}}});
    writer.shape(11, {{0, {}}});
    writer.layer(0, {{"_name", "here"}});
    writer.layer(5, {{"_hidden", "1"}});
    const auto file = put(writer.bytes());
    VoxelCells expected;
    add_oracle(sample, oracle_matrix(4, {1, 2, 3}), default_vox_palette(), expected);
    EXPECT_EQ(cells_of(read_voxel_model(file, Surface::cubes)), expected);
    EXPECT_EQ(shown_cells(file), expected);
    const VoxFile vox = read_vox_file(file);
    EXPECT_EQ(vox.layers, 2);
    EXPECT_EQ(vox.hidden_layers, 1);
    AssetStore assets;
    std::vector<std::string> names;
    for (const Object& object : scene_of(file, assets).objects) names.push_back(object.name);
    EXPECT_THAT(names, ElementsAre("shown", "hidden", "by layer", "shown 2", "ground"));
}

TEST_F(VoxTest, AModelThatIsUsedOftenIsOneModelOfTheScene) {
    const VoxSample sample;
    VoxWriter writer;
    for (int i = 0; i < 3; ++i) writer.model(sample.size, sample.voxels);
    writer.transform(0, 1, -1, {}, {{}});
    std::vector<int> children;
    for (int i = 0; i < 10; ++i) {
        children.push_back(2 + i);
        writer.transform(2 + i, 20 + i % 2, 0, {}, {{{"_t", fmt::format("{} 0 0", 9 * i)}}});
    }
    writer.group(1, children);
    writer.shape(20, {{0, {}}});
    writer.shape(21, {{2, {}}});
    const auto file = put(writer.bytes());
    AssetStore assets;
    const Scene scene = scene_of(file, assets);
    EXPECT_EQ(scene.models.size(), 3u);  // two and the ground
    EXPECT_EQ(scene.objects.size(), 11u);
    EXPECT_EQ(scene.models[1].part, 3);
    EXPECT_EQ(assets.meshes_read(), 2u);
}

TEST_F(VoxTest, OfObjectsThatOverlapTheEarlierOneIsSeen) {
    VoxWriter writer;
    writer.model({1, 1, 1}, {{0, 0, 0, 10}});
    writer.model({1, 1, 1}, {{0, 0, 0, 20}});
    writer.transform(0, 1, -1, {}, {{}});
    writer.group(1, {2, 3});
    writer.shape(2, {{1, {}}});
    writer.shape(3, {{0, {}}});
    const auto file = put(writer.bytes());
    const VoxelCells cells = cells_of(read_voxel_model(file, Surface::cubes));
    ASSERT_EQ(cells.size(), 1u);
    EXPECT_EQ(cells.begin()->second.color, default_vox_palette()[20] & 0xFFFFFF);
    EXPECT_EQ(shown_cells(file), cells);
}

// Rows that cross bricks, in files that list them along and against every axis, or in no order.
TEST_F(VoxTest, TheOrderOfVoxelsInAFileChangesNothing) {
    VoxSample sample;
    sample.size = {37, 21, 35};
    sample.voxels.clear();
    for (int x = 0; x < 37; ++x)
        for (int y = 0; y < 21; ++y)
            for (int z = 0; z < 35; ++z)
                if ((x * 7 + y * 3 + z * 5) % 11 < 8)
                    sample.voxels.push_back({uint8_t(x), uint8_t(y), uint8_t(z),
                                             uint8_t(1 + (x * 31 + y * 17 + z * 5) % 255)});
    const int byte = 2 | 0 << 2 | 1 << 4 | 1 << 6;  // axes swapped and mirrored
    VoxelCells expected;
    add_oracle(sample, oracle_matrix(byte, {5, -3, 2}), odd_palette(), expected);
    std::mt19937 random(3);
    for (int order = 0; order < 7; ++order) {
        const size_t axis = size_t(order / 2);
        std::ranges::shuffle(sample.voxels, random);
        if (axis < 3)
            std::ranges::sort(sample.voxels, [&](const auto& a, const auto& b) {
                const auto key = [&](const VoxWriter::Voxel& v) {
                    return std::tuple(v[(axis + 2) % 3], v[(axis + 1) % 3], v[axis]);
                };
                return order % 2 == 0 ? key(a) < key(b) : key(b) < key(a);
            });
        VoxWriter writer;
        writer.model(sample.size, sample.voxels);
        writer.palette(odd_palette());
        writer.transform(0, 1, -1, {}, {{{"_r", std::to_string(byte)}, {"_t", "5 -3 2"}}});
        writer.shape(1, {{0, {}}});
        EXPECT_TRUE(cells_of(read_voxel_model(put(writer.bytes()), Surface::cubes)) == expected)
            << "order " << order;
    }
}

// Threads share the voxels of a large model.
TEST_F(VoxTest, OfManyVoxelsThatShareACellTheLastOneCounts) {
    constexpr int kSide = 81;  // more cells than one thread takes
    std::mt19937 random(11);
    std::vector<VoxWriter::Voxel> voxels;
    for (int x = 0; x < kSide; ++x)
        for (int y = 0; y < kSide; ++y)
            for (int z = 0; z < kSide; ++z)
                voxels.push_back({uint8_t(x), uint8_t(y), uint8_t(z), uint8_t(random())});
    std::ranges::shuffle(voxels, random);
    const std::array<uint32_t, 256> colors = odd_palette();
    for (const bool is_shared : {false, true}) {
        // The last voxels of the list lie in cells of the first ones.
        for (size_t i = 0; is_shared && i < 4000; ++i)
            voxels[voxels.size() - 1 - i] = {voxels[i][0], voxels[i][1], voxels[i][2],
                                             uint8_t(random())};
        VoxelCells expected;
        for (const auto& [x, y, z, index] : voxels)
            if (index != 0)
                expected[{x - kSide / 2, z, kSide / 2 - 1 - y}] = {colors[index] & 0xFFFFFF, ""};
        VoxWriter writer;
        writer.model({kSide, kSide, kSide}, voxels);
        writer.palette(colors);
        EXPECT_TRUE(cells_of(read_voxel_model(put(writer.bytes()), Surface::cubes)) == expected)
            << is_shared;
    }
}

TEST_F(VoxTest, PartsLieAroundTheirMiddleCorner) {
    const VoxSample sample;
    VoxWriter writer;
    writer.model({1, 1, 1}, {{0, 0, 0, 9}});
    writer.model(sample.size, sample.voxels);
    const auto file = put(writer.bytes());
    VoxelCells expected;
    add_oracle(sample, glm::dmat4(1), default_vox_palette(), expected);
    EXPECT_EQ(cells_of(read_voxel_model(file, Surface::cubes, 2)), expected);
    EXPECT_THAT(error_of([&] { read_voxel_model(file, Surface::cubes, 3); }).what(),
                HasSubstr("has 2 models and no part 3"));
    EXPECT_THAT(error_of([&] { read_voxel_model(file, Surface::smooth); }).what(),
                HasSubstr("cubes"));
}

}  // namespace voxelume
