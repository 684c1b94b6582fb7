// SPDX-License-Identifier: Apache-2.0
// Volumetric images in global light: each voxel shows the mean of paths that begin in it.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <glm/geometric.hpp>
#include <string>

#include "runtime/render/renderer.hpp"
#include "tests/support/display_fixture.hpp"
#include "tests/support/exhaustive.hpp"

namespace voxelume {
namespace {

/// A ball and a tilted box before a display of `layout`, seen from the observer.
Scene shown(const std::string& layout, const std::string& world, const std::string& material,
            const std::string& render, const std::string& lights = "") {
    return parsed(fmt::format(R"({{"voxelume": 1,
"world": {{"voxel_size": 0.05, "bounds": {{"min": [-1, -1, -1], "max": [1, 1, 1]}}{}}},
"materials": {{"one": {{{}}}}},
"models": {{"ball": {{"shape": "sphere", "radius": 0.4}},
           "box": {{"shape": "box", "size": [0.5, 0.4, 0.3]}}}},
"objects": [{{"model": "ball", "material": "one", "position": [-0.3, 0.1, 0]}},
            {{"model": "box", "position": [0.5, -0.2, 0.1], "turn": [20, 10, 0]}}],
"lights": [{}],
"observer": {{"position": [0, 0, -1], "look_at": [0, 0, 0],
             "display": {{"shape": "box", "size": [1.8, 1.6, 1.7], "voxels": [24, 20, 22],
                         "layout": "{}", "visibility": "observer"}}}},
"render": {{{}}}}})",
                              world, material, lights, layout, render));
}

constexpr const char* kSun = R"({"type": "directional", "direction": [-0.4, -0.6, 1]})";
constexpr const char* kEvenSky = R"(, "sky": {"kind": "constant", "color": [1, 1, 1]})";

/// Colours are sums of some ten terms below 2, each rounded to 2^-24, that are divided by opacities
/// and transmittances down to 0.3.
constexpr float kRounding = 2e-5f;

/// The greatest difference of two volumes with the same voxels, of colours and opacities.
float farthest(const Volume& a, const Volume& b) {
    EXPECT_EQ(a.indices, b.indices);
    EXPECT_EQ(a.objects, b.objects);
    if (a.indices != b.indices) return INFINITY;
    float far = 0;
    for (size_t i = 0; i < a.colors.size(); ++i) {
        far = std::max(far, std::abs(a.opacities[i] - b.opacities[i]));
        far = std::max(far, glm::distance(a.colors[i], b.colors[i]));
    }
    return far;
}

// A path that ends at its first surface brings what lights send there.
TEST(GlobalDisplay, WithoutBouncesIsLocalLight) {
    for (const char* layout : {"lattice", "rays"})
        for (const char* opacity : {"1", "0.4"})
            for (const int samples : {1, 4}) {
                const std::string world = R"(, "medium": {"absorption": [0.3, 0.2, 0.1]})";
                Scene scene = shown(layout, world, fmt::format("\"opacity\": {}", opacity),
                                    R"("bounces": 0)", kSun);
                scene.render.samples = samples;
                scene.render.shadows = opacity == std::string("1");  // which veils dim otherwise
                const Volume local = volume_of(scene);
                scene.render.light = LightMode::global;
                const Volume global = volume_of(scene);
                EXPECT_GT(local.indices.size(), 250u);
                EXPECT_LT(farthest(local, global), kRounding) << layout << opacity << samples;
            }
}

// Every path that leaves a convex surface under an even sky brings what the surface reflects of it.
TEST(GlobalDisplay, ShowsAConvexSurfaceUnderAnEvenSkyAsItsAlbedo) {
    for (const char* layout : {"lattice", "rays"})
        for (const char* opacity : {"1", "0.3"}) {
            Scene scene = shown(
                layout, kEvenSky,
                fmt::format(R"("color": [0.5, 0.25, 0.75], "diffuse": 1, "opacity": {})", opacity),
                R"("light": "global", "samples": 3)");
            scene.objects.resize(1);
            const Volume volume = volume_of(scene);
            size_t count = 0;
            for (size_t i = 0; i < volume.indices.size(); ++i) {
                if (volume.objects[i] != 1 || volume.depths[i] > 1) continue;  // its back
                ++count;
                EXPECT_LT(glm::distance(volume.colors[i], glm::vec3(0.5f, 0.25f, 0.75f)), kRounding)
                    << layout << opacity << " " << i;
            }
            EXPECT_GT(count, 60u) << layout;
        }
}

/// A red wall next to a white floor that it colours, seen from above.
Scene corner(const std::string& layout, int samples) {
    return parsed(fmt::format(R"({{"voxelume": 1,
"world": {{"voxel_size": 0.05, "bounds": {{"min": [-1, -1, -1], "max": [1, 1, 1]}},
          "sky": {{"kind": "constant", "color": [1, 1, 1]}}}},
"materials": {{"white": {{"color": [0.9, 0.9, 0.9], "diffuse": 1}},
              "red": {{"color": [0.9, 0.1, 0.1], "diffuse": 1}}}},
"models": {{"floor": {{"shape": "box", "size": [1.5, 1.5, 0.2]}},
           "wall": {{"shape": "box", "size": [0.2, 1.5, 0.8]}}}},
"objects": [{{"model": "floor", "material": "white", "position": [0, 0, 0.43]}},
            {{"model": "wall", "material": "red", "position": [0.63, 0, -0.07]}}],
"observer": {{"position": [0, 0, -0.9], "look_at": [0, 0, 0],
             "display": {{"shape": "box", "size": [1.8, 1.6, 1.7], "voxels": [18, 16, 17],
                         "layout": "{}", "visibility": "observer"}}}},
"render": {{"size": [18, 16], "light": "global", "samples": {}}}}})",
                              layout, samples));
}

