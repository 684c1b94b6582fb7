// SPDX-License-Identifier: Apache-2.0
// Global light of displays of layout `rays` whose rays go through objects: each layer of surfaces
// has its own light, and the composited voxels are the flat image.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <string>
#include <vector>

#include "runtime/render/renderer.hpp"
#include "tests/support/display_fixture.hpp"

namespace voxelume {
namespace {

constexpr const char* kSky = R"(, "sky": {"kind": "constant", "color": [0.7, 0.8, 1]})";
constexpr const char* kLamp =
    R"({"type": "disk", "position": [-0.9, 0.9, -0.9], "look_at": [0, 0, 0], "radius": 0.6,
        "intensity": 3})";

/// The fixture's ball, whose material has these keys, before its block and a wall, in global light.
Scene global_scene(const std::string& material, const std::string& world, int samples) {
    std::string text = display_scene(
        std::string(kDisplayCases[0].keys) + R"(, "voxels": [28, 21, 60])", "smooth", world, kLamp);
    const auto replace = [&](const std::string& old, const std::string& by) {
        text.replace(text.find(old), old.size(), by);
    };
    replace(R"("red": {"color": [0.8, 0.3, 0.2]})", R"("red": {)" + material + "}");
    replace(R"("models": {)",
            R"("models": {"wall": {"shape": "box", "size": [4, 4, 0.2], "surface": "exact"},)");
    replace(R"("objects": [)", R"("objects": [{"model": "wall", "position": [0, 0, 1.2]},)");
    Scene scene = parsed(text);
    scene.render.light = LightMode::global;
    scene.render.samples = samples;
    scene.render.bounces = 4;
    scene.render.size = {28, 21};
    return scene;
}

/// How far a composited volume is from the flat image, over the pixels within the ball.
struct Difference {
    double rms = 0;
    double mean = 0;   ///< signed
    double error = 0;  ///< the standard error of `mean`, for independent pixels
};

Difference difference(const Volume& volume, const Image& image) {
    const glm::ivec3& size = volume.frame.size;
    const size_t pixels = size_t(size.x) * size_t(size.y);
    std::vector<std::vector<uint32_t>> shown(pixels);
    for (size_t i = 0; i < volume.indices.size(); ++i)
        if (volume.objects[i] != 0) shown[volume.indices[i] % pixels].push_back(volume.objects[i]);
    // Pixels of the flat image are means over their area, so outlines are left out.
    const std::vector<uint32_t> through_ball = {2, 2, 1};
    const auto is_within = [&](size_t pixel) {
        const int u = int(pixel) % size.x, v = int(pixel) / size.x;
        if (u == 0 || v == 0 || u + 1 == size.x || v + 1 == size.y) return false;
        for (int y = v - 1; y <= v + 1; ++y)
            for (int x = u - 1; x <= u + 1; ++x)
                if (shown[size_t(x + y * size.x)] != through_ball) return false;
        return true;
    };
    const std::vector<glm::dvec3> flat = flattened(volume, glm::dvec3(0));
    double sum = 0, squares = 0;
    int count = 0;
    for (size_t i = 0; i < pixels; ++i) {
        if (!is_within(i)) continue;
        for (int c = 0; c < 3; ++c) {
            const double off = flat[i][c] - double(image.planes.at(std::string(1, "RGB"[c]))[i]);
            sum += off, squares += off * off;
            ++count;
        }
    }
    EXPECT_GT(count, 100);
    const double mean = sum / count;
    return {std::sqrt(squares / count), mean,
            std::sqrt(std::max(squares / count - mean * mean, 0.0) / (count / 3))};
}

struct Case {
    const char* name;
    const char* material;
    const char* world;
};

constexpr const char* kClear = R"("color": [0.8, 0.3, 0.2], "opacity": 0.4)";

constexpr Case kCases[] = {
    {"clear", kClear, ""},
    {"mirroring", R"("color": [0.8, 0.3, 0.2], "opacity": 0.5, "reflection": 0.4)", ""},
    {"tinted", R"("opacity": 0.3, "absorption": [0.2, 1.5, 0.8])", ""},
    {"in a medium", kClear,
     R"(, "medium": {"absorption": [0.3, 0.3, 0.3], "color": [0.3, 0.2, 0.1]})"},
    {"physical", R"("base_color": [0.8, 0.5, 0.2], "roughness": 0.4, "opacity": 0.5)", ""}};

