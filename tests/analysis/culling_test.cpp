// SPDX-License-Identifier: Apache-2.0
// Objects that no ray reaches aren't voxelized, and the image's bits are those of the scene with
// all objects.
#include "runtime/analysis/culling.hpp"

#include <gtest/gtest.h>

#include <array>
#include <random>

#include "runtime/render/volume_renderer.hpp"
#include "runtime/scene/scene_animation.hpp"
#include "runtime/scene_file/scene_parts.hpp"
#include "tests/analysis/culling_scene.hpp"

namespace voxelume {
namespace {

using culling_scene::hash_of_all;
using culling_scene::scene_of;

constexpr const char* kPointLight =  // beside the left ball
    R"({"type": "point", "position": [-3.6, 0.1, 0], "intensity": 20})";

/// The names of the objects that one picture needs.
std::string visible_names(const Scene& scene) {
    AssetStore meshes;
    const Scene shown = with_culling(scene, meshes);
    std::string names;
    for (const Object& object : shown.objects)
        if (object.potentially_visible) names += object.name + " ";
    return names;
}

/// Renders the scene with culling, and expects the bits of the image with all objects.
WorldReport expect_same_bits(const Scene& scene) {
    RenderReport report;
    EXPECT_EQ(oracle::image_hash(render(shared_device(), scene, report)), hash_of_all(scene));
    return report.world;
}

TEST(Culling, DoesNotHappenWhereRaysGoInAllDirections) {
    Scene scene = scene_of(kPointLight);
    scene.render.light = LightMode::global;
    EXPECT_EQ(visible_names(scene), "seen left right behind beyond ");
    scene.render.bounces = 0;
    EXPECT_EQ(visible_names(scene), visible_names(scene_of(kPointLight)));
    scene = scene_of();
    scene.world.sky.emplace();
    EXPECT_EQ(visible_names(scene), "seen left right behind beyond ");
    scene.render.shadows = false;
    EXPECT_EQ(visible_names(scene), "seen ");
}

/// Paths that a medium scatters leave the view, though nothing in it sends rays on.
TEST(Culling, DoesNotHappenInAScatteringMedium) {
    Scene scene = scene_of();
    scene.render.light = LightMode::global;
    scene.objects[0].visible = false;
    EXPECT_EQ(visible_names(scene), "");
    scene.world.medium.scattering = glm::vec3(0.1f);
    EXPECT_EQ(visible_names(scene), "left right behind beyond ");
}

TEST(Culling, DoesNotHappenThroughALens) {
    Scene scene = scene_of();
    EXPECT_EQ(visible_names(scene), "seen ");
    scene.observer.aperture = 0.01;
    scene.observer.focus = 2;
    EXPECT_EQ(visible_names(scene), "seen left right behind beyond ");
}

TEST(Culling, HoldsWhatAWideFilterSeesNextToTheImage) {
    Scene scene = scene_of();
    scene.objects[1].world_from_object[3] = {-1.72, 0.1, 0.5, 1};
    scene.render.size = {8, 6};
    EXPECT_EQ(visible_names(scene), "seen ");
    scene.render.samples = 64;
    scene.render.filter = {FilterShape::box, 16};
    EXPECT_EQ(visible_names(scene), "seen left right ");
    expect_same_bits(scene);
    Scene without = scene;
    without.objects[1].visible = false;
    EXPECT_NE(hash_of_all(without), hash_of_all(scene)) << "its edge is seen";
}

TEST(Culling, HappensUnderASkyThatNoRaysAreSentTo) {
    Scene scene = scene_of();
    scene.world.sky.emplace().samples = 0;
    EXPECT_EQ(visible_names(scene), "seen ");
    expect_same_bits(scene);
    scene.world.sky->kind = SkyKind::sun;
    EXPECT_EQ(visible_names(scene), "seen left right behind beyond ");
    scene.world.sky->intensity = 0;
    EXPECT_EQ(visible_names(scene), "seen ");
    expect_same_bits(scene);
}

TEST(Culling, WithoutShadowsIsWhatTheDisplaySees) {
    for (const bool lit : {false, true}) {
        Scene scene = scene_of(lit ? kPointLight : "");
        scene.render.shadows = false;
        EXPECT_EQ(visible_names(scene), "seen ");
        const WorldReport report = expect_same_bits(scene);
        EXPECT_EQ(report.voxelized, 1u);
        EXPECT_EQ(report.culled, 4u);
    }
}

TEST(Culling, GoesOnToALightThroughWhatMayStandBetween) {
    const Scene scene = scene_of(kPointLight);
    EXPECT_EQ(visible_names(scene), "seen left ");
    EXPECT_EQ(expect_same_bits(scene).voxelized, 2u);
    Scene without = scene;
    without.objects[1].visible = false;
    EXPECT_NE(hash_of_all(without), hash_of_all(scene)) << "its shadow is seen";
}

TEST(Culling, WithoutColourIsWhatTheDisplaySees) {
    for (const float refraction : {0.0f, 0.8f}) {
        Scene scene = scene_of(kPointLight);
        scene.materials[1].refraction = refraction;
        scene.materials[2].emission = {3, 2, 1};
        scene.objects[4].material = 2;
        EXPECT_NE(visible_names(scene), "seen ");
        scene.render.channels.color = false;
        EXPECT_EQ(visible_names(scene), "seen ");
        EXPECT_EQ(expect_same_bits(scene).voxelized, 1u);
    }
}

TEST(Culling, GoesOnToADistantLight) {
    const Scene scene = scene_of(R"({"type": "directional", "direction": [-1, -0.02, 0]})");
    EXPECT_EQ(visible_names(scene), "seen right ");
    EXPECT_EQ(expect_same_bits(scene).voxelized, 2u);
    Scene without = scene;
    without.objects[2].visible = false;
    EXPECT_NE(hash_of_all(without), hash_of_all(scene)) << "its shadow is seen";
}

TEST(Culling, GoesOnToEmissiveObjectsWhichAreAlwaysInIt) {
    Scene scene = scene_of();
    Material& special = scene.materials[2];
    special.emission = {3, 2, 1};
    scene.objects[4].material = 2;
    EXPECT_EQ(visible_names(scene), "seen beyond ");
    EXPECT_EQ(expect_same_bits(scene).voxelized, 2u);
    scene.objects[4].light_samples = 0;  // emissive, but without light samples
    EXPECT_EQ(visible_names(scene), "seen ");
    expect_same_bits(scene);
}

TEST(Culling, HoldsWhatCoversPartOfAnEmissiveObjectAlsoWithoutShadows) {
    for (const int cover : {1, 3}) {  // of cubes, smooth
        Scene scene = scene_of();
        scene.render.shadows = false;
        scene.materials[2].emission = {3, 2, 1};
        scene.objects[4].material = 2;
        scene.objects[4].world_from_object[3] = {1.5, 0.2, -1, 1};
        scene.objects[size_t(cover)].priority = 5;
        scene.objects[size_t(cover)].world_from_object[3] = {1.2, 0.2, -0.9, 1};
        EXPECT_EQ(visible_names(scene),
                  cover == 1 ? "seen left right beyond " : "seen right behind beyond ");
        expect_same_bits(scene);
        Scene without = scene;
        without.objects[size_t(cover)].visible = false;
        EXPECT_NE(hash_of_all(without), hash_of_all(scene))
            << "the emissive object's light samples differ";
    }
}

TEST(Culling, HoldsInstancesOutsideOfTheWorldWithTheOthers) {
    Scene scene = scene_of(kPointLight);
    for (const int i : {0, 4}) scene.objects[size_t(i)].placement = Placement::instance;
    scene.objects[4].world_from_object = glm::dmat4(300);
    scene.objects[4].world_from_object[3] = {5000, 0, 0, 1};
    EXPECT_EQ(visible_names(scene), "seen left beyond ");
    expect_same_bits(scene);
}

TEST(Culling, IsTheWholeWorldWhereASurfaceInItSendsRaysOn) {
    const auto changes = std::to_array<void (*)(Material&)>(
        {[](Material& m) { m.reflection = 0.5f; }, [](Material& m) { m.refraction = 0.5f; },
         [](Material& m) { m.opacity = 0.5f; }});
    for (const auto& change : changes) {
        Scene scene = scene_of();
        change(scene.materials[2]);
        scene.objects[3].material = 2;  // culled
        EXPECT_EQ(visible_names(scene), "seen ");
        expect_same_bits(scene);
        scene.objects[0].material = 2;
        EXPECT_EQ(visible_names(scene), "seen left right behind beyond ");
        EXPECT_EQ(expect_same_bits(scene).voxelized, 5u);
    }
    Scene scene = scene_of();
    scene.materials[1].reflection = 0.5f;
    scene.render.depth = 0;
    EXPECT_EQ(visible_names(scene), "seen ") << "reflected rays aren't followed";
}

TEST(Culling, TakesInstancesTogether) {
    Scene scene = scene_of();
    scene.objects[1].placement = scene.objects[3].placement = Placement::instance;
    EXPECT_EQ(visible_names(scene), "seen ");
    expect_same_bits(scene);
    scene.objects[0].placement = Placement::instance;
    EXPECT_EQ(visible_names(scene), "seen left behind ");
    expect_same_bits(scene);
}

TEST(Culling, OfAVolumeOfRaysIsThatOfItsDisplayAndOfALatticeTheWorld) {
    Scene scene = scene_of(kPointLight);
    RenderReport report, all;
    const Volume volume = render_volume(shared_device(), scene, report);
    const BuiltWorld world = WorldBuilder(shared_device(), false).build(scene, all.world);
    const Volume expected = render_volume(shared_device(), scene, world, all);
    EXPECT_EQ(report.world.culled, 3u);
    EXPECT_LT(report.voxels, all.voxels);
    EXPECT_FALSE(volume.indices.empty());
    EXPECT_EQ(volume.indices, expected.indices);
    EXPECT_EQ(volume.colors, expected.colors);
    EXPECT_EQ(volume.opacities, expected.opacities);
    EXPECT_EQ(volume.depths, expected.depths);
    EXPECT_EQ(volume.objects, expected.objects);
    scene.observer.display.layout = VolumeLayout::lattice;
    EXPECT_EQ(visible_names(scene), "seen left right behind beyond ");
}

TEST(Culling, NeverShowsInThePicture) {
    constexpr uint32_t kSeed = 5;
    std::mt19937 random(kSeed);
    const auto uniform = [&](double low, double high) {
        return std::uniform_real_distribution<double>(low, high)(random);
    };
    uint64_t culled = 0;
    for (int trial = 0; trial < 16; ++trial) {
        Scene scene =
            scene_of(trial % 3 == 0 ? R"({"type": "directional", "direction": [-1, -1, 0.5]})"
                                    : kPointLight);
        scene.lights[0].position = {uniform(-5, 5), uniform(-1, 3), uniform(-5, 5)};
        // Three objects are always seen, so that the kernels stay the same; the others are
        // anywhere.
        for (const size_t i : {1u, 2u}) {
            scene.objects.push_back(scene.objects[i]);
            scene.objects.back().world_from_object[3] = {0.4 * (double(i) - 1.5), 0.2, 0, 1};
        }
        for (int i = 0; i < 12; ++i) {
            Object object = scene.objects[random() % 5];
            object.world_from_object = glm::dmat4(uniform(0.25, 2));
            object.world_from_object[3] = {uniform(-4, 4), uniform(-1, 1.5), uniform(-4, 4), 1};
            scene.objects.push_back(object);
        }
        scene.objects.erase(scene.objects.begin() + 1, scene.objects.begin() + 5);
        scene.observer.position += glm::dvec3(0, 0, uniform(-1, 0.5));
        find_extents(scene);
        const WorldReport report = expect_same_bits(scene);
        EXPECT_FALSE(HasFailure()) << "seed " << kSeed << ", trial " << trial;
        culled += report.culled;
    }
    EXPECT_GT(culled, 16u * 4);
}

}  // namespace
}  // namespace voxelume
