// SPDX-License-Identifier: Apache-2.0
// A yard among lamps, of which paths choose one, and what its pictures are compared with.
#pragma once

#include <gmock/gmock.h>

#include <cmath>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "runtime/render/renderer.hpp"
#include "runtime/scene_file/read_scene.hpp"
#include "tests/support/shared_device.hpp"

namespace voxelume {

/// A floor, a wall and a ball of several materials, and lights around them: points, and spots with
/// narrow and with wide cones, some of which shine away from everything.
inline Scene lit_yard(int lights, uint32_t seed, int samples, int bounces = 1) {
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
inline Scene foggy_yard(int lights, uint32_t seed, int samples, double anisotropy,
                        int bounces = 1) {
    Scene scene = lit_yard(lights, seed, samples, bounces);
    scene.world.medium.scattering = {0.5f, 0.4f, 0.3f};
    scene.world.medium.absorption = glm::vec3(0.1f);
    scene.world.medium.anisotropy = anisotropy;
    return scene;
}

inline Image image_of(const Scene& scene, const Device& device = shared_device()) {
    RenderReport report;
    return render(device, scene, report);
}

inline double sum_of(const Image& image, const char* plane) {
    double sum = 0;
    for (const float value : image.planes.at(plane)) sum += double(value);
    return sum;
}

/// The green light of an image of the scene, and of images with eight of its lights each, in which
/// each light is asked.
inline std::pair<double, double> sums_of(const Scene& scene) {
    double few = 0;
    Scene part = scene;
    for (size_t i = 0; i < scene.lights.size(); i += 8) {
        const size_t end = std::min(i + 8, scene.lights.size());
        part.lights = {scene.lights.begin() + long(i), scene.lights.begin() + long(end)};
        few += sum_of(image_of(part), "G");
    }
    return {sum_of(image_of(scene), "G"), few};
}

/// Fails unless images of the scene have the green light of images with eight of the lights each,
/// within four standard errors, which are at most the part `most_error` of it. Renders `parts`
/// blocks of samples.
inline void expect_light_of_each(Scene scene, int parts, double most_error = 0.01) {
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
    fmt::print("{} lights: {:.4f} of {:.4f} too much, +- {:.4f}\n", scene.lights.size(), mean,
               expected, error);
    EXPECT_LT(std::abs(mean), 4 * error);
    EXPECT_LT(error, most_error * expected);
}

/// Fails unless images of the groups of the scene's lights add up to the image of all, without a
/// ray to a light of another group.
inline void expect_groups_to_add_up(Scene scene) {
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

}  // namespace voxelume
