// SPDX-License-Identifier: Apache-2.0
// Frames one after another: the work that each kind of change repeats, and that reuse never shows
// in images.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <glm/gtc/matrix_transform.hpp>
#include <random>
#include <set>

#include "runtime/render/renderer.hpp"
#include "runtime/scene_file/read_scene.hpp"
#include "runtime/scene_file/scene_parts.hpp"
#include "tests/oracles/image_hash.hpp"
#include "tests/support/shared_device.hpp"

namespace voxelume {
namespace {

using testing::IsEmpty;
using testing::IsSupersetOf;

constexpr const char* kScene = R"({"voxelume": 1,
"world": {"voxel_size": 0.05, "bounds": {"min": [-2, -1, -2], "max": [2, 1, 2]},
          "background": [0.2, 0.3, 0.5], "ambient": [0.1, 0.1, 0.1],
          "medium": {"absorption": [0.05, 0.02, 0.01]}},
"materials": {"red": {"color": [0.8, 0.2, 0.2]}, "blue": {"color": [0.2, 0.2, 0.8]},
              "glass": {"diffuse": 0.1, "refraction": 0.9, "ior": 1.3, "absorption": [1, 2, 3]}},
"models": {"ball": {"shape": "sphere", "radius": 0.4, "voxel_size": 0.05, "surface": "smooth"},
           "block": {"shape": "box", "size": [0.5, 0.5, 0.5], "voxel_size": 0.05,
                     "surface": "cubes", "set": "solid"},
           "floor": {"shape": "box", "size": [4, 0.2, 4], "surface": "exact"}},
"objects": [{"name": "a", "model": "ball", "material": "red", "position": [-0.9, 0, 0]},
            {"name": "b", "model": "block", "material": "blue", "position": [0.9, -0.3, 0.1]},
            {"name": "c", "model": "ball", "material": "%s", "position": [0, 0.1, -0.6]},
            {"name": "d", "model": "floor", "material": "red", "position": [0, -0.85, 0]}],
"lights": [{"type": "point", "position": [1, 3, -3], "intensity": 20}],
"observer": {"position": [0, 0.5, -5], "look_at": [0, 0, 0],
             "display": {"shape": "pyramid", "angles": [50, 40], "near": 0.5, "far": 20,
                         "voxels": [8, 8, 8]}},
"render": {"size": [64, 48], "depth": 3}})";

Scene scene_of(const std::string& material) {
    std::string text = kScene;
    text.replace(text.find("%s"), 2, material);
    return parse_scene(text, "test.json", {});
}

/// Renders frames one after another and records the kernels that each launched.
class Frames {
  public:
    explicit Frames(const Scene& first) { render(first); }

    RenderReport render(const Scene& scene) {
        shared_device().counters().launches.clear();
        RenderReport report;
        const BuiltWorld world = builder_.build(scene, report.world);
        image_ = renderer_.image(scene, world, report);
        return report;
    }
    std::set<std::string> kernels() const {
        std::set<std::string> names;
        for (const auto& [name, count] : shared_device().counters().launches) names.insert(name);
        return names;
    }
    uint64_t hash() const { return oracle::image_hash(*image_); }

  private:
    WorldBuilder builder_{shared_device()};
    Renderer renderer_{shared_device()};
    std::shared_ptr<const Image> image_;
};

uint64_t hash_alone(const Scene& scene) {
    RenderReport report;
    return oracle::image_hash(render(shared_device(), scene, report));
}

const std::set<std::string> kLight = {"add_light", "resolve_pixels", "shade_surface",
                                      "trace_shadows"};

TEST(Reuse, AStillFrameLaunchesNothing) {
    const Scene scene = scene_of("blue");
    Frames frames(scene);
    const uint64_t before = frames.hash();
    const RenderReport report = frames.render(scene);
    EXPECT_THAT(frames.kernels(), IsEmpty());
    EXPECT_TRUE(report.is_kept);
    EXPECT_EQ(report.world.change, WorldChange::none);
    EXPECT_GT(report.sight_rays, 0u) << "it tells what the image is made of";
    EXPECT_EQ(frames.hash(), before);
}

