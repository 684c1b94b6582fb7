// SPDX-License-Identifier: Apache-2.0
// Many lights with an area in global light, of which paths choose one at each surface and at each
// point in a medium, and into all of which mirrored paths may run.
#include "tests/oracles/image_hash.hpp"
#include "tests/pictures/light/lamp_yard.hpp"
#include "tests/support/exhaustive.hpp"

namespace voxelume {
namespace {

/// Makes the lights disks and rectangles, but leaves the first `points` as they are.
Scene with_areas(Scene scene, size_t points = 0) {
    std::mt19937 random(20261130);
    std::uniform_real_distribution<double> any(-1, 1);
    for (size_t i = points; i < scene.lights.size(); ++i) {
        Light& light = scene.lights[i];
        light.kind = i % 2 == 0 ? LightKind::disk : LightKind::rectangle;
        const auto axis = [&] { return glm::dvec3(any(random), any(random), any(random)) + 0.01; };
        light.direction = glm::normalize(axis() + glm::dvec3(0, -0.5, 0));
        light.axis_x = glm::normalize(glm::cross(light.direction, axis()));
        light.radius = 0.06 + 0.05 * any(random);
        light.size = {0.2 + 0.1 * any(random), 0.1 + 0.05 * any(random)};
    }
    return scene;
}

/// Replaces the metal by a mirror, and all other materials by black ones.
Scene mirrors_alone(Scene scene) {
    for (size_t i = 0; i < scene.materials.size(); ++i) {
        Material material;
        material.name = scene.materials[i].name;
        material.color = glm::vec3(0);
        if (int(i) == scene.objects[2].material) material.reflection = 1;
        scene.materials[i] = material;
    }
    return scene;
}

TEST(ManyAreaLights, BringTheLightOfEach) {
    for (const int lights : {9, 40, 300}) {
        if (lights > 40 && !is_exhaustive()) continue;
        expect_light_of_each(with_areas(lit_yard(lights, 11, 64, 2)), is_exhaustive() ? 32 : 8);
    }
}

/// Points in the medium that are close to a light make noise, with eight lights as with more.
TEST(ManyAreaLights, BringTheLightOfEachToAMedium) {
    for (const auto& [lights, anisotropy] : {std::pair(40, -0.4), {9, 0.6}, {150, 0.5}}) {
        if (lights != 40 && !is_exhaustive()) continue;
        Scene scene = with_areas(foggy_yard(lights, 12, 128, anisotropy));
        for (Material& material : scene.materials) material.color = glm::vec3(0);
        // Nine lights have more noise beside their light, even in four times the samples. The error
        // of forty is that of single rays past a light, and doesn't fall with some more parts: 1.5
        // % with 8, 3.0 % with 24.
        expect_light_of_each(scene, is_exhaustive() ? 32 : 8, lights > 9 ? 0.02 : 0.03);
    }
}

/// No chance decides which lights a mirror shows.
TEST(ManyAreaLights, AreAllShownByMirrors) {
    for (const int lights : {9, 40, 200}) {
        Scene scene = mirrors_alone(with_areas(lit_yard(lights, 13, 16)));
        scene.render.size = {120, 80};
        auto& launches = shared_device().counters().launches;
        launches.clear();
        const Image all = image_of(scene);
        EXPECT_GT(launches["meet_area_lights"], 0u);
        EXPECT_EQ(launches["meet_area_light"], 0u);
        std::vector<double> expected(all.planes.at("G").size());
        Scene part = scene;
        for (size_t i = 0; i < scene.lights.size(); i += 8) {
            const size_t end = std::min(i + 8, scene.lights.size());
            part.lights = {scene.lights.begin() + long(i), scene.lights.begin() + long(end)};
            const Image few = image_of(part);
            for (size_t k = 0; k < expected.size(); ++k)
                expected[k] += double(few.planes.at("G")[k]);
        }
        size_t lit = 0;
        for (size_t k = 0; k < expected.size(); ++k) {
            lit += expected[k] > 0;
            // Sums of 16 samples and up to 200 lights are rounded in another order.
            EXPECT_NEAR(all.planes.at("G")[k], expected[k], 1e-5 * (expected[k] + 1)) << k;
        }
        EXPECT_GT(lit, 20u);
    }
}

TEST(ManyAreaLights, OfGroupsAddUpToTheImage) {
    expect_groups_to_add_up(with_areas(lit_yard(20, 6, 4)));
    expect_groups_to_add_up(with_areas(lit_yard(20, 6, 4), 10));
    expect_groups_to_add_up(with_areas(foggy_yard(20, 6, 4, 0.3)));
}

TEST(ManyAreaLights, AreTheSameBitsOnAnyLanes) {
    for (const Scene& scene :
         {with_areas(lit_yard(50, 5, 4, 3), 20), with_areas(foggy_yard(30, 5, 4, 0.5), 10)}) {
        const uint64_t expected = oracle::image_hash(image_of(scene));
        for (const int lanes : {1, 4, 16})
            EXPECT_EQ(oracle::image_hash(image_of(scene, test_device(lanes))), expected) << lanes;
    }
}

TEST(ManyAreaLights, AreChosenOnlyWhereThereAreMany) {
    auto& launches = shared_device().counters().launches;
    const auto launched = [&](const Scene& scene) {
        launches.clear();
        image_of(scene);
        std::vector<std::string> kernels;
        for (const char* kernel : {"add_light", "add_area_light", "add_chosen_light",
                                   "meet_area_light", "meet_area_lights"})
            if (launches[kernel] > 0) kernels.emplace_back(kernel);
        return kernels;
    };
    using testing::ElementsAre;
    EXPECT_THAT(launched(with_areas(lit_yard(8, 7, 1))),
                ElementsAre("add_area_light", "meet_area_light"));
    EXPECT_THAT(launched(with_areas(lit_yard(9, 7, 1))),
                ElementsAre("add_chosen_light", "meet_area_lights"));
    // Points and lights with an area are counted apart.
    EXPECT_THAT(launched(with_areas(lit_yard(16, 7, 1), 8)),
                ElementsAre("add_light", "add_area_light", "meet_area_light"));
    EXPECT_THAT(launched(with_areas(lit_yard(17, 7, 1), 9)),
                ElementsAre("add_area_light", "add_chosen_light", "meet_area_light"));
    EXPECT_THAT(launched(with_areas(lit_yard(17, 7, 1), 8)),
                ElementsAre("add_light", "add_chosen_light", "meet_area_lights"));
    // Lights that are large for their world are asked each.
    Scene large = with_areas(lit_yard(9, 7, 1));
    large.lights[0].radius = 0.3;  // of a diagonal of 3 m
    EXPECT_THAT(launched(large), ElementsAre("add_area_light", "meet_area_light"));
    image_of(with_areas(foggy_yard(9, 7, 1, 0)));
    EXPECT_EQ(launches["add_area_light_to_medium"], 0u);
    EXPECT_GT(launches["add_chosen_light_to_medium"], 0u);
}

}  // namespace
}  // namespace voxelume
