// SPDX-License-Identifier: Apache-2.0
// Many lights in global light, of which paths choose one at each surface and at each point in a
// medium, against the sum of pictures with few lights each.
#include <gmock/gmock.h>

#include <random>

#include "runtime/render/renderer.hpp"
#include "runtime/scene_file/read_scene.hpp"
#include "tests/oracles/image_hash.hpp"
#include "tests/support/exhaustive.hpp"
#include "tests/support/shared_device.hpp"

namespace voxelume {
namespace {

/// A floor, a wall and a ball of several materials, and lights around them: points, and spots with
/// narrow and with wide cones, some of which shine away from everything.
Scene lit_yard(int lights, uint32_t seed, int samples, int bounces = 1) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> any(-1, 1);
    std::string list;
    for (int i = 0; i < lights; ++i) {
        const bool is_spot = i % 3 != 0;
        list += fmt::format(
            R"({}{{"type": "{}", "position": [{}, {}, {}], "intensity": {}, "color": [1, {}, {}]{}}})",
            i > 0 ? ", " : "", is_spot ? "spot" : "point", any(random), 0.45 + 0.4 * any(random),
            any(random), 0.3 + 0.2 * any(random), 0.7 + 0.3 * any(random), 0.6 + 0.3 * any(random),
            is_spot
                ? fmt::format(R"(, "direction": [{}, {}, {}], "angle": {}, "inner_angle": 10)",
                              any(random), any(random) - 0.5, any(random), i % 3 == 1 ? 50 : 170)
                : std::string());
    }
    return parse_scene(fmt::format(R"({{"voxelume": 1,
"world": {{"voxel_size": 0.03, "bounds": {{"min": [-1, -0.1, -1], "max": [1, 1, 1]}},
          "ambient": [0, 0, 0], "background": [0, 0, 0]}},
"materials": {{"floor": {{"color": [0.8, 0.7, 0.6]}},
             "metal": {{"base_color": [0.9, 0.8, 0.7], "metallic": 1, "roughness": 0.3}},
             "paint": {{"base_color": [0.3, 0.4, 0.8], "roughness": 0.5, "coat": 1,
                       "coat_roughness": 0.2}},
             "shiny": {{"color": [0.6, 0.7, 0.5], "specular": 0.4, "shininess": 60}}}},
"models": {{"floor": {{"shape": "box", "size": [2, 0.1, 2], "surface": "cubes"}},
          "wall": {{"shape": "box", "size": [1.2, 0.7, 0.1], "surface": "exact"}},
          "ball": {{"shape": "sphere", "radius": 0.25, "surface": "exact"}}}},
"objects": [{{"model": "floor", "material": "floor", "position": [0, -0.05, 0]}},
            {{"model": "wall", "material": "shiny", "position": [0, 0.35, -0.6], "turn": [0, 20, 0]}},
            {{"model": "ball", "material": "metal", "position": [-0.4, 0.25, 0]}},
            {{"model": "ball", "material": "paint", "position": [0.4, 0.25, 0.2]}}],
"lights": [{}],
"observer": {{"position": [0.3, 1.4, 2.2], "look_at": [0, 0.2, 0],
             "display": {{"shape": "pyramid", "angle": 50}}}},
"render": {{"light": "global", "bounces": {}, "size": [24, 16], "samples": {}}}}})",
                                   list, bounces, samples),
                       "yard.json", {});
}

/// The yard in a medium that scatters light, mostly ahead or back.
Scene foggy_yard(int lights, uint32_t seed, int samples, double anisotropy, int bounces = 1) {
    Scene scene = lit_yard(lights, seed, samples, bounces);
    scene.world.medium.scattering = {0.5f, 0.4f, 0.3f};
    scene.world.medium.absorption = glm::vec3(0.1f);
    scene.world.medium.anisotropy = anisotropy;
    return scene;
}

Image image_of(const Scene& scene, const Device& device = shared_device()) {
    RenderReport report;
    return render(device, scene, report);
}

double sum_of(const Image& image, const char* plane) {
    double sum = 0;
    for (const float value : image.planes.at(plane)) sum += double(value);
    return sum;
}

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

/// The green light of an image of the scene, and of images with eight of its lights each, in which
/// each light is asked.
std::pair<double, double> sums_of(const Scene& scene) {
    double few = 0;
    Scene part = scene;
    for (size_t i = 0; i < scene.lights.size(); i += 8) {
        const size_t end = std::min(i + 8, scene.lights.size());
        part.lights = {scene.lights.begin() + long(i), scene.lights.begin() + long(end)};
        few += sum_of(image_of(part), "G");
    }
    return {sum_of(image_of(scene), "G"), few};
}

/// Surfaces are black, so that nearly all of the light comes from the medium.
TEST(ManyLights, BringTheLightOfEachToAMedium) {
    for (const auto& [lights, anisotropy] : {std::pair(9, 0.6), {150, -0.4}, {150, 0.9}}) {
        const bool is_noisy = anisotropy > 0.6;
        if (is_noisy && !is_exhaustive()) continue;
        const int parts = is_exhaustive() ? 32 : 8;
        Scene scene = foggy_yard(lights, 4, is_noisy ? 32 : 16, anisotropy);
        for (Material& material : scene.materials) material.color = glm::vec3(0);
        std::vector<double> differences;
        double mean = 0, square = 0, expected = 0;
        for (int part = 0; part < parts; ++part) {
            scene.render.first_sample = part * scene.render.samples;
            const auto [all, few] = sums_of(scene);
            differences.push_back(all - few);
            mean += (all - few) / parts;
            expected += few / parts;
        }
        for (const double d : differences) square += (d - mean) * (d - mean);
        const double error = std::sqrt(square / (parts * (parts - 1.0)));
        fmt::print("{} lights, g {}: {:.4f} of {:.4f} too much, +- {:.4f}\n", lights, anisotropy,
                   mean, expected, error);
        EXPECT_LT(std::abs(mean), 4 * error);
        // So the limit above is at most 4 % of the light.
        EXPECT_LT(error, 0.01 * expected);
    }
}

/// Whatever lights a point chooses, it chooses in the image of each group as in that of all light.
TEST(ManyLights, OfGroupsAddUpToTheImage) {
    for (const bool is_foggy : {false, true}) {
        Scene scene = is_foggy ? foggy_yard(20, 6, 4, 0.3) : lit_yard(20, 6, 4);
        for (size_t i = 0; i < scene.lights.size(); ++i)
            scene.lights[i].group = i % 5 == 0 ? "" : i % 2 == 0 ? "even" : "odd";
        RenderReport alone, report;
        render(shared_device(), scene, alone);
        scene.render.channels.light_groups = true;
        const Image image = render(shared_device(), scene, report);
        // No ray is sent to a light of another group.
        EXPECT_EQ(report.shadow_rays, 2 * alone.shadow_rays);
        for (const char* color : {"R", "G", "B"}) {
            const auto& all = image.planes.at(color);
            double odd = 0;
            for (size_t i = 0; i < all.size(); ++i) {
                float sum = 0;
                for (const char* group : {"even", "odd", "rest"})
                    sum += image.planes.at(fmt::format("light_{}.{}", group, color))[i];
                // The sums of up to 40 contributions differ by the order of rounding.
                ASSERT_NEAR(sum, all[i], 1e-5f * std::max(all[i], 1.0f)) << color << i;
                odd += double(image.planes.at(fmt::format("light_odd.{}", color))[i]);
            }
            EXPECT_GT(odd, 0.05 * sum_of(image, color));
        }
    }
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
