// SPDX-License-Identifier: Apache-2.0
// Many lights in global light, of which paths choose one at each surface and at each point in a
// medium, against the sum of pictures with few lights each.
#include "tests/oracles/image_hash.hpp"
#include "tests/pictures/light/lamp_yard.hpp"
#include "tests/support/exhaustive.hpp"

namespace voxelume {
namespace {

TEST(ManyLights, BringTheLightOfEach) {
    for (const auto& [lights, seed] : {std::pair(9, 1u), {40, 2u}, {200, 3u}}) {
        if (lights > 40 && !is_exhaustive()) continue;
        constexpr int kParts = 8, kSamples = 16;
        const Scene all = lit_yard(lights, seed, kSamples, 0);
        Scene one = all;
        std::map<std::string, double> expected;
        for (const Light& light : all.lights) {
            one.lights = {light};
            one.render.samples = kParts * kSamples;
            const Image image = image_of(one);
            for (const char* plane : {"R", "G", "B"}) expected[plane] += sum_of(image, plane);
        }
        // All samples of the pictures with one light, in blocks.
        std::map<std::string, std::vector<double>> found;
        for (int part = 0; part < kParts; ++part) {
            Scene scene = all;
            scene.render.first_sample = part * kSamples;
            const Image image = image_of(scene);
            for (const char* plane : {"R", "G", "B"}) found[plane].push_back(sum_of(image, plane));
        }
        for (const char* plane : {"R", "G", "B"}) {
            double mean = 0, square = 0;
            for (const double sum : found[plane]) mean += sum / kParts;
            for (const double sum : found[plane]) square += (sum - mean) * (sum - mean);
            const double error = std::sqrt(square / (kParts * (kParts - 1)));
            fmt::print("{} lights, {}: {:.4f} +- {:.4f}, expected {:.4f}\n", lights, plane, mean,
                       error, expected[plane]);
            EXPECT_NEAR(mean, expected[plane], 4 * error + 1e-5 * expected[plane]);
        }
    }
}

/// Surfaces are black, so that nearly all of the light comes from the medium.
TEST(ManyLights, BringTheLightOfEachToAMedium) {
    for (const auto& [lights, anisotropy] : {std::pair(9, 0.6), {150, -0.4}, {150, 0.9}}) {
        const bool is_noisy = anisotropy > 0.6;
        if (is_noisy && !is_exhaustive()) continue;
        Scene scene = foggy_yard(lights, 4, is_noisy ? 32 : 16, anisotropy);
        for (Material& material : scene.materials) material.color = glm::vec3(0);
        // Parts share their pixels' scrambling, so few of them tell too small an error.
        const int parts = lights > 9 ? 8 : 16, all = is_noisy ? 64 : 32;
        expect_light_of_each(scene, is_exhaustive() ? all : parts);
    }
}

/// Whatever lights a point chooses, it chooses in the image of each group as in that of all light.
TEST(ManyLights, OfGroupsAddUpToTheImage) {
    expect_groups_to_add_up(lit_yard(20, 6, 4));
    expect_groups_to_add_up(foggy_yard(20, 6, 4, 0.3));
}

/// Lamps in a closed box of the wall, which bring nothing, as bright as they may be.
TEST(ManyLights, LeaveAChanceToAWeakOneBesideHiddenOnes) {
    for (const float hidden : {1.0f, 1e3f, 1e8f}) {
        if (hidden < 1e8f && !is_exhaustive()) continue;
        Scene scene = lit_yard(10, 1, 4096, 0);
        for (size_t i = 1; i < scene.lights.size(); ++i) {
            scene.lights[i] = scene.lights[0];
            scene.lights[i].position = {0.01 * double(i) - 0.4, 0.25, 0};  // within the metal ball
            scene.lights[i].intensity = glm::vec3(hidden);
        }
        const double found = sum_of(image_of(scene), "G");
        scene.lights.resize(1);
        const double expected = sum_of(image_of(scene), "G");
        fmt::print("beside lights of {}: {:.4f}, expected {:.4f}\n", hidden, found, expected);
        // 1.6 million samples choose the weak one with a probability of about 0.006: the standard
        // error is 1 %.
        EXPECT_NEAR(found, expected, 0.04 * expected) << hidden;
    }
}

TEST(ManyLights, AreTheSameBitsOnAnyLanes) {
    for (const Scene& scene : {lit_yard(150, 5, 4), foggy_yard(30, 5, 4, 0.5)}) {
        const uint64_t expected = oracle::image_hash(image_of(scene));
        for (const int lanes : {1, 4, 16})
            EXPECT_EQ(oracle::image_hash(image_of(scene, test_device(lanes))), expected) << lanes;
    }
}

TEST(ManyLights, AreChosenOnlyWhereThereAreMany) {
    auto& launches = shared_device().counters().launches;
    const auto kernels_of = [&](int lights) {
        launches.clear();
        image_of(lit_yard(lights, 7, 1));
        return std::pair(launches["add_light"] > 0, launches["add_chosen_light"] > 0);
    };
    EXPECT_EQ(kernels_of(8), std::pair(true, false));
    EXPECT_EQ(kernels_of(9), std::pair(false, true));
    image_of(foggy_yard(9, 7, 1, 0));
    for (const char* kernel : {"find_points_near_chosen", "add_chosen_light_to_medium"})
        EXPECT_GT(launches[kernel], 0u) << kernel;
    for (const char* kernel : {"find_near_points", "add_light_to_medium"})
        EXPECT_EQ(launches[kernel], 0u) << kernel;
    launches.clear();
    image_of(foggy_yard(8, 7, 1, 0));
    for (const char* kernel : {"find_near_points", "add_light_to_medium"})
        EXPECT_GT(launches[kernel], 0u) << kernel;
    for (const char* kernel : {"find_points_near_chosen", "add_chosen_light_to_medium"})
        EXPECT_EQ(launches[kernel], 0u) << kernel;
}

}  // namespace
}  // namespace voxelume
