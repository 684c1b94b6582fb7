// SPDX-License-Identifier: Apache-2.0
// Voxels of a lattice with several samples: borders of colours, objects and shadows within a voxel
// mix as they do in flat pictures.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <string>
#include <utility>
#include <vector>

#include "runtime/render/renderer.hpp"
#include "tests/support/display_fixture.hpp"
#include "tests/support/exhaustive.hpp"

namespace voxelume {
namespace {

constexpr int kColumns = 36, kRows = 32, kLayers = 34;
constexpr float kFront = 0.913f;  // depth of the wall

/// A checkered wall across the observer's way, half of it in the shadow of a ball next to the
/// display. A pixel of the flat picture is as large as a display voxel, and both show the wall in
/// one layer of voxels.
std::string wall_scene(const char* surface, const char* placement, const char* opacity) {
    return fmt::format(R"({{"voxelume": 1,
"world": {{"voxel_size": 0.04, "bounds": {{"min": [-1, -1, -1.9], "max": [1, 1, 1]}},
          "ambient": [0.1, 0.12, 0.14]}},
"materials": {{"check": {{"color": [0.9, 0.2, 0.1], "opacity": {},
                        "checker": {{"color": [0.1, 0.7, 0.9], "size": [0.17, 0.23, 0]}}}}}},
"models": {{"wall": {{"shape": "box", "size": [1.6, 1.5, 0.3], "surface": "{}"}},
           "ball": {{"shape": "sphere", "radius": 0.4}}}},
"objects": [{{"model": "wall", "material": "check", "placement": "{}", "position": [0.01, 0.02, 0.163]}},
            {{"model": "ball", "position": [0.6, 0.5, -1.3]}}],
"lights": [{{"type": "directional", "direction": [-0.45, -0.2, 1]}}],
"observer": {{"position": [0, 0, -0.9], "look_at": [0, 0, 0],
             "display": {{"shape": "box", "size": [1.8, 1.6, 1.7], "voxels": [{}, {}, {}],
                         "layout": "lattice", "visibility": "observer"}}}},
"render": {{"size": [{}, {}], "samples": 256, "depth": 1}}}})",
                       opacity, surface, placement, kColumns, kRows, kLayers, kColumns, kRows);
}

/// The difference of the wall's voxels from the flat picture, RMS over all channels, without the
/// wall's sides.
double difference(Scene scene, int samples) {
    RenderReport report;
    const Image picture = render(test_device(), scene, report);
    scene.render.samples = samples;
    const Volume volume = volume_of(scene);
    double sum = 0;
    int count = 0;
    for (size_t i = 0; i < volume.indices.size(); ++i) {
        const auto index = int(volume.indices[i]);
        // Image right is -X_E, and down is -Y_E.
        const int u = kColumns - 1 - index % kColumns, v = kRows - 1 - index / kColumns % kRows;
        const size_t pixel = size_t(v * kColumns + u);
        const float alpha = picture.planes.at("A")[pixel];
        if (volume.objects[i] != 1 || std::abs(alpha - volume.opacities[i]) > 0.01f) continue;
        const glm::vec3 seen(picture.planes.at("R")[pixel], picture.planes.at("G")[pixel],
                             picture.planes.at("B")[pixel]);
        const glm::vec3 off = volume.colors[i] * volume.opacities[i] - seen;
        sum += glm::dot(off, off);
        ++count;
    }
    EXPECT_GT(count, 700);
    return std::sqrt(sum / (3.0 * count));
}

TEST(DisplaySamples, MixColorsAndShadowsAsFlatPicturesDo) {
    for (const char* surface : {"exact", "smooth", "cubes"})
        for (const char* placement : {"world", "instance"}) {
            if (std::string(surface) != "exact" && std::string(placement) == "instance") continue;
            const Scene scene = parsed(wall_scene(surface, placement, "1"));
            const double one = difference(scene, 1), four = difference(scene, 4),
                         many = difference(scene, 64);
            fmt::print("{} as {}: RMS {:.4f} with 1 sample, {:.4f} with 4, {:.4f} with 64\n",
                       surface, placement, one, four, many);
            EXPECT_GT(one, 0.05) << surface << placement;
            EXPECT_LT(four, 0.55 * one) << surface << placement;
            EXPECT_LT(many, 0.15 * one) << surface << placement;
        }
}

// In ambient light surfaces look as without the medium before them, whose own light is taken out.
TEST(DisplaySamples, CountTheMediumBeforeSurfacesAsAir) {
    for (const char* density : {R"({"kind": "ball", "center": [0, 0, 0], "radius": 1})",
                                R"({"kind": "height", "base": -9, "scale_height": 9})"}) {
        Scene clear = parsed(wall_scene("exact", "world", "1"));
        clear.lights.clear();
        clear.render.samples = 4;
        std::string text = wall_scene("exact", "world", "1");
        text.insert(text.find("\"ambient\""),
                    fmt::format(R"("medium": {{"absorption": [0.5, 0.7, 0.3],
                                               "color": [0.2, 0.1, 0.4], "density": {}}}, )",
                                density));
        Scene foggy = parsed(text);
        foggy.lights.clear();
        foggy.render.samples = 4;
        const Volume in_air = volume_of(clear), in_fog = volume_of(foggy);
        size_t compared = 0;
        for (size_t i = 0, k = 0; i < in_fog.indices.size() && k < in_air.indices.size(); ++i) {
            while (k < in_air.indices.size() && in_air.indices[k] < in_fog.indices[i]) ++k;
            if (k == in_air.indices.size() || in_air.indices[k] != in_fog.indices[i]) continue;
            if (in_fog.objects[i] == 0) continue;
            ++compared;
            EXPECT_LT(glm::distance(in_air.colors[k], in_fog.colors[i]), 2e-6f) << i;
        }
        EXPECT_GT(compared, 700u) << density;
    }
}