/// The difference of the floor's voxels from the flat picture, RMS over all channels. `mean` is its
/// red.
double off_the_picture(const char* layout, int samples, double& mean) {
    RenderReport report;
    const Image picture = render(test_device(), corner(layout, 512), report);
    const Volume volume = volume_of(corner(layout, samples));
    double sum = 0;
    int count = 0;
    mean = 0;
    for (size_t i = 0; i < volume.indices.size(); ++i) {
        const auto index = int(volume.indices[i]);
        const int column = index % 18, row = index / 18 % 16;
        // Image right is -X_E of a lattice, and down is -Y_E; rays have the pixels' order.
        const bool is_rays = layout == std::string("rays");
        const int u = is_rays ? column : 17 - column, v = is_rays ? row : 15 - row;
        const size_t pixel = size_t(v * 18 + u);
        if (volume.objects[i] != 1 || std::abs(volume.depths[i] - 1.23f) > 1e-3f) continue;
        if (u < 4 || u > 14 || v < 3 || v > 12) continue;  // rims, and the wall's foot
        const glm::vec3 seen(picture.planes.at("R")[pixel], picture.planes.at("G")[pixel],
                             picture.planes.at("B")[pixel]);
        const glm::dvec3 off = volume.colors[i] - seen;
        sum += glm::dot(off, off);
        mean += double(volume.colors[i].x / volume.colors[i].y);
        ++count;
    }
    EXPECT_GT(count, 100) << layout;
    mean /= count;
    return std::sqrt(sum / (3.0 * count));
}

TEST(GlobalDisplay, ShowsWhatFlatPicturesShowAsSamplesGrow) {
    for (const char* layout : {"lattice", "rays"}) {
        double redness = 0;
        const double few = off_the_picture(layout, 4, redness),
                     many = off_the_picture(layout, 128, redness);
        fmt::print("{}: RMS {:.4f} with 4 samples, {:.4f} with 128; red {:.3f} of green\n", layout,
                   few, many, redness);
        EXPECT_GT(few, 0.05) << layout;
        EXPECT_LT(many, 0.25 * few) << layout;
        EXPECT_GT(redness, 1.05) << layout;
    }
}

/// Expects the same bits on other lanes and with small batches.
void expect_same_bits_anywhere(const Scene& scene, const std::string& of) {
    DeviceCounters& counters = shared_device().counters();
    counters.launches.clear();
    const Volume expected = volume_of(scene);
    const uint64_t launches = counters.launches["extend_paths"];
    const auto expect_same = [&](const Volume& volume, const std::string& where) {
        EXPECT_EQ(volume.indices, expected.indices) << of << where;
        EXPECT_TRUE(volume.colors == expected.colors) << of << where;
    };
    std::vector<int> others = {1, 4, 8, 16};
    std::erase(others, shared_device().lanes());
    for (const int lanes : in_turn(others, of == "rays" ? 1 : 2))
        expect_same(volume_of(scene, lanes), fmt::format(", {} lanes", lanes));
    setenv("VOXELUME_BATCH", "100", 1);  // which is 96
    const Device device = test_device();
    unsetenv("VOXELUME_BATCH");
    device.counters().launches.clear();
    RenderReport report;
    expect_same(render_volume(device, scene, report), ", batches of 96");
    EXPECT_GT(device.counters().launches["extend_paths"], 2 * launches) << of;
}

TEST(GlobalDisplay, HasTheSameBitsInAnyBatchesAndOnAnyLanes) {
    for (const char* layout : {"lattice", "rays"}) {
        for (const char* opacity : {"1", "0.6"}) {
            Scene scene =
                shown(layout, kEvenSky, fmt::format(R"("opacity": {}, "reflection": 0.3)", opacity),
                      R"("light": "global", "samples": 3, "bounces": 3)", kSun);
            expect_same_bits_anywhere(scene, layout);
            scene.render.noise.error = 0.1;
            scene.render.samples = 64;
            expect_same_bits_anywhere(scene, layout);
        }
    }
}

TEST(GlobalDisplay, IsMadeByKernelsThatLocalLightLacks) {
    DeviceCounters& counters = shared_device().counters();
    const auto launches = [&](const Scene& scene) {
        counters.launches.clear();
        volume_of(scene);
        return std::pair(counters.launches["extend_paths"], counters.launches["add_paths"]);
    };
    const std::pair<uint64_t, uint64_t> none{0, 0};
    for (const char* layout : {"lattice", "rays"}) {
        Scene scene = shown(layout, kEvenSky, "", R"("samples": 2)", kSun);
        EXPECT_EQ(launches(scene), none) << layout;
        scene.render.light = LightMode::global;
        const auto [paths, sums] = launches(scene);
        EXPECT_GT(paths, 0u) << layout;
        EXPECT_GT(sums, 0u) << layout;
    }
}

}  // namespace
}  // namespace voxelume
