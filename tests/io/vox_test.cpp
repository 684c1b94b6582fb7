// SPDX-License-Identifier: Apache-2.0
// MagicaVoxel files: positions and palette entries voxel by voxel, against an oracle that follows
// the voxels' middles through the file's matrices.
#include <gmock/gmock.h>

#include <glm/mat4x4.hpp>
#include <random>

#include "runtime/assets/asset_store.hpp"
#include "runtime/assets/voxel_model_file.hpp"
#include "runtime/import/scene_of_file.hpp"
#include "runtime/io/voxels/vox_voxels.hpp"
#include "runtime/scene_file/read_scene.hpp"
#include "tests/support/file_fixture.hpp"
#include "tests/support/lighthouse_vox.hpp"
#include "tests/support/vox_writer.hpp"
#include "tests/support/voxel_cells.hpp"

namespace voxelume {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

namespace {

using Voxel = VoxWriter::Voxel;

std::array<uint32_t, 256> odd_palette() {
    std::array<uint32_t, 256> colors{};
    for (uint32_t i = 1; i < 256; ++i)
        colors[i] = 0xFF000000 | (i * 37 & 255) << 16 | (255 - i) << 8 | (i * 91 & 255);
    return colors;
}

/// A model of 7 x 4 x 3 without any symmetry.
struct Sample {
    std::array<int, 3> size{7, 4, 3};
    std::vector<Voxel> voxels = {{0, 0, 0, 1}, {6, 0, 0, 2},  {6, 3, 0, 3},  {6, 3, 2, 4},
                                 {2, 1, 1, 5}, {3, 1, 2, 77}, {0, 3, 1, 255}};
};

/// The map of a transform with such a rotation byte, by the format's own words: bits 0-1 and 2-3
/// are the columns of the entries of the first two rows, bits 4 to 6 the signs of all three.
glm::dmat4 oracle_matrix(int byte, const glm::dvec3& translation) {
    const int first = byte & 3, second = byte >> 2 & 3;
    int third = 0;
    while (third == first || third == second) ++third;
    glm::dmat4 m(0);
    m[first][0] = byte & 16 ? -1 : 1;
    m[second][1] = byte & 32 ? -1 : 1;
    m[third][2] = byte & 64 ? -1 : 1;
    m[3] = {translation, 1};
    return m;
}

/// Adds a sample's voxels after a map, with Y up; what is there already stays.
void add_oracle(const Sample& sample, const glm::dmat4& map,
                const std::array<uint32_t, 256>& colors, VoxelCells& cells) {
    const glm::dvec3 pivot(sample.size[0] / 2, sample.size[1] / 2, sample.size[2] / 2);
    for (const Voxel& v : sample.voxels) {
        const glm::dvec3 middle(v[0] + 0.5, v[1] + 0.5, v[2] + 0.5);
        const glm::dvec3 p(map * glm::dvec4(middle - pivot, 1));
        const std::array<int, 3> cell = {int(std::floor(p.x)), int(std::floor(p.z)),
                                         int(std::floor(-p.y))};
        cells.try_emplace(cell, ShownVoxel{colors[v[3]] & 0xFFFFFF, ""});
    }
}

/// All bytes that are rotations, mirrored ones among them.
std::vector<int> all_rotations() {
    std::vector<int> bytes;
    for (int byte = 0; byte < 128; ++byte) {
        const int first = byte & 3, second = byte >> 2 & 3;
        if (first < 3 && second < 3 && first != second) bytes.push_back(byte);
    }
    return bytes;
}

std::string text_of(const glm::dvec3& t) {
    return fmt::format("{} {} {}", int(t.x), int(t.y), int(t.z));
}

}  // namespace

class VoxTest : public FileTest {
  protected:
    std::filesystem::path put(const std::string& bytes) const {
        put_bytes(folder / "a.vox", bytes);
        return folder / "a.vox";
    }

    Scene scene_of(const std::filesystem::path& file, AssetStore& assets) const {
        const std::string text = scene_of_file(file, "a.vox", {}, assets);
        return parse_scene(text, file, {}, [&](const Model& model, bool keeps) {
            return assets.box_of_file(model, keeps);
        });
    }