TEST(Reuse, LightsMaterialsAndTheMediumOnlyLightTheHitsAgain) {
    const Scene first = scene_of("blue");
    std::vector<std::pair<const char*, Scene>> changes(6, {"", first});
    changes[0].first = "a light's place", changes[0].second.lights[0].position.x = -1;
    changes[1].first = "a light's intensity", changes[1].second.lights[0].intensity *= 2.0f;
    changes[2].first = "a material's color", changes[2].second.materials[1].color.y = 0.7f;
    changes[3].first = "the medium", changes[3].second.world.medium.absorption.x = 0.2f;
    changes[4].first = "the background", changes[4].second.world.background.x = 0.9f;
    changes[5].first = "ambient light", changes[5].second.world.ambient.x = 0.4f;
    for (const auto& [what, scene] : changes) {
        Frames frames(first);
        const RenderReport report = frames.render(scene);
        std::set<std::string> expected = kLight;
        expected.insert({"absorb_shadows", "absorb_sight"});
        EXPECT_EQ(frames.kernels(), expected) << what;
        EXPECT_EQ(report.world.change, WorldChange::none) << what;
        EXPECT_TRUE(report.hits_are_kept) << what;
        EXPECT_EQ(frames.hash(), hash_alone(scene)) << what;
    }
}

TEST(Reuse, TheFirstLightAndTheLastOnlyLightTheHitsAgain) {
    for (const char* material : {"blue", "glass"})
        for (const bool filtered : {false, true}) {
            Scene dark = scene_of(material);
            dark.render.filtered_shadows = filtered;
            const Scene lit = dark;
            dark.lights[0].intensity = glm::vec3(0);
            Frames frames(dark);
            for (const Scene* scene : {&lit, &std::as_const(dark), &lit}) {
                const RenderReport report = frames.render(*scene);
                EXPECT_EQ(frames.kernels().contains("trace_shadows"), scene == &lit);
                EXPECT_FALSE(frames.kernels().contains("cast_sight"));
                EXPECT_TRUE(report.hits_are_kept);
                EXPECT_EQ(frames.hash(), hash_alone(*scene)) << material << ' ' << filtered;
            }
        }
}

TEST(Reuse, AnObserverThatMovesTracesAgainInTheSameWorld) {
    Scene scene = scene_of("blue");
    Frames frames(scene);
    scene.observer.position.x += 0.25;
    const RenderReport report = frames.render(scene);
    std::set<std::string> expected = kLight;
    expected.insert({"absorb_shadows", "absorb_sight", "cast_sight", "trace_closest"});
    EXPECT_EQ(frames.kernels(), expected);
    EXPECT_EQ(report.world.change, WorldChange::none);
    EXPECT_FALSE(report.hits_are_kept);
    EXPECT_EQ(frames.hash(), hash_alone(scene));
}

TEST(Reuse, AnObjectThatMovesIsPlacedAgainButNotVoxelized) {
    for (const size_t object : {0u, 1u}) {
        Scene scene = scene_of("blue");
        Frames frames(scene);
        const RenderReport all = frames.render(scene_of("red"));
        EXPECT_EQ(all.world.voxelized, 0u);
        frames.render(scene);
        scene.objects[object].world_from_object[3].z += 0.1;
        const RenderReport report = frames.render(scene);
        EXPECT_EQ(report.world.voxelized, 0u);
        EXPECT_GT(report.world.painted_bricks, 0u);
        EXPECT_LT(report.world.painted_bricks, 40u);
        EXPECT_THAT(frames.kernels(), testing::Not(testing::Contains("sample_solid")));
        EXPECT_THAT(frames.kernels(), testing::Not(testing::Contains("occupy_solid")));
        EXPECT_EQ(frames.hash(), hash_alone(scene));
    }
}

TEST(Reuse, AnExactObjectThatMovesIsTheOnlyOneVoxelized) {
    Scene scene = scene_of("blue");
    Frames frames(scene);
    scene.objects[3].world_from_object[3].y -= 0.05;
    EXPECT_EQ(frames.render(scene).world.voxelized, 1u);
    EXPECT_EQ(frames.hash(), hash_alone(scene));
}

