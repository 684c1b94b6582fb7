// SPDX-License-Identifier: Apache-2.0
// Scenes of MagicaVoxel files: materials, animations, and worlds far larger than their models.
#include <gmock/gmock.h>

#include <algorithm>
#include <map>

#include "runtime/assets/voxel_model_file.hpp"
#include "runtime/io/voxels/vox_voxels.hpp"
#include "runtime/scene/scene_animation.hpp"
#include "tests/support/vox_fixture.hpp"
#include "tests/support/writers/lighthouse_vox.hpp"

namespace voxelume {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

class VoxSceneTest : public VoxFileTest {};

TEST_F(VoxSceneTest, FramesAndKeyframesBecomeAnAnimation) {
    const VoxSample sample;
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

TEST_F(VoxSceneTest, MaterialsOfBothKindsAreGroupsAndMaterialsOfTheScene) {
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
    EXPECT_DOUBLE_EQ(material("metal 2").metallic.value(), 0.8);
    EXPECT_DOUBLE_EQ(material("metal 2").roughness.value(), 0.1);
    EXPECT_GT(whitted_material(material("metal 2")).reflection, 0.3f);
    EXPECT_FLOAT_EQ(material("glass 3").ior, 1.4f);
    EXPECT_FLOAT_EQ(material("glass 3").refraction, 0.75f);
    EXPECT_TRUE(material("glass 3").fresnel);
    EXPECT_FLOAT_EQ(material("glass 5").ior, 1.5f);
    EXPECT_FLOAT_EQ(material("glass 5").refraction, 0.6f);
    EXPECT_GT(material("emit 4").emission.g, 0.5f);
    EXPECT_THAT(scene_of_file(file, "a.vox", {}, assets), Not(HasSubstr("glass 9")));
    ASSERT_EQ(scene.objects[0].groups.size(), 4u);
}

TEST_F(VoxSceneTest, OfAnotherSizeIsTheSameSceneInOtherMetres) {
    VoxWriter writer;
    writer.model({4, 1, 1}, {{0, 0, 0, 1}, {3, 0, 0, 2}});
    writer.transform(0, 1, 0, {}, {{}});
    writer.group(1, {2, 4});
    writer.transform(2, 3, 0, {}, {{{"_t", "3 2 1"}}, {{"_f", "5"}, {"_t", "-9 0 7"}}});
    writer.shape(3, {{0, {}}});
    writer.transform(4, 5, 0, {}, {{{"_t", "0 0 20"}, {"_r", "20"}}});
    writer.shape(5, {{0, {}}});
    writer.chunk("rCAM", VoxWriter::number(0) + VoxWriter::dictionary({{"_mode", "pers"},
                                                                       {"_focus", "1 2 3"},
                                                                       {"_angle", "10 20 0"},
                                                                       {"_radius", "40"}}));
    const auto file = put(writer.bytes());
    AssetStore assets;
    const Scene own = scene_of(file, assets);
    ImportOptions sized;
    sized.fit = 2;
    const Scene small = scene_of(file, assets, sized);
    const double scale = small.world.voxel_size.x;
    EXPECT_GT(scale, 0.05);
    EXPECT_LT(scale, 0.12);
    ASSERT_EQ(own.animation.frames, 6);
    ASSERT_EQ(small.objects.size(), own.objects.size());
    for (const int frame : {1, 6}) {
        const Scene a = scene_at(own, frame), b = scene_at(small, frame);
        for (size_t i = 0; i < a.objects.size(); ++i) {
            if (own.models[size_t(own.objects[i].model)].solid) continue;
            for (int column = 0; column < 4; ++column)
                EXPECT_LT(glm::length(glm::dvec3(b.objects[i].world_from_object[column]) -
                                      scale * glm::dvec3(a.objects[i].world_from_object[column])),
                          1e-9)
                    << frame << " " << i << " " << column;
        }
        EXPECT_LT(glm::length(b.observer.position - scale * a.observer.position), 1e-5);
    }
}

// A blend is a mixture of metal, glass and what is matt.
TEST_F(VoxSceneTest, BlendsLetLightThroughAsFarAsTheySay) {
    VoxWriter writer;
    writer.model({3, 1, 1}, {{0, 0, 0, 1}, {1, 0, 0, 2}, {2, 0, 0, 3}});
    writer.palette(odd_palette());
    writer.material(2,
                    {{"_type", "_blend"}, {"_metal", "0.25"}, {"_trans", "0.5"}, {"_ri", "1.4"}});
    writer.material(3, {{"_type", "_blend"}, {"_metal", "0.75"}, {"_weight", "0.9"}});
    const auto file = put(writer.bytes());
    AssetStore assets;
    const Scene scene = scene_of(file, assets);
    const auto material = [&](const std::string& name) {
        return *std::ranges::find(scene.materials, name, &Material::name);
    };
    EXPECT_DOUBLE_EQ(material("blend 2").metallic.value(), 0.25);
    EXPECT_DOUBLE_EQ(material("blend 2").transmission.value(), 0.5);
    EXPECT_FLOAT_EQ(material("blend 2").ior, 1.4f);
    EXPECT_NE(material("blend 2").absorption, glm::vec3(0));
    ImportOptions sized;
    sized.fit = 0.3;  // of three voxels
    const Scene small = scene_of(file, assets, sized);
    const auto glass = std::ranges::find(small.materials, "blend 2", &Material::name);
    ASSERT_NE(glass, small.materials.end());
    for (int c = 0; c < 3; ++c)  // three digits
        EXPECT_NEAR(glass->absorption[c], 10 * material("blend 2").absorption[c],
                    0.01f * glass->absorption[c]);
    EXPECT_DOUBLE_EQ(material("blend 3").metallic.value(), 0.75);
    EXPECT_EQ(material("blend 3").transmission.value_or(0), 0);
    EXPECT_THAT(scene_of_file(file, "a.vox", {}, assets), HasSubstr("\"shadow\": \"filtered\""));
}

// Faces within media aren't seen, as those within glass; those that scatter have a matt surface.
TEST_F(VoxSceneTest, MediaAreBodiesThatAreClearWhereTheyAbsorb) {
    VoxWriter writer;
    writer.model({4, 1, 1}, {{0, 0, 0, 1}, {1, 0, 0, 2}, {2, 0, 0, 3}, {3, 0, 0, 4}});
    std::array<uint32_t, 256> palette = odd_palette();
    palette[1] = palette[2] = palette[4] = 0xFF4080FFu;
    palette[3] = 0xFFFFFFFFu;
    writer.palette(palette);
    writer.material(1, {{"_type", "_media"}, {"_d", "0.25"}});
    writer.material(2, {{"_type", "_media"}, {"_d", "0.25"}, {"_media_type", "_scatter"}});
    writer.material(3, {{"_type", "_media"}, {"_d", "0.25"}, {"_media_type", "_absorb"}});
    writer.material(4, {{"_type", "_cloud"}, {"_d", "0.25"}});
    AssetStore assets;
    const Scene scene = scene_of(put(writer.bytes()), assets);
    const auto material = [&](const std::string& name) {
        return *std::ranges::find(scene.materials, name, &Material::name);
    };
    EXPECT_EQ(material("media 1").refraction, 1);
    EXPECT_EQ(material("media 1").ior, 1);
    EXPECT_EQ(material("media 1").opacity, 1);
    // Red 1 passes, and of linear green 0.2159 and blue 0.0513 log(1 / x) (1/8 + 1/4) is absorbed.
    EXPECT_NEAR(material("media 1").absorption.r, 0, 1e-3);
    EXPECT_NEAR(material("media 1").absorption.g, 0.575, 2e-3);
    EXPECT_NEAR(material("media 1").absorption.b, 1.114, 5e-3);  // three digits are written
    // The ground touches nothing, or rays out of a clear body pass through it here and there.
    const Object& ground = *std::ranges::find(scene.objects, "ground", &Object::name);
    EXPECT_NEAR(ground.world_from_object[3].y + 0.000488 / 2, -0.01, 1e-9);
    for (const char* name : {"media 2", "media 3", "media 4"}) {
        EXPECT_FLOAT_EQ(material(name).diffuse, 0.4f) << name;
        EXPECT_FLOAT_EQ(material(name).refraction, 0.6f) << name;
        EXPECT_EQ(material(name).ior, 1) << name;
        EXPECT_EQ(material(name).opacity, 1) << name;
    }
}

TEST_F(VoxSceneTest, WorldsThatAreFarLargerThanTheirModelsWorkOrAreRefused) {
    const auto far_apart = [&](int distance) {
        VoxWriter writer;
        writer.model({3, 3, 3}, {{0, 0, 0, 1}, {2, 2, 2, 9}});
        writer.transform(0, 1, -1, {}, {{}});
        writer.group(1, {2, 3});
        writer.shape(2, {{0, {}}});
        writer.transform(3, 2, 0, {}, {{{"_t", fmt::format("{0} {0} 0", distance)}}});
        return put(writer.bytes());
    };
    AssetStore near, far, farther;
    EXPECT_EQ(scene_of(far_apart(3000), near).objects.size(), 3u);
    // There is no room for a ground.
    EXPECT_EQ(scene_of(far_apart(40000), far).objects.size(), 2u);
    const auto file = far_apart(900000);
    const Error error = error_of([&] { scene_of(file, farther); });
    EXPECT_EQ(error.kind(), ErrorKind::limit);
    EXPECT_THAT(error.what(), HasSubstr("are more than 65536"));
}

TEST_F(VoxSceneTest, TheShippedLighthouseIsTheOneThatIsWrittenHere) {
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
    // Models without special materials have no groups, the whole file has some.
    const auto colors_of = [](const VoxelCells& cells) {
        std::map<std::array<int, 3>, uint32_t> colors;
        for (const auto& [cell, shown] : cells) colors[cell] = shown.color;
        return colors;
    };
    EXPECT_TRUE(colors_of(shown_cells(file)) ==
                colors_of(cells_of(read_voxel_model(file, Surface::cubes))));
}

}  // namespace voxelume
