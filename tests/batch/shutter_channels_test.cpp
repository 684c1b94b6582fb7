// SPDX-License-Identifier: Apache-2.0
// Channels of images whose samples show several moments.
#include <gmock/gmock.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <string>

#include "tests/batch/blurred_frames.hpp"

namespace voxelume {
namespace {

/// Where the only channel is the position, its points equal those of an image with more channels.
TEST(ShutterChannels, PointsAloneAreThoseOfAnImageWithDepths) {
    Scene scene = scene_of(blurred_json());
    const Image all = *rendered(scene).image;
    scene.render.channels = {false, false, true, false, false};
    const Image points = *rendered(scene).image;
    EXPECT_EQ(points.planes.size(), 3u);
    for (const auto& [name, plane] : points.planes)
        EXPECT_TRUE(plane == all.planes.at(name)) << name;
}

/// The variance of the mean of a pixel's samples, by its definition.
double variance_of(const std::vector<Image>& samples, const char* color, size_t pixel) {
    const auto count = double(samples.size());
    double mean = 0, squares = 0;
    for (const Image& sample : samples) mean += double(sample.planes.at(color)[pixel]) / count;
    for (const Image& sample : samples)
        squares += std::pow(double(sample.planes.at(color)[pixel]) - mean, 2);
    return squares / (count * (count - 1));
}

/// Each join adds a square of a difference of means, which are rounded by 1e-7: of 8 samples
/// within 1e-5 of the variance, and within the square of what a mean of 1 is rounded by.
TEST(ShutterChannels, VarianceIsThatOfTheSamplesOfAllMoments) {
    Scene scene = scene_of(blurred_json());
    scene.render.channels.variance = true;
    const Image image = *rendered(scene).image;
    const std::vector<Image> samples = samples_alone(scene);
    for (const char* color : {"R", "G", "B"}) {
        const Plane<float>& plane = image.planes.at(std::string("variance.") + color);
        for (size_t pixel = 0; pixel < plane.size(); ++pixel) {
            const double truth = variance_of(samples, color, pixel);
            ASSERT_NEAR(double(plane[pixel]), truth, 1e-5 * truth + 1e-12) << color << pixel;
        }
    }
}

/// The part of a pixel that an object covers, from a matte's ranks.
double share_in(const Image& image, size_t pixel, float id) {
    for (const char* layer : {"CryptoObject00", "CryptoObject01", "CryptoObject02"})
        for (const auto& [number, share] : {std::pair{".R", ".G"}, std::pair{".B", ".A"}})
            if (image.planes.at(std::string(layer) + number)[pixel] == id)
                return double(image.planes.at(std::string(layer) + share)[pixel]);
    return 0;
}

TEST(ShutterChannels, MattesHaveTheSharesOfAllMoments) {
    Scene scene = scene_of(blurred_json());
    scene.render.channels.object_matte = true;
    const Image image = *rendered(scene).image;
    const std::vector<Image> samples = samples_alone(scene);
    std::set<float> ids;
    for (const Image& sample : samples)
        for (const float id : sample.planes.at("CryptoObject00.R")) ids.insert(id);
    ids.erase(0.0f);
    EXPECT_EQ(ids.size(), 3u);
    int shared = 0;
    for (size_t pixel = 0; pixel < image.planes.at("R").size(); ++pixel) {
        double before = 1;
        for (const float id : ids) {
            int of_samples = 0;
            for (const Image& sample : samples) of_samples += int(share_in(sample, pixel, id) > 0);
            ASSERT_EQ(share_in(image, pixel, id), of_samples / 8.0) << pixel;
            shared += int(of_samples > 0 && of_samples < kSamples);
        }
        for (const char* layer : {"CryptoObject00", "CryptoObject01"})
            for (const char* rank : {".G", ".A"}) {
                const double share = double(image.planes.at(std::string(layer) + rank)[pixel]);
                ASSERT_LE(share, before);
                before = share;
            }
    }
    EXPECT_GT(shared, 100);
}

TEST(ShutterChannels, PartsOfTheLightAddUpToItsColor) {
    Json json = blurred_json();
    json["lights"][0]["group"] = "key";
    json["render"]["light"] = "global";
    json["render"]["bounces"] = 2;
    Scene scene = scene_of(json);
    scene.render.channels.light_groups = scene.render.channels.albedo = true;
    const Image image = *rendered(scene).image;
    Scene plain = scene;
    plain.render.channels = {};
    EXPECT_TRUE(image.planes.at("R") == rendered(plain).image->planes.at("R"));
    // Paths make equal choices, but up to 3 terms of each of 8 samples are rounded differently,
    // each by 2^-23 of a value up to 3: 9e-6.
    for (size_t pixel = 0; pixel < image.planes.at("R").size(); ++pixel) {
        const float all = image.planes.at("R")[pixel];
        const float sum =
            image.planes.at("light_key.R")[pixel] + image.planes.at("light_rest.R")[pixel];
        ASSERT_NEAR(sum, all, 1e-5f * std::max(all, 1.0f)) << pixel;
    }
    const std::vector<Image> samples = samples_alone(scene);
    for (const char* plane : {"albedo.R", "light_key.R"}) expect_means(image, samples, plane);
}

/// Seven balls pass the middle pixel, one in each of the first samples, before a wall.
TEST(ShutterChannels, MattesKeepWhatCoversMostOfAPixelWhateverPassedBefore) {
    Json json = blurred_json();
    json["observer"]["shutter"] = 1;
    json["render"] = {{"size", {3, 3}}, {"samples", 64}};
    json["observer"]["display"]["angles"] = {1, 1};
    const Json wall = json["objects"][2];
    json["objects"] = Json::array();
    json["animation"]["tracks"] = Json::array();
    for (int ball = 0; ball < 7; ++ball) {
        // The moments of the first samples are 0, 32, 16, 48, 8, 40, 24 64ths.
        const double moment = kFrame + std::array{0, 32, 16, 48, 8, 40, 24}[size_t(ball)] / 64.0;
        const std::string name = "ball" + std::to_string(ball);
        json["objects"].push_back(
            {{"name", name}, {"model", "ball"}, {"position", {0, 9, 0}}, {"visible", false}});
        Json keys = {{{"frame", moment - 0.01}, {"value", {9, 9, 9}}},
                     {{"frame", moment}, {"value", {0, 0, 0}}},
                     {{"frame", moment + 0.01}, {"value", {9, 9, 9}}}};
        json["objects"].back()["visible"] = true;
        json["animation"]["tracks"].push_back({{"target", "objects." + name + ".position"},
                                               {"keys", keys},
                                               {"interpolation", "step"}});
    }
    json["objects"].push_back(wall);  // its number is the highest: it loses ties
    Scene scene = scene_of(json);
    scene.render.channels.object_matte = true;
    const Image image = *rendered(scene).image;
    EXPECT_EQ(image.planes.at("CryptoObject00.G")[4], 57.0f / 64);
    for (const char* rank : {"CryptoObject00.A", "CryptoObject01.G", "CryptoObject02.A"})
        EXPECT_EQ(image.planes.at(rank)[4], 1.0f / 64) << rank;
}

/// A light with an area fades in, which only some moments' direct light is traced for.
TEST(ShutterChannels, DirectLightIsThatOfEachMoment) {
    Json json = blurred_json();
    json["render"]["light"] = "global";
    json["materials"]["blue"] = {
        {"base_color", {0.8, 0.8, 0.8}}, {"metallic", 1}, {"roughness", 0.3}};
    json["lights"] = {{{"name", "key"},
                       {"type", "disk"},
                       {"position", {0, 2, -2}},
                       {"direction", {0, -1, 1}},
                       {"radius", 1},
                       {"intensity", 20}}};
    json["animation"]["tracks"] =
        Json::array({track("lights.key.intensity", 0, 50, kFrame, kFrame + 1)});
    Scene scene = scene_of(json);
    scene.render.channels.direct = true;
    const Image image = *rendered(scene).image;
    expect_means(image, samples_alone(scene), "direct.R");
}

}  // namespace
}  // namespace voxelume
