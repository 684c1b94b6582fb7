// SPDX-License-Identifier: Apache-2.0
// Images whose samples are added until their noise is small enough.
#include <gtest/gtest.h>

#include "tests/pictures/light/global_light.hpp"

namespace voxelume {
namespace {

/// A floor under a sky. Half of the floor lies under a roof, so smooth light is next to noisy
/// light; above both is only the sky.
Scene noisy_scene(double error, int samples) {
    Json json = open_furnace(samples);
    json["materials"]["clay"] = {{"color", {0.6, 0.5, 0.4}}};
    json["world"]["sky"] = {
        {"kind", "gradient"}, {"zenith", {0.2, 0.4, 1}}, {"horizon", {1, 0.8, 0.6}}};
    json["render"]["bounces"] = 4;
    add_thing(json, {{"shape", "box"}, {"size", {1.1, 0.1, 1.1}}, {"surface", "exact"}}, "clay",
              {0, -0.4, 0});
    add_thing(json, {{"shape", "box"}, {"size", {0.5, 0.02, 0.8}}, {"surface", "exact"}}, "clay",
              {-0.3, -0.2, 0.1});
    send_rays(json, {0, 0, -0.55}, {0, -0.2, 1}, 1, 32);
    Scene scene = parse_scene(json.dump(), "noise", {});
    scene.render.noise.error = error;
    return scene;
}

struct NoisyImage {
    Image image;
    RenderReport report;
};

NoisyImage rendered_to(double error, int samples, int lanes = 0) {
    NoisyImage r;
    r.image = render(test_device(lanes), noisy_scene(error, samples), r.report);
    return r;
}

/// The root mean square over tiles of their relative errors.
double error_of(const Image& image, const Image& truth) {
    double squares = 0;
    for (int tile = 0; tile < 64; ++tile) {
        double sum = 0, difference = 0;
        for (int i = 0; i < 16; ++i) {
            const int x = tile % 8 * 4 + i % 4, y = tile / 8 * 4 + i / 4;
            const size_t at = size_t(y * 32 + x);
            const auto luminance = [&](const Image& of) {
                return 0.2126 * double(of.planes.at("R")[at]) +
                       0.7152 * double(of.planes.at("G")[at]) +
                       0.0722 * double(of.planes.at("B")[at]);
            };
            sum += luminance(truth);
            difference += std::pow(luminance(image) - luminance(truth), 2);
        }
        squares += difference * 16 / (sum * sum) / 64;
    }
    return std::sqrt(squares);
}

TEST(Noise, IsWhatWasAskedForWithFewerSamplesWhereLightIsSmooth) {
    const int samples = is_exhaustive() ? 4096 : 1024;
    const NoisyImage truth = rendered_to(0, samples);
    std::vector<uint64_t> rays;
    for (const double target : {0.08, 0.02}) {
        const NoisyImage r = rendered_to(target, samples);
        const double error = error_of(r.image, truth.image);
        fmt::print("asked {}, said {:.4f}, is {:.4f}, {:.1f} samples a pixel\n", target,
                   r.report.noise.mean(), error, double(r.report.sight_rays) / 1024);
        EXPECT_EQ(r.report.noise.tiles, 64u);
        EXPECT_LE(r.report.noise.mean(), target);
        EXPECT_LT(error, 1.5 * target);
        EXPECT_GT(error, 0.2 * target);
        EXPECT_LT(double(r.report.sight_rays), 0.5 * double(truth.report.sight_rays));
        rays.push_back(r.report.sight_rays);
    }
    EXPECT_GT(rays[1], 2 * rays[0]);
}

/// A shining block before black, all of whose edges are parallel to the picture's.
Scene block_scene(LightMode light, double error, int samples) {
    Scene scene = parse_scene(R"({"voxelume": 1,
"world": {"voxel_size": 0.1, "bounds": {"min": [-1, -1, -1], "max": [1, 1, 1]}},
"materials": {"lamp": {"color": [0, 0, 0], "emission": [3, 3, 3]}},
"models": {"block": {"shape": "box", "size": [1.2, 0.8, 0.6], "surface": "exact"}},
"objects": [{"model": "block", "material": "lamp"}], "lights": [],
"observer": {"position": [0, 0, -3], "look_at": [0, 0, 0],
             "display": {"shape": "box", "size": [1.957, 1.957, 5]}},
"render": {"size": [32, 32]}})",
                              "block", {});
    scene.render.light = light;
    scene.render.noise.error = error;
    scene.render.samples = samples;
    return scene;
}

