// SPDX-License-Identifier: Apache-2.0
// Copies of scenes with another light, size, number of samples or observer, and changed values.
#include <gtest/gtest.h>

#include <glm/geometric.hpp>

#include "runtime/api/border/handles.hpp"
#include "tests/api/api_environment.hpp"

namespace voxelume {
namespace {

v1::SceneDescription plain_scene() {
    v1::SceneDescription scene;
    scene.world = {.voxel_size = {0.5, 0.25, 0.125}, .min = {-1, -2, -3}, .max = {3, 2, 1}};
    scene.observer.emplace().position = {0.5, 1, -6};
    return scene;
}

}  // namespace

TEST(ApiSceneChange, ChangesItsLightInACopy) {
    const v1::Scene scene = v1::Scene::build(plain_scene());
    const v1::Scene global = scene.with_light(v1::LightMode::global);
    EXPECT_EQ(api::inside(scene).render.light, LightMode::local);
    EXPECT_EQ(api::inside(global).render.light, LightMode::global);
    EXPECT_EQ(api::inside(global.with_light(v1::LightMode::local)).render.light, LightMode::local);
}

TEST(ApiSceneChange, ValuesAreChangedBeforeItIsChecked) {
    v1::SceneOptions options;
    options.changes = {{"render.samples", "9"}, {"world.ambient", "0.5,0.25,0"}};
    const Scene changed = api::inside(v1::Scene::build(plain_scene(), options));
    EXPECT_EQ(changed.render.samples, 9);
    EXPECT_EQ(changed.world.ambient, glm::vec3(0.5f, 0.25f, 0));
    options.changes.push_back({"render.sample", "1", "the third change"});
    try {
        v1::Scene::build(plain_scene(), options);
        FAIL() << "an unknown key was taken";
    } catch (const v1::Error& error) {
        EXPECT_EQ(error.kind(), v1::ErrorKind::usage);
        EXPECT_STREQ(error.what(),
                     "the third change: render: unknown key \"sample\"; did you mean \"samples\"?");
        EXPECT_EQ(error.key(), "render");
    }
}

TEST(ApiSceneChange, ItsObserverGoesRoundByDegrees) {
    // He looks along +Z at nothing, so he goes round the middle of the world.
    const Scene turned = api::inside(v1::Scene::build(plain_scene(), {.orbit = 180}));
    EXPECT_LT(glm::distance(turned.observer.position, glm::dvec3(1.5, 1, 4)), 1e-12);
    EXPECT_LT(glm::distance(turned.observer.world_from_observer[2], glm::dvec3(0, 0, -1)), 1e-12);
}

TEST(ApiSceneChange, ChangesItsSizeAndSamplesInCopies) {
    const v1::Scene scene = v1::Scene::build(plain_scene());
    const v1::Scene wide = scene.with_size({300, 100}).with_samples(9);
    EXPECT_EQ(scene.size(), (v1::Size{640, 480}));
    EXPECT_EQ(wide.size(), (v1::Size{300, 100}));
    EXPECT_EQ(api::inside(wide).render.samples, 9);
    EXPECT_LT(api::inside(wide).observer.display.half_angles.y,
              api::inside(scene).observer.display.half_angles.y);
    EXPECT_THROW(scene.with_size({0, 5}), v1::Error);
    EXPECT_THROW(scene.with_samples(4097), v1::Error);
}

}  // namespace voxelume