/// A box whose edges lie within voxels, at these parts of them.
constexpr double kFace = 0.3, kSide = 0.8;

TEST(DisplaySamples, MixTheFacesThatMeetInAVoxel) {
    const Scene scene = parsed(fmt::format(R"({{"voxelume": 1,
"world": {{"voxel_size": 0.05, "bounds": {{"min": [-1, -1, -1], "max": [1, 1, 1]}}}},
"models": {{"box": {{"shape": "box", "size": [{}, 1.2, {}]}}}},
"objects": [{{"model": "box"}}],
"lights": [{{"type": "directional", "direction": [1, -0.1, 0.4], "intensity": 1}}],
"observer": {{"position": [0, 0, -1], "look_at": [0, 0, 0],
             "display": {{"shape": "box", "size": [2, 2, 2], "voxels": [20, 20, 20],
                         "layout": "lattice", "visibility": "outside"}}}},
"render": {{"samples": 16, "shadows": false}}}})",
                                           2 * (0.5 + 0.1 * kSide), 2 * (0.5 + 0.1 * kFace)));
    const Volume volume = volume_of(scene);
    const auto color_at = [&](int x, int z) {
        const uint64_t index = uint64_t(x) + 20 * (10 + 20 * uint64_t(z));
        const auto found = std::ranges::find(volume.indices, index);
        EXPECT_NE(found, volume.indices.end()) << x << " " << z;
        return volume.colors[size_t(found - volume.indices.begin())];
    };
    // X_E is -X: the side at low X_W, which is lit, lies at high x.
    const int edge_x = color_at(15, 8).x > color_at(4, 8).x ? 15 : 4;
    const glm::vec3 face = color_at(8, 4), side = color_at(edge_x, 8), edge = color_at(edge_x, 4);
    EXPECT_GT(side.x, 2 * face.x);
    const auto share = float(kSide / (kSide + kFace));  // of the face, in the edge's voxel
    EXPECT_LT(glm::length(edge - glm::mix(side, face, share)), 0.03f * side.x)
        << edge.x << " " << face.x << " " << side.x;
}

TEST(DisplaySamples, OfSurfacesThatLightPassesAreThoseOfOpaqueOnes) {
    Scene opaque = parsed(wall_scene("exact", "world", "1")),
          clear = parsed(wall_scene("exact", "world", "0.5"));
    opaque.render.samples = clear.render.samples = 5;
    const Volume expected = volume_of(opaque), volume = volume_of(clear);
    size_t found = 0, far = 0;
    for (size_t i = 0, j = 0; i < expected.indices.size(); ++i) {
        while (volume.indices[j] < expected.indices[i]) ++j;  // clear ones show the back, too
        const bool is_front = std::abs(expected.depths[i] - kFront) < 1e-4f;
        const auto index = int(expected.indices[i]);
        const int x = index % kColumns, y = index / kColumns % kRows;
        const bool is_rim = x < 4 || y < 4 || x >= kColumns - 4 || y >= kRows - 4;
        if (volume.indices[j] != expected.indices[i] || !is_front || is_rim) continue;
        ++found;
        far += glm::length(volume.colors[j] - expected.colors[i]) > 2e-4f;
    }
    EXPECT_GT(found, 600u);
    EXPECT_EQ(far, 0u);
}

// Whoever no longer wants the image ends it by throwing, so it must not light for long in silence.
TEST(DisplaySamples, TellWhatIsDoneWhileTheyAreLit) {
    for (const auto& [layout, error] : {std::pair{VolumeLayout::lattice, 0.0},
                                        {VolumeLayout::lattice, 0.05},
                                        {VolumeLayout::rays, 0.0},
                                        {VolumeLayout::rays, 0.05}}) {
        Scene scene = parsed(wall_scene("cubes", "world", "0.5"));
        scene.observer.display.layout = layout;
        scene.render.light = LightMode::global;
        scene.render.samples = 64;
        scene.render.noise.error = error;
        std::vector<double> told;
        const auto progress = [&](uint32_t done, uint32_t total) {
            told.push_back(double(done) / total);
        };
        RenderReport report;
        render_volume(shared_device(), scene, report, progress);
        EXPECT_GT(told.size(), 3u) << error;
        EXPECT_TRUE(std::ranges::is_sorted(told)) << error;
        ASSERT_FALSE(told.empty());
        EXPECT_EQ(told.back(), 1) << error;
        const auto is_between = [](double part) { return part > 0 && part < 1; };
        if (error == 0 || layout == VolumeLayout::lattice)
            EXPECT_TRUE(std::ranges::any_of(told, is_between)) << error;
    }
}

TEST(DisplaySamples, LeaveTheVoxelsAsTheyAre) {
    Scene scene = parsed(wall_scene("exact", "world", "1"));
    scene.observer.display.visibility = Visibility::outside;
    scene.render.samples = 1;
    const Volume one = volume_of(scene);
    scene.render.samples = 3;
    const Volume three = volume_of(scene, 16);
    EXPECT_EQ(one.indices, three.indices);
    EXPECT_EQ(one.objects, three.objects);
    EXPECT_EQ(one.opacities, three.opacities);
    EXPECT_EQ(one.depths, three.depths);
    EXPECT_NE(one.colors, three.colors);
    for (const int lanes : in_turn<int>({1, 4, 8}, 1))
        EXPECT_EQ(volume_of(scene, lanes).colors, three.colors) << lanes;
}

}  // namespace
}  // namespace voxelume