// Samples at the same places in all pixels would all miss the same part of such edges, and agree
// about it.
TEST(Noise, IsThatOfStraightEdges) {
    for (const LightMode light : {LightMode::global, LightMode::local}) {
        RenderReport report;
        const Image image = render(test_device(), block_scene(light, 0.02, 1024), report);
        double sum = 0, largest = 0, covered = 0;
        for (int tile = 0; tile < 64; ++tile) {
            double seen = 0, squares = 0, whole = 0;
            for (int i = 0; i < 16; ++i) {
                const int x = tile % 8 * 4 + i % 4, y = tile / 8 * 4 + i / 4;
                // The part of the pixel that lies within 0.6 and 0.4 metres of the middle.
                const double pixel = 1.957 / 32;
                const auto part = [&](int at, double half) {
                    const double from = std::abs((at - 15.5) * pixel) - pixel / 2;
                    return std::clamp((half - from) / pixel, 0.0, 1.0);
                };
                const double exact = 3 * part(x, 0.6) * part(y, 0.4);
                const double shown = double(image.planes.at("G")[size_t(y * 32 + x)]);
                seen += shown, whole += exact, squares += std::pow(shown - exact, 2);
            }
            sum += seen, covered += whole;
            if (whole > 0.5) largest = std::max(largest, 4 * std::sqrt(squares) / whole);
        }
        fmt::print("said {:.4f}, largest of a tile {:.4f}, sum {:+.4f}\n", report.noise.mean(),
                   largest, sum / covered - 1);
        EXPECT_LE(report.noise.mean(), 0.02);
        EXPECT_LT(largest, 3 * 0.02);
        EXPECT_LT(std::abs(sum / covered - 1), 0.002);
    }
}

TEST(Noise, TakesNoMoreSamplesThanTheMaximum) {
    const NoisyImage r = rendered_to(1e-6, 100);
    EXPECT_LE(r.report.sight_rays, 64u * 1024);  // doubled from 16 on, but for the sky
    EXPECT_GT(r.report.sight_rays, 40u * 1024);
    EXPECT_GT(r.report.noise.mean(), 1e-6);
    Scene scene = noisy_scene(1e-6, 4096);
    scene.render.noise.seconds = 1e-9;
    RenderReport report;
    render(test_device(), scene, report);
    EXPECT_EQ(report.sight_rays, 16u * 1024);
    EXPECT_EQ(report.noise.tiles, 0u);
}

TEST(Noise, AddsSamplesToThoseOfAShorterRun) {
    // The mean of both halves is the image of all samples, except for rounding.
    const NoisyImage both = rendered_to(1e-6, 32), once = rendered_to(0, 32);
    for (const char* channel : {"R", "G", "B", "A"})
        for (size_t i = 0; i < 1024; ++i)
            ASSERT_NEAR(both.image.planes.at(channel)[i], once.image.planes.at(channel)[i], 1e-5f)
                << channel << i;
}

TEST(Noise, LeavesMattesAndNumbersAsTheFirstSamplesHaveThem) {
    const auto rendered = [](double error, int samples) {
        Scene scene = noisy_scene(error, samples);
        scene.render.channels.object_matte = scene.render.channels.material_matte = true;
        RenderReport report;
        return render(test_device(), scene, report);
    };
    // Buffers of the second image lie where those of the first one did, full of its light.
    const Image first = rendered(0, 16), more = rendered(0.02, 1024);
    for (const auto& [name, plane] : first.planes)
        EXPECT_EQ(more.planes.at(name) == plane, name.size() > 1 || name == "Z") << name;
    EXPECT_TRUE(more.id_planes == first.id_planes);
    EXPECT_TRUE(more.attributes == first.attributes);
}

