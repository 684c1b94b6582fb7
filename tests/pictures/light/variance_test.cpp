// SPDX-License-Identifier: Apache-2.0
// The variance of pixels' means against that of their samples, each rendered alone.
#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <string>
#include <vector>

#include "tests/oracles/image_hash.hpp"
#include "tests/pictures/golden_hash.hpp"
#include "tests/pictures/light/global_light.hpp"

namespace voxelume {
namespace {

constexpr int kSize = 20;
constexpr const char* kLightColors[] = {"R", "G", "B"};

/// A ball on a floor, under a sky and a point light.
Scene varied_scene(const char* light, int samples) {
    Json json = open_furnace(samples);
    json["materials"]["clay"] = {{"color", {0.6, 0.5, 0.4}}};
    json["world"]["sky"] = {
        {"kind", "gradient"}, {"zenith", {0.2, 0.4, 1}}, {"horizon", {1, 0.8, 0.6}}};
    json["render"]["light"] = light;
    json["render"]["bounces"] = 3;
    add_thing(json, {{"shape", "box"}, {"size", {1.1, 0.1, 1.1}}, {"surface", "exact"}}, "clay",
              {0, -0.4, 0});
    add_thing(json, {{"shape", "sphere"}, {"radius", 0.2}, {"surface", "exact"}}, "clay",
              {0.15, -0.2, 0.1});
    json["lights"] = {{{"type", "point"}, {"position", {0.3, 0.45, -0.4}}, {"intensity", 0.3}}};
    send_rays(json, {0, 0, -0.55}, {0, -0.2, 1}, 1, kSize);
    Scene scene = parse_scene(json.dump(), "variance", {});
    scene.render.channels.variance = true;
    return scene;
}

Image varied_image(const Scene& scene, int lanes = 0) {
    RenderReport report;
    return render(test_device(lanes), scene, report);
}

const Plane<float>& variance_in(const Image& image, const char* color) {
    return image.planes.at(std::string("variance.") + color);
}

/// A plane's pixels in each of the samples of a scene alone.
std::vector<std::vector<double>> each_sample_of(Scene scene, const char* color) {
    const int samples = scene.render.samples;
    std::vector<std::vector<double>> values;
    scene.render.noise = {};
    scene.render.adaptive = 0;
    scene.render.samples = 1;
    for (scene.render.first_sample = 0; scene.render.first_sample < samples;
         ++scene.render.first_sample) {
        const Image image = varied_image(scene);
        const Plane<float>& plane = image.planes.at(color);
        values.emplace_back(plane.begin(), plane.end());
    }
    return values;
}

/// The variance of the mean of the first `count` samples of a pixel.
double true_variance(const std::vector<std::vector<double>>& samples, size_t count, size_t pixel) {
    double mean = 0, squares = 0;
    for (size_t i = 0; i < count; ++i) mean += samples[i][pixel] / double(count);
    for (size_t i = 0; i < count; ++i) squares += std::pow(samples[i][pixel] - mean, 2);
    return squares / (double(count) * double(count - 1));
}

class LightVariance : public testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(Lights, LightVariance, testing::Values("local", "global"));

// A sum of 7 squares in floats is right within 7 half units of the last bit, 4e-7, and so is the
// mean that deviations are measured from; 1e-12 is the square of what a mean of 3 is rounded by.
TEST_P(LightVariance, IsThatOfThePixelsSamples) {
    const Scene scene = varied_scene(GetParam(), 7);
    const Image image = varied_image(scene);
    int varied = 0;
    for (const char* color : kLightColors) {
        const auto samples = each_sample_of(scene, color);
        const Plane<float>& plane = variance_in(image, color);
        for (size_t pixel = 0; pixel < plane.size(); ++pixel) {
            const double truth = true_variance(samples, 7, pixel);
            ASSERT_NEAR(plane[pixel], truth, 1e-5 * truth + 1e-12) << color << pixel;
            varied += int(truth > 1e-6);
        }
    }
    EXPECT_GT(varied, 50);
}

TEST(Variance, OfOneSampleIsInfiniteAndNeedsNoColor) {
    Scene scene = varied_scene("local", 1);
    scene.render.channels.color = false;
    const Image image = varied_image(scene);
    EXPECT_FALSE(image.planes.contains("R"));
    EXPECT_FALSE(image.planes.contains("A"));
    for (const char* color : kLightColors)
        for (const float value : variance_in(image, color)) ASSERT_EQ(value, INFINITY);
}

TEST(Variance, ChangesNoOtherChannel) {
    Scene scene = varied_scene("global", 5);
    const Image with = varied_image(scene);
    scene.render.channels.variance = false;
    const Image without = varied_image(scene);
    ASSERT_EQ(with.planes.size(), without.planes.size() + 3);
    for (const auto& [name, plane] : without.planes) EXPECT_TRUE(with.planes.at(name) == plane);
    EXPECT_TRUE(with.id_planes == without.id_planes);
}

// Sums of squares are joined up to twice here, from means that are rounded to floats: 64 of them
// differ by a few times 6e-8 of numbers up to ten times their deviations.
TEST(Variance, OfANoiseTargetIsThatOfTheSamplesOfEachTile) {
    Scene scene = varied_scene("global", 64);
    scene.render.noise.error = 0.03;
    scene.render.channels.samples = true;
    const Image image = varied_image(scene);
    const auto samples = each_sample_of(scene, "G");
    std::set<float> counts;
    for (size_t pixel = 0; pixel < samples[0].size(); ++pixel) {
        const float count = image.planes.at("samples")[pixel];
        counts.insert(count);
        const double truth = true_variance(samples, size_t(count), pixel);
        ASSERT_NEAR(variance_in(image, "G")[pixel], truth, 1e-4 * truth + 1e-12) << pixel;
    }
    EXPECT_GT(counts.size(), 1u);
}

// A sample's light and the mean of the 8 others are floats, as above.
TEST(Variance, OfAnAdaptiveImageIsThatOfThePixelsThatContrast) {
    Scene scene = varied_scene("local", 9);
    scene.render.adaptive = 0.1;
    scene.render.channels.samples = true;
    const Image image = varied_image(scene);
    const auto samples = each_sample_of(scene, "B");
    int contrasting = 0;
    for (size_t pixel = 0; pixel < samples[0].size(); ++pixel) {
        const float variance = variance_in(image, "B")[pixel];
        if (image.planes.at("samples")[pixel] == 1) {
            ASSERT_EQ(variance, INFINITY);
            continue;
        }
        ++contrasting;
        const double truth = true_variance(samples, 9, pixel);
        ASSERT_NEAR(variance, truth, 1e-4 * truth + 1e-12) << pixel;
    }
    EXPECT_GT(contrasting, 20);
    EXPECT_LT(contrasting, kSize * kSize - 20);
}

TEST(Variance, HasTheSameBitsOnAnyNumberOfLanes) {
    for (const int lanes : lanes_with_all())
        expect_golden("variance/global",
                      oracle::image_hash(varied_image(varied_scene("global", 5), lanes)));
}

}  // namespace
}  // namespace voxelume