TEST(GlobalLayers, LaidOverOneAnotherAreTheFlatImageAsSamplesGrow) {
    for (const Case& one : kCases) {
        const std::string world = std::string(one.world) + kSky;
        Difference found[2];
        for (const int more : {0, 1}) {
            const int samples = more ? 256 : 16;
            Scene scene = global_scene(one.material, world, samples);
            // A lamp that a mirror casts on the wall has too much noise to be compared.
            if (one.name == std::string("mirroring")) scene.lights.clear();
            RenderReport report;
            const Image image = render(shared_device(), scene, report);
            found[more] = difference(volume_of(scene), image);
        }
        const auto& [few, many] = found;
        fmt::print("{}: RMS {:.4f} with 16 samples, {:.4f} with 256; mean {:.5f} +- {:.5f}\n",
                   one.name, few.rms, many.rms, many.mean, many.error);
        EXPECT_LT(many.rms, 0.4 * few.rms) << one.name;
        EXPECT_LT(std::abs(many.mean), 4 * many.error) << one.name;
    }
}

// Without bounces only emission shows, which is a surface's own, behind whatever it lies.
TEST(GlobalLayers, HaveTheirOwnLightAtAnyDepth) {
    const Scene scene = parsed(R"({"voxelume": 1,
"world": {"voxel_size": 0.05, "bounds": {"min": [-1, -1, -1], "max": [1, 1, 1]},
          "sky": {"kind": "constant", "color": [1, 1, 1]}},
"materials": {"one": {"color": [0.2, 0.4, 0.6], "diffuse": 1, "opacity": 0.5},
              "two": {"color": [0.8, 0.5, 0.1], "diffuse": 1, "opacity": 0.25},
              "wall": {"emission": [0.3, 0.2, 0.7]}},
"models": {"pane": {"shape": "box", "size": [3, 3, 0.1], "surface": "exact"}},
"objects": [{"model": "pane", "material": "one", "position": [0, 0, -0.5]},
            {"model": "pane", "material": "two", "position": [0, 0, 0]},
            {"model": "pane", "material": "wall", "position": [0, 0, 0.5]}],
"observer": {"position": [0, 0, -0.9], "look_at": [0, 0, 0],
             "display": {"shape": "box", "size": [1, 1, 1.8], "voxels": [6, 5, 36]}},
"render": {"light": "global", "samples": 64, "bounces": 0}})");
    const Volume volume = volume_of(scene);
    ASSERT_EQ(volume.indices.size(), 6u * 5 * 5);
    for (size_t i = 0; i < volume.indices.size(); ++i) {
        const float clear[] = {0, 0.5f, 0.25f, 1};
        EXPECT_NEAR(volume.opacities[i], clear[volume.objects[i]], 1e-6f);
        const bool shines = volume.objects[i] == 3;
        EXPECT_NEAR(volume.colors[i].z, shines ? 0.7f : 0.0f, 1e-5f) << volume.objects[i];
    }
}

TEST(GlobalLayers, GetTheSamplesThatTheirNoiseNeeds) {
    Scene scene = global_scene(kClear, kSky, 1024);
    RenderReport report;
    const Image image = render(shared_device(), scene, report);
    scene.render.noise.error = 0.02;
    RenderReport of_volume;
    const Volume volume = render_volume(shared_device(), scene, of_volume);
    EXPECT_LT(of_volume.volume_noise.mean(), 0.02);
    EXPECT_GT(of_volume.volume_noise.mean(), 0.002);
    const Difference off = difference(volume, image);
    fmt::print("noise {:.4f}, RMS {:.4f}\n", of_volume.volume_noise.mean(), off.rms);
    EXPECT_LT(std::abs(off.mean), 4 * off.error);
    EXPECT_LT(off.rms, 0.04);
}

// The layers' geometry is that of local light.
TEST(GlobalLayers, HaveTheVoxelsOfLocalLight) {
    for (const Case& one : kCases) {
        Scene scene = global_scene(one.material, std::string(one.world) + kSky, 2);
        const Volume global = volume_of(scene);
        scene.render.light = LightMode::local;
        const Volume local = volume_of(scene);
        EXPECT_EQ(global.indices, local.indices) << one.name;
        EXPECT_EQ(global.objects, local.objects) << one.name;
        EXPECT_EQ(global.depths, local.depths) << one.name;
        float far = 0;
        for (size_t i = 0; i < std::min(global.opacities.size(), local.opacities.size()); ++i)
            far = std::max(far, std::abs(global.opacities[i] - local.opacities[i]));
        EXPECT_LT(far, 1e-6f) << one.name;
    }
}

}  // namespace
}  // namespace voxelume