    /// The cells of all visible objects of the scene of a file, by their models' voxels and maps.
    VoxelCells shown_cells(const std::filesystem::path& file) const {
        AssetStore assets;
        const Scene scene = scene_of(file, assets);
        VoxelCells cells;
        for (const Object& object : scene.objects) {
            const Model& model = scene.models[size_t(object.model)];
            if (model.solid || !object.visible) continue;
            for (const auto& [cell, shown] : cells_of(assets.voxels(model))) {
                const glm::dvec4 middle(cell[0] + 0.5, cell[1] + 0.5, cell[2] + 0.5, 1);
                const glm::dvec3 p(object.world_from_object * middle);
                cells.try_emplace(
                    {int(std::floor(p.x)), int(std::floor(p.y)), int(std::floor(p.z))}, shown);
            }
        }
        return cells;
    }
};

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
        Sample sample;
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
        const Sample sample;
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
    const Sample sample;
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
    const Sample sample;
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

TEST_F(VoxTest, PartsLieAroundTheirMiddleCorner) {
    const Sample sample;
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

TEST_F(VoxTest, FramesAndKeyframesBecomeAnAnimation) {
    const Sample sample;
    VoxWriter pack;
    pack.chunk("PACK", VoxWriter::number(3));
    for (int i = 0; i < 3; ++i) pack.model({1, 1, 1 + i}, {{0, 0, uint8_t(i), 7}});
    AssetStore assets;
    const Scene frames = scene_of(put(pack.bytes()), assets);
    EXPECT_EQ(frames.animation.frames, 3);
    EXPECT_EQ(frames.objects.size(), 4u);
    EXPECT_TRUE(frames.objects[0].visible);
    EXPECT_FALSE(frames.objects[1].visible);

    VoxWriter keyed;
    keyed.model(sample.size, sample.voxels);
    keyed.transform(0, 1, -1, {{"_name", "a.b"}},
                    {{{"_f", "0"}, {"_t", "1 2 3"}}, {{"_f", "4"}, {"_t", "5 2 3"}, {"_r", "17"}}});
    keyed.shape(1, {{0, {}}});
    const auto file = put(keyed.bytes());
    AssetStore others;
    const Scene moving = scene_of(file, others);
    EXPECT_EQ(moving.animation.frames, 5);
    ASSERT_TRUE(moving.motion);
    EXPECT_EQ(read_vox_file(file).frames, 5);
    EXPECT_THAT(scene_of_file(file, "a.vox", {}, others),
                HasSubstr(R"("value": [1, 3, -2]}, {"frame": 5, "value": [5, 3, -2]})"));
}

TEST_F(VoxTest, MaterialsOfBothKindsAreGroupsAndMaterialsOfTheScene) {
    VoxWriter writer;
    writer.model(
        {6, 1, 1},
        {{0, 0, 0, 1}, {1, 0, 0, 2}, {2, 0, 0, 3}, {3, 0, 0, 4}, {4, 0, 0, 5}, {5, 0, 0, 6}});
    writer.palette(odd_palette());
    writer.material(1, {{"_type", "_diffuse"}});
    writer.material(2, {{"_type", "_metal"}, {"_metal", "0.8"}, {"_rough", "0.1"}});
    writer.material(3, {{"_type", "_glass"}, {"_trans", "0.75"}, {"_ior", "0.4"}});
    writer.material(4, {{"_type", "_emit"}, {"_emit", "0.5"}, {"_flux", "1"}});
    writer.material(9, {{"_type", "_glass"}});  // of no voxel
    const auto number = [](auto value) { return VoxWriter::number(value); };
    // Glass with roughness, index of refraction and attenuation.
    writer.chunk("MATT", number(5) + number(2) + number(0.6f) + number(2 | 8 | 16) + number(0.2f) +
                             number(0.5f) + number(0.25f));
    writer.chunk("MATT", number(6) + number(0) + number(1.0f) + number(0));
    const auto file = put(writer.bytes());
    const VoxelModel model = read_voxel_model(file, Surface::cubes, 1);
    EXPECT_THAT(model.groups, ElementsAre("diffuse", "metal 2", "glass 3", "emit 4", "glass 5"));
    const VoxelCells cells = cells_of(model);
    const char* groups[] = {"diffuse", "metal 2", "glass 3", "emit 4", "glass 5", "diffuse"};
    for (int x = 0; x < 6; ++x) {
        EXPECT_EQ(cells.at({x - 3, 0, -1}).group, groups[x]) << x;
        EXPECT_EQ(cells.at({x - 3, 0, -1}).color, odd_palette()[size_t(x + 1)] & 0xFFFFFF) << x;
    }
    AssetStore assets;
    const Scene scene = scene_of(file, assets);
    const auto material = [&](const std::string& name) {
        for (const Material& m : scene.materials)
            if (m.name == name) return m;
        ADD_FAILURE() << name;
        return Material();
    };
    EXPECT_GT(material("metal 2").reflection, 0.3f);
    EXPECT_FLOAT_EQ(material("glass 3").ior, 1.4f);
    EXPECT_FLOAT_EQ(material("glass 3").refraction, 0.75f);
    EXPECT_TRUE(material("glass 3").fresnel);
    EXPECT_FLOAT_EQ(material("glass 5").ior, 1.5f);
    EXPECT_FLOAT_EQ(material("glass 5").refraction, 0.6f);
    EXPECT_GT(material("emit 4").emission.g, 0.5f);
    EXPECT_THAT(scene_of_file(file, "a.vox", {}, assets), Not(HasSubstr("glass 9")));
    ASSERT_EQ(scene.objects[0].groups.size(), 4u);
    // With a size of its own the file is one model.
    ImportOptions sized;
    sized.fit = 3;
    const std::string whole = scene_of_file(file, "a.vox", sized, assets);
    EXPECT_THAT(whole, HasSubstr("\"fit\": 3"));
    EXPECT_THAT(whole, HasSubstr("\"materials\": {\"metal 2\": \"metal 2\""));
}

TEST_F(VoxTest, TheShippedLighthouseIsTheOneThatIsWrittenHere) {
    const std::string bytes = lighthouse_bytes();
    EXPECT_EQ(bytes_of(VXL_SOURCE_DIR "/scenes/lighthouse.vox") == bytes, true)
        << "a new one is in " << folder / "lighthouse.vox";
    const auto file = put(bytes);
    const VoxFile vox = read_vox_file(file);
    EXPECT_EQ(vox.objects.size(), 11u);
    EXPECT_EQ(
        std::ranges::count_if(vox.objects,
                              [](const VoxObject& o) { return o.poses[0].rotation.is_mirrored(); }),
        4);
    EXPECT_EQ(shown_cells(file), cells_of(read_voxel_model(file, Surface::cubes)));
}

}  // namespace voxelume