TEST(Noise, AddsNoSamplesWhereNoLightIsAskedFor) {
    Scene scene = noisy_scene(0.02, 4096);
    scene.render.channels.color = false;
    RenderReport report;
    render(test_device(), scene, report);
    EXPECT_EQ(report.sight_rays, 16u * 1024);
    EXPECT_EQ(report.noise.tiles, 0u);
}

TEST(Noise, DoesNotTakeSurfacesForDarkByTheirFirstSamples) {
    for (const bool is_covered : {true, false}) {
        Scene scene = noisy_scene(0.05, 4096);
        scene.world.sky.reset();
        scene.world.background = glm::vec3(0);
        if (!is_covered) scene.objects.clear();
        crop(scene, {12, 24}, {8, 8});  // of the floor
        RenderReport report;
        render(test_device(), scene, report);
        EXPECT_EQ(report.sight_rays, (is_covered ? 256u : 32u) * 64);
        EXPECT_EQ(report.noise.mean(), 0);
    }
}

TEST(Noise, GivesPassesTheSamplesOfAllLight) {
    const NoisyImage alone = rendered_to(0.05, 256);
    Scene scene = noisy_scene(0.05, 256);
    scene.render.channels.direct = scene.render.channels.light_groups = true;
    for (const bool has_color : {true, false}) {
        scene.render.channels.color = has_color;
        RenderReport report;
        const Image image = render(test_device(), scene, report);
        EXPECT_EQ(report.sight_rays, 3 * alone.report.sight_rays);
        EXPECT_EQ(report.noise.tiles, 64u);
        EXPECT_EQ(report.noise.mean(), alone.report.noise.mean());
        EXPECT_EQ(image.planes.contains("R"), has_color);
        EXPECT_EQ(image.planes.contains("A"), has_color);
        // No light is of a group.
        for (const char* color : {"R", "G", "B"})
            EXPECT_TRUE(image.planes.at(fmt::format("light_rest.{}", color)) ==
                        alone.image.planes.at(color));
    }
}

TEST(Noise, HasTheSameBitsOnAnyNumberOfLanesAndForEachTileAlone) {
    const NoisyImage whole = rendered_to(0.05, 256, 0);
    for (const int lanes : lanes_with_all()) {
        const NoisyImage other = rendered_to(0.05, 256, lanes);
        EXPECT_EQ(other.report.sight_rays, whole.report.sight_rays);
        EXPECT_TRUE(other.image.planes == whole.image.planes) << lanes;
    }
    Scene scene = noisy_scene(0.05, 256);
    crop(scene, {8, 16}, {12, 8});
    RenderReport report;
    const Image part = render(test_device(), scene, report);
    for (int y = 0; y < 8; ++y)
        for (int x = 0; x < 12; ++x)
            ASSERT_EQ(part.planes.at("G")[size_t(y * 12 + x)],
                      whole.image.planes.at("G")[size_t((y + 16) * 32 + x + 8)]);
}

TEST(Noise, IsMeasuredInPartsOfWholeTilesAlone) {
    Scene scene = noisy_scene(0.05, 256);
    resize(scene, {30, 31});
    const auto expect_refusal = [&scene](glm::ivec2 first, glm::ivec2 size) {
        Scene part = scene;
        try {
            crop(part, first, size);
            FAIL() << first.x << ' ' << first.y << ' ' << size.x << ' ' << size.y;
        } catch (const Error& error) {
            EXPECT_EQ(error.kind(), ErrorKind::usage);
            EXPECT_NE(std::string(error.what()).find("multiples of 4"), std::string::npos);
        }
    };
    expect_refusal({9, 10}, {12, 8});
    expect_refusal({8, 8}, {12, 9});
    expect_refusal({8, 8}, {13, 8});
    crop(scene, {8, 8}, {12, 8});
    Scene to_the_edge = scene;
    crop(to_the_edge, {8, 8}, {22, 23});
    scene.render.noise = {};
    crop(scene, {9, 10}, {12, 9});
}

}  // namespace
}  // namespace voxelume