TEST(Reuse, AModelThatChangesIsTheOnlyOneVoxelized) {
    Scene scene = scene_of("blue");
    Frames frames(scene);
    scene.models[0].solid->radius = 0.3;
    const RenderReport report = frames.render(scene);
    EXPECT_EQ(report.world.voxelized, 1u);
    EXPECT_EQ(frames.hash(), hash_alone(scene));
}

TEST(Reuse, ASingleFrameKeepsNothing) {
    const Device own = test_device();
    const Scene scene = scene_of("blue");
    RenderReport report;
    WorldBuilder builder(own, false);
    Renderer renderer(own, false);
    {
        const BuiltWorld world = builder.build(scene, report.world);
        renderer.image(scene, world, report);
    }
    EXPECT_EQ(own.counters().bytes_in_use, 0u);
}

TEST(Reuse, NeverShowsInTheImage) {
    constexpr uint32_t kSeed = 11;
    for (const char* material : {"blue", "glass"}) {
        std::mt19937 random(kSeed);
        const auto uniform = [&](double low, double high) {
            return std::uniform_real_distribution<double>(low, high)(random);
        };
        Scene scene = scene_of(material);
        Frames frames(scene);
        for (int step = 0; step < 24; ++step) {
            const auto kind = random() % 9;
            Object& object = scene.objects[random() % 4];
            if (kind == 0) object.world_from_object[3].x += uniform(-.3, .3);
            if (kind == 1) object.material = int(random() % 4);
            if (kind == 2) scene.materials[random() % 4].color = glm::vec3(float(uniform(0, 1)));
            if (kind == 3) scene.lights[0].position.y = uniform(1, 4);
            if (kind == 4) scene.observer.position.y = uniform(-.5, .9);
            if (kind == 5)
                scene.world.medium.absorption = glm::vec3(uniform(0, 1) > .5 ? 0.1f : 0.0f);
            if (kind == 6) scene.materials[1].opacity = uniform(0, 1) > .5f ? 0.5f : 1.0f;
            if (kind == 7) scene.models[0].solid->radius = uniform(.2, .4);
            if (kind == 8) object.priority = int(random() % 3);
            frames.render(scene);
            EXPECT_EQ(frames.hash(), hash_alone(scene))
                << material << ", seed " << kSeed << ", step " << step << ", kind " << kind;
        }
    }
}

TEST(Reuse, AGlassBringsItsKernelsWhenItComesIntoTheWorldAndTakesThemAlong) {
    Scene scene = scene_of("glass"), without = scene;
    without.objects[2].visible = false;
    Frames frames(without);
    for (const double y : {9.0, 0.1, 9.0}) {
        const bool is_outside = y > 1;
        scene.objects[2].world_from_object[3].y = y;
        frames.render(scene);
        EXPECT_EQ(frames.kernels().contains("pass_layer"), !is_outside);
        EXPECT_EQ(frames.kernels().contains("scatter_rays"), !is_outside);
        EXPECT_EQ(frames.hash(), hash_alone(is_outside ? without : scene));
    }
}

// An emissive object's light samples are found in the world's voxels, so it can't stay an instance.
TEST(Reuse, AnInstanceThatBeginsToShineIsPlacedInTheWorld) {
    Scene scene = scene_of("blue");
    scene.objects[0].moves = true;
    scene.objects[0].world_from_object = glm::dmat4(1);
    scene.objects[0].material = int(scene.materials.size());
    scene.materials.push_back(scene.materials[1]);
    find_extents(scene);
    Frames frames(scene);
    scene.materials.back().emission = glm::vec3(5);
    frames.render(scene);
    EXPECT_EQ(frames.hash(), hash_alone(scene));
}

TEST(Reuse, AnInstanceMovesWithoutTheObjectsOfItsModel) {
    Scene scene = scene_of("blue");
    scene.objects[0].moves = true;
    find_extents(scene);
    Frames frames(scene);
    scene.objects[0].world_from_object[3].x += 0.3;
    find_extents(scene);
    const RenderReport report = frames.render(scene);
    EXPECT_EQ(report.world.painted_bricks, 0u);
    EXPECT_THAT(frames.kernels(), testing::Not(testing::Contains("mark_voxels")));
    EXPECT_EQ(frames.hash(), hash_alone(scene));
}

}  // namespace
}  // namespace voxelume
