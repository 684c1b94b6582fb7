// SPDX-License-Identifier: Apache-2.0
// Skies that are pictures: what rays see of them, and how they light surfaces, against integrals;
// and the ways agree in which paths find their light.
#include <glm/trigonometric.hpp>
#include <numbers>
#include <set>

#include "runtime/io/image/exr.hpp"
#include "tests/oracles/image_hash.hpp"
#include "tests/pictures/light/global_light.hpp"
#include "tests/support/file_fixture.hpp"

namespace voxelume {
namespace {

/// The radiance of a place of a picture.
using Paint = glm::dvec3 (*)(double u, double v);

/// A sunny sky over a dark ground: the sun is three hundred times as bright, and a thousandth of
/// the picture.
glm::dvec3 sunny(double u, double v) {
    if (v > 0.5) return {0.05, 0.04, 0.03};
    if (std::abs(u - 0.3) < 0.016 && std::abs(v - 0.2) < 0.032) return {300, 250, 200};
    return {0.2 + 0.3 * v, 0.4 + 0.2 * std::sin(2 * std::numbers::pi * u), 0.9};
}

glm::dvec3 white(double, double) {
    return glm::dvec3(1);
}

class SkyMapImage : public FileTest {
  protected:
    /// Writes a picture, and returns a sky that shows it.
    Json painted(Paint paint, int width, int height, int samples = 16) {
        Image image;
        image.width = width, image.height = height;
        for (int c = 0; c < 3; ++c) {
            std::vector<float> values;
            for (int y = 0; y < height; ++y)
                for (int x = 0; x < width; ++x)
                    values.push_back(float(paint((x + 0.5) / width, (y + 0.5) / height)[c]));
            image.planes[std::string(1, "RGB"[c])] = std::move(values);
        }
        write_exr(folder / "around.exr", image, ColorDepth::float32);
        return {{"kind", "map"}, {"file", "around.exr"}, {"samples", samples}};
    }
    Image shown(const Json& scene, int lanes = 0) {
        RenderReport report;
        Image image = render(test_device(lanes),
                             parse_scene(scene.dump(), folder / "scene.json", {}), report);
        EXPECT_EQ(report.not_finite, 0u);
        return image;
    }
    std::vector<double> values_of(const Image& image, const char* channel) {
        const Plane<float>& plane = image.planes.at(channel);
        return {plane.begin(), plane.end()};
    }
    /// A white floor at y = 0 under a sky, seen from above.
    Json floor_under_map(const Json& sky, const char* light, int samples) {
        Json scene = open_furnace(samples);
        scene["world"]["background"] = {1e6, 1e6, 1e6};
        scene["world"]["sky"] = sky;
        add_thing(scene, {{"shape", "box"}, {"size", {1.1, 0.1, 1.1}}, {"surface", "exact"}},
                  "chalk", {0, -0.05, 0});
        scene["observer"]["position"] = {0, 0.1, 0};
        scene["observer"]["turn"] = {0, 90, 0};
        scene["observer"]["display"]["size"] = {0.1, 0.1, 9};
        scene["render"]["size"] = {24, 24};
        scene["render"]["light"] = light;
        return scene;
    }
};

TEST_F(SkyMapImage, AnObserverAllAroundSeesItAsItIs) {
    Json scene = floor_under_map(painted(sunny, 36, 18), "local", 1);
    scene["objects"] = Json::array();
    scene["observer"] = {{"position", {0, 0, 0}},
                         {"turn", {0, 0, 0}},
                         {"display", {{"shape", "ball"}, {"radius", 1}}}};
    scene["render"]["size"] = {36, 18};
    scene["world"]["sky"]["strength"] = 0.5;
    for (const int columns : {0, 9}) {
        // Turned by columns, what was seen there is seen further left.
        scene["world"]["sky"]["rotation"] = 10 * columns;
        const std::vector<double> green = values_of(shown(scene), "G");
        for (int y = 0; y < 18; ++y)
            for (int x = 0; x < 36; ++x) {
                const double expected = 0.5 * sunny((x + 0.5) / 36, (y + 0.5) / 18).y;
                EXPECT_NEAR(green[size_t(y * 36 + (x + 36 - columns) % 36)], expected,
                            2e-4 * (1 + expected))
                    << x << ", " << y;
            }
    }
}

TEST_F(SkyMapImage, LightsAFloorByItsCosineWeightedMean) {
    const Json sky = painted(sunny, 256, 128, 96);
    // The picture is fine enough for the integral to be one of its texels' middles within 1e-3.
    glm::dvec3 expected(0);
    for (int y = 0; y < 64; ++y)
        for (int x = 0; x < 256; ++x) {
            const double theta = std::numbers::pi * (y + 0.5) / 128;
            expected += sunny((x + 0.5) / 256, (y + 0.5) / 128) * std::cos(theta) *
                        std::sin(theta) * (2 * std::numbers::pi / 256) * (std::numbers::pi / 128) /
                        std::numbers::pi;
        }
    for (const char* light : {"local", "global"}) {
        const Image image =
            shown(floor_under_map(sky, light, std::string(light) == "local" ? 1 : 64));
        for (int c = 0; c < 3; ++c) {
            const Estimate e = estimate_of(values_of(image, c == 0 ? "R" : c == 1 ? "G" : "B"));
            EXPECT_LT(e.error, 0.01 * e.mean);
            expect_mean(e, expected[c], std::string(light) + " channel " + std::to_string(c), 2e-3);
        }
    }
}

TEST_F(SkyMapImage, AWhiteOneHidesAllThatReturnsAllLight) {
    Json scene = open_furnace(64);
    scene["world"]["sky"] = painted(white, 16, 8);
    scene["materials"]["metal"] = {{"base_color", {1, 1, 1}}, {"metallic", 1}, {"roughness", 0.3}};
    const Json ball = {{"shape", "sphere"}, {"radius", 0.17}, {"surface", "exact"}};
    add_thing(scene, ball, "chalk", {0.3, 0.25, 0.1});
    add_thing(scene, ball, "mirror", {-0.3, 0.25, 0.1});
    add_thing(scene, ball, "lacquer", {0.3, -0.25, 0.1});
    add_thing(scene, ball, "veil", {-0.3, -0.25, 0.1});
    add_thing(scene, ball, "metal", {0, 0, 0});
    add_thing(scene, ball, "glass", {0, 0.35, 0.3});
    send_rays(scene, {0, 0, -0.55}, {0, 0, 1}, 1, 32);
    expect_mean(estimate_of(values_of(shown(scene), "G")), 1, "white map", 1e-3);
}

TEST_F(SkyMapImage, IsFoundByEveryWayAlike) {
    for (const bool has_emitter : in_turn<char>({false, true}, 1)) {
        Json scene = open_furnace(is_exhaustive() ? 256 : 96);
        scene["world"]["sky"] = painted(sunny, 64, 32);
        scene["materials"]["clay"] = {{"color", {0.7, 0.6, 0.5}}};
        scene["materials"]["brass"] = {
            {"base_color", {0.9, 0.7, 0.3}}, {"metallic", 1}, {"roughness", 0.4}};
        scene["materials"]["lamp"] = {{"color", {0, 0, 0}}, {"emission", {20, 15, 10}}};
        scene["render"]["bounces"] = 3;
        add_thing(scene, {{"shape", "box"}, {"size", {1.1, 0.1, 1.1}}, {"surface", "exact"}},
                  "clay", {0, -0.4, 0});
        const Json ball = {{"shape", "sphere"}, {"radius", 0.15}, {"surface", "exact"}};
        add_thing(scene, ball, "brass", {-0.2, -0.15, 0.1});
        add_thing(scene, ball, "glass", {0.2, -0.2, 0});
        add_thing(scene, {{"shape", "box"}, {"size", {0.4, 0.02, 0.4}}, {"surface", "exact"}},
                  "veil", {0.2, 0.15, 0.1});
        if (has_emitter)
            add_thing(scene, {{"shape", "box"}, {"size", {0.1, 0.1, 0.1}}, {"surface", "exact"}},
                      "lamp", {0.4, 0, 0.3});
        send_rays(scene, {0, 0.1, -0.55}, {0, -0.2, 1}, 0.9, 24);
        std::vector<std::vector<double>> found;
        for (const char* search : {"both", "paths", "rays"}) {
            scene["render"]["emitters"] = search;
            found.push_back(values_of(shown(scene), "G"));
        }
        for (size_t other : {1, 2})
            for (size_t part = 0; part < 4; ++part) {
                std::vector<double> differences;
                const size_t count = found[0].size() / 4;
                for (size_t i = part * count; i < (part + 1) * count; ++i)
                    differences.push_back(found[0][i] - found[other][i]);
                const Estimate e = estimate_of(differences);
                EXPECT_NEAR(e.mean, 0, 3.5 * e.error + 1e-6)
                    << other << " part " << part << " emitter " << has_emitter;
            }
    }
}

TEST_F(SkyMapImage, HiddenOnesLightWhatIsSeenBeforeTheBackground) {
    for (const char* light : {"local", "global"})
        for (const char* kind : {"map", "constant"}) {
            Json scene = open_furnace(16);
            scene["world"]["sky"] = painted(white, 8, 4);
            if (std::string(kind) == "constant")
                scene["world"]["sky"] = {{"kind", "constant"}, {"color", {1, 1, 1}}};
            scene["world"]["sky"]["visible"] = false;
            scene["world"]["background"] = {0, 0.25, 0};
            scene["render"]["light"] = light;
            add_thing(scene, {{"shape", "box"}, {"size", {0.5, 1, 0.1}}, {"surface", "exact"}},
                      "mirror", {0.25, 0, 0.1});
            send_rays(scene, {0, 0, -0.55}, {0, 0, 1}, 0.8, 8);
            const Image image = shown(scene);
            const std::vector<double> red = values_of(image, "R"), green = values_of(image, "G");
            for (size_t i = 0; i < red.size(); ++i) {
                const bool is_mirror = i % 8 < 4;  // the right-hand side is -X
                EXPECT_NEAR(red[i], is_mirror ? 1 : 0, 1e-5) << light << " " << kind << " " << i;
                EXPECT_NEAR(green[i], is_mirror ? 1 : 0.25, 1e-5) << light << " " << kind;
            }
        }
}

TEST_F(SkyMapImage, HasTheSameBitsOnAnyNumberOfLanes) {
    if (!is_exhaustive()) GTEST_SKIP() << kOnlyWithAll;
    for (const char* light : {"local", "global"}) {
        Json scene = floor_under_map(painted(sunny, 64, 32, 3), light, 3);
        add_thing(scene, {{"shape", "sphere"}, {"radius", 0.2}, {"surface", "smooth"}}, "lacquer",
                  {0, 0.2, 0});
        scene["observer"].erase("turn");
        send_rays(scene, {0.1, 0.5, -0.55}, {-0.1, -0.6, 1}, 1, 15);
        std::set<uint64_t> hashes;
        for (const int lanes : lanes_with_all())
            hashes.insert(oracle::image_hash(shown(scene, lanes)));
        EXPECT_EQ(hashes.size(), 1u) << light;
    }
}

}  // namespace
}  // namespace voxelume
