// SPDX-License-Identifier: Apache-2.0
// Adaptive images against those with one sample a pixel and with all.
#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "runtime/render/contrast.hpp"
#include "runtime/render/renderer.hpp"
#include "runtime/scene_file/read_scene.hpp"
#include "tests/support/test_device.hpp"

namespace voxelume {
namespace {

constexpr int kSamples = 9;

/// A mirror and a box of cubes on a floor that ends before a background.
Scene scene_with(int samples, double adaptive) {
    Scene scene = parse_scene(R"({"voxelume": 1,
"world": {"voxel_size": 0.1, "bounds": {"min": [-2, -0.4, -2], "max": [2, 1.6, 2]},
          "background": [0.2, 0.3, 0.5], "ambient": [0.2, 0.2, 0.2]},
"materials": {"tiles": {"color": [0.8, 0.7, 0.2], "checker": {"color": [0.3, 0.1, 0.1], "size": 1}},
              "mirror": {"color": [0.9, 0.9, 1], "diffuse": 0.3, "reflection": 0.6}},
"models": {"floor": {"shape": "box", "size": [4, 0.2, 4], "surface": "exact"},
           "ball": {"shape": "sphere", "radius": 0.6, "surface": "smooth"},
           "box": {"shape": "box", "size": [0.6, 0.6, 0.6], "surface": "cubes", "set": "solid"}},
"objects": [{"model": "floor", "material": "tiles", "position": [0, -0.1, 0]},
            {"model": "ball", "material": "mirror", "position": [-0.3, 0.6, 0.2]},
            {"model": "box", "position": [0.9, 0.3, -0.6], "turn": [20, 0, 0]}],
"lights": [{"type": "point", "position": [2, 4, -4], "intensity": 30, "group": "key"}],
"observer": {"position": [0.4, 1.3, -4], "look_at": [0, 0.4, 0],
             "display": {"shape": "pyramid", "angle": 42}},
"render": {"size": [93, 70]}})",
                              "adaptive", {});
    scene.render.samples = samples;
    scene.render.adaptive = adaptive;
    return scene;
}

struct AdaptiveImage {
    Image image;
    RenderReport report;
};

AdaptiveImage adaptive_image(const Scene& scene, int lanes = 0) {
    AdaptiveImage r;
    r.image = render(test_device(lanes), scene, r.report);
    return r;
}

constexpr const char* kColors[] = {"R", "G", "B"};

double distance(const Image& a, const Image& b, size_t pixel) {
    double square = 0;
    for (const char* color : kColors)
        square += std::pow(a.planes.at(color)[pixel] - b.planes.at(color)[pixel], 2);
    return std::sqrt(square);
}

double error(const Image& image, const Image& truth) {
    double squares = 0;
    const size_t pixels = image.planes.at("R").size();
    for (size_t i = 0; i < pixels; ++i) squares += std::pow(distance(image, truth, i), 2);
    return std::sqrt(squares / double(pixels));
}

void expect_same_bits(const Image& a, const Image& b) {
    EXPECT_EQ(a.planes, b.planes);
    EXPECT_EQ(a.id_planes, b.id_planes);
}

TEST(Adaptive, GivesAllSamplesToPixelsThatContrastAndOneToOthers) {
    const Image one = adaptive_image(scene_with(1, 0)).image,
                all = adaptive_image(scene_with(kSamples, 0)).image;
    const AdaptiveImage adaptive = adaptive_image(scene_with(kSamples, 0.05));
    const std::vector<uint32_t> list = contrasting_pixels(one, 0.05);
    const std::set<uint32_t> contrasting(list.begin(), list.end());
    EXPECT_EQ(adaptive.report.contrasting_pixels, contrasting.size());
    EXPECT_EQ(adaptive.report.sight_rays,
              24 * 18 * 16 + (contrasting.size() + 15) / 16 * 16 * (kSamples - 1));
    for (uint32_t pixel = 0; pixel < 93 * 70; ++pixel) {
        if (contrasting.contains(pixel))
            EXPECT_LT(distance(adaptive.image, all, pixel), 1e-6) << pixel;
        else
            EXPECT_EQ(distance(adaptive.image, one, pixel), 0) << pixel;
    }
    const double of_one = error(one, all), of_adaptive = error(adaptive.image, all);
    fmt::print("{} of {} pixels; error {:.5f} with one sample, {:.5f} adaptive\n",
               contrasting.size(), 93 * 70, of_one, of_adaptive);
    EXPECT_LT(double(contrasting.size()), 0.55 * 93 * 70);
    EXPECT_LT(of_adaptive, 0.2 * of_one);
}

TEST(Adaptive, IsAsBeforeWhereNothingIsAskedFor) {
    const AdaptiveImage one = adaptive_image(scene_with(1, 0)),
                        adaptive = adaptive_image(scene_with(1, 0.5));
    expect_same_bits(one.image, adaptive.image);
    EXPECT_EQ(adaptive.report.contrasting_pixels, 0u);
    Scene global = scene_with(2, 0);
    global.render.light = LightMode::global;
    const AdaptiveImage all = adaptive_image(global);
    global.render.adaptive = 0.5;
    expect_same_bits(all.image, adaptive_image(global).image);
}

TEST(Adaptive, HasTheSameBitsWithEachNumberOfLanes) {
    if (!is_exhaustive()) GTEST_SKIP() << kOnlyWithAll;
    const Image image = adaptive_image(scene_with(kSamples, 0.05)).image;
    for (const int lanes : lanes_with_all())
        expect_same_bits(image, adaptive_image(scene_with(kSamples, 0.05), lanes).image);
}

TEST(Adaptive, HasInPartsOfAPictureTheBitsOfTheWhole) {
    Scene whole = scene_with(kSamples, 0.05);
    whole.render.filter = {FilterShape::blackman_harris, 4.5};
    const Image image = adaptive_image(whole).image;
    for (const auto& [first, size] : {std::pair{glm::ivec2(0, 0), glm::ivec2(31, 22)},
                                      {glm::ivec2(17, 21), glm::ivec2(33, 30)},
                                      {glm::ivec2(62, 1), glm::ivec2(31, 69)}}) {
        Scene part = whole;
        crop(part, first, size);
        const Image cropped = adaptive_image(part).image;
        EXPECT_EQ(cropped.first, first);
        EXPECT_EQ(cropped.frame, glm::ivec2(93, 70));
        Image expected = part_of(image, first, size);
        expect_same_bits(cropped, expected);
    }
}

TEST(Adaptive, HasTheChannelsThatAreAskedFor) {
    const Image all = adaptive_image(scene_with(kSamples, 0.05)).image;
    Scene scene = scene_with(kSamples, 0.05);
    scene.render.channels = {
        .color = true, .depth = false, .position = true, .normal = false, .object = false};
    const Image some = adaptive_image(scene).image;
    EXPECT_EQ(some.planes.size(), 7u);
    EXPECT_TRUE(some.id_planes.empty());
    for (const auto& [name, plane] : some.planes) EXPECT_EQ(plane, all.planes.at(name)) << name;
    scene.render.channels.color = false;
    const Image places = adaptive_image(scene).image;
    EXPECT_EQ(places.planes.size(), 3u);
    for (const auto& [name, plane] : places.planes) EXPECT_EQ(plane, all.planes.at(name)) << name;
}

TEST(Adaptive, PassesOfTheLightAddUp) {
    Scene scene = scene_with(kSamples, 0.05);
    scene.render.channels.direct = scene.render.channels.indirect = true;
    scene.render.channels.light_groups = true;
    const Image image = adaptive_image(scene).image;
    expect_same_bits(adaptive_image(scene_with(kSamples, 0.05)).image, [&] {
        Image plain = image;
        std::erase_if(plain.planes, [](const auto& plane) {
            return plane.first.find("ect.") != plane.first.npos ||
                   plane.first.starts_with("light_");
        });
        return plain;
    }());
    for (const char* color : kColors)
        for (size_t i = 0; i < 93 * 70; ++i) {
            const auto value = [&](const std::string& pass) {
                return image.planes.at(pass + "." + color)[i];
            };
            EXPECT_NEAR(image.planes.at(color)[i], value("direct") + value("indirect"), 1e-5);
            EXPECT_NEAR(image.planes.at(color)[i], value("light_key") + value("light_rest"), 1e-5);
        }
}

TEST(Adaptive, MattesCoverWhatTheImageCovers) {
    Scene scene = scene_with(kSamples, 0.05);
    scene.render.channels.object_matte = true;
    const Image image = adaptive_image(scene).image;
    scene.render.adaptive = 0;
    const Image all = adaptive_image(scene).image;
    const std::vector<uint32_t> contrasting =
        contrasting_pixels(adaptive_image(scene_with(1, 0)).image, 0.05);
    for (const uint32_t i : contrasting)
        for (const char* channel : {"CryptoObject00.R", "CryptoObject00.G", "CryptoObject00.A"}) {
            const float second = all.planes.at("CryptoObject00.A")[i];
            if (second == all.planes.at("CryptoObject00.G")[i])
                continue;  // ranked by names or bits
            EXPECT_NEAR(image.planes.at(channel)[i], all.planes.at(channel)[i], 1e-6) << channel;
        }
    for (size_t i = 0; i < 93 * 70; ++i) {
        double sum = 0;
        for (const char* layer : {"00", "01", "02"})
            for (const char* share : {"G", "A"})
                sum += double(image.planes.at(fmt::format("CryptoObject{}.{}", layer, share))[i]);
        EXPECT_NEAR(sum, image.planes.at("A")[i], 1e-6);
    }
}

}  // namespace
}  // namespace voxelume
