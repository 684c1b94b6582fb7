// SPDX-License-Identifier: Apache-2.0
// Skies: what rays see of them, and how they light a floor, against integrals and the formulas of
// Preetham, Shirley and Smits 1999.
#include <glm/trigonometric.hpp>
#include <numbers>
#include <set>

#include "tests/oracles/image_hash.hpp"
#include "tests/pictures/light/global_light.hpp"

namespace voxelume {
namespace {

/// A white floor at y = 0 under a sky, seen from above.
Json floor_under(const Json& sky, const char* light, int samples) {
    Json scene = open_furnace(samples);
    scene["world"]["background"] = {1e6, 1e6, 1e6};
    scene["world"]["sky"] = sky;
    add_thing(scene, {{"shape", "box"}, {"size", {1.1, 0.1, 1.1}}, {"surface", "exact"}}, "chalk",
              {0, -0.05, 0});
    scene["observer"]["position"] = {0, 0.1, 0};
    scene["observer"]["turn"] = {0, 90, 0};
    scene["observer"]["display"]["size"] = {0.1, 0.1, 9};
    scene["render"]["size"] = {32, 32};
    scene["render"]["light"] = light;
    return scene;
}

const Json kGradient = {
    {"kind", "gradient"},  {"zenith", {0.2, 0.4, 0.9}}, {"horizon", {0.8, 0.7, 0.3}},
    {"ground", {5, 5, 5}}, {"strength", 1.5},           {"samples", 64}};

class BothLights : public testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(Sky, BothLights, testing::Values("local", "global"));

TEST_P(BothLights, AFloorUnderAGradientHasItsCosineWeightedMean) {
    // The integral of (h + (z - h) sine) sine over the hemisphere, over pi: h + 2/3 (z - h).
    const std::vector<SensedRay> rays = sense(floor_under(kGradient, GetParam(), 16));
    const double horizon[3] = {0.8, 0.7, 0.3}, zenith[3] = {0.2, 0.4, 0.9};
    for (int c = 0; c < 3; ++c)
        expect_mean(estimate_of(channel_of(rays, c)),
                    1.5 * (horizon[c] + 2.0 / 3 * (zenith[c] - horizon[c])),
                    std::string(GetParam()) + " channel " + std::to_string(c));
}

TEST_P(BothLights, AWallHidesHalfOfAConstantSky) {
    // The sky lights half of a floor in front of an endless wall. The wall, which is black here,
    // lights the other half. It is 0.5 m high and the floor is seen 0.2 mm in front of it.
    Json scene =
        floor_under({{"kind", "constant"}, {"color", {1, 1, 1}}, {"samples", 64}}, GetParam(), 16);
    scene["materials"]["soot"] = {{"color", {0, 0, 0}}};
    add_thing(scene, {{"shape", "box"}, {"size", {1.1, 0.5, 0.1}}, {"surface", "exact"}}, "soot",
              {0, 0.25, 0.0502});
    scene["observer"]["display"]["size"] = {0.0001, 0.0001, 9};
    // The observer sees a point 1/2500 of the wall's height away from the wall.
    expect_mean(estimate_of(channel_of(sense(scene), 0)), 0.5, GetParam(), 1e-3);
}

TEST_P(BothLights, TheSunLightsAsADirectionalLight) {
    const glm::dvec3 towards = glm::normalize(glm::dvec3(0.3, 0.8, 0.2));
    const Json sky = {{"kind", "sun"},      {"direction", {-0.3, -0.8, -0.2}},
                      {"angle", 2},         {"color", {1, 0.5, 0.25}},
                      {"intensity", 0.75},  {"strength", 0},
                      {"ground", {0, 0, 0}}};
    const std::vector<SensedRay> rays = sense(floor_under(sky, GetParam(), 16));
    const double colors[3] = {1, 0.5, 0.25};
    for (int c = 0; c < 3; ++c)
        EXPECT_NEAR(estimate_of(channel_of(rays, c)).mean, 0.75 * colors[c] * towards.y, 3e-4);
}

/// An empty world seen all around, 36 x 18 pixels.
Json all_around(const Json& sky) {
    Json scene = floor_under(sky, "local", 1);
    scene["objects"] = Json::array();
    scene["observer"] = {{"position", {0, 0, 0}},
                         {"turn", {0, 0, 0}},
                         {"display", {{"shape", "ball"}, {"radius", 1}}}};
    scene["render"]["size"] = {36, 18};
    return scene;
}

/// The direction of a pixel there, from the right-hand side of the image being -X.
glm::dvec3 direction_at(int column, int row) {
    const double longitude = std::numbers::pi * (2 * (column + 0.5) / 36 - 1);
    const double latitude = std::numbers::pi / 2 * (1 - 2 * (row + 0.5) / 18);
    return {-std::sin(longitude) * std::cos(latitude), std::sin(latitude),
            std::cos(longitude) * std::cos(latitude)};
}

/// Preetham's sky in kcd/m^2 and chromaticities, from the paper's appendix.
struct Daylight {
    double turbidity, sun;  ///< angle from the zenith, radians

    double perez(const double (&c)[5], double theta, double gamma) const {
        return (1 + c[0] * std::exp(c[1] / std::cos(theta))) *
               (1 + c[2] * std::exp(c[3] * gamma) + c[4] * std::pow(std::cos(gamma), 2));
    }
    double relative(const double (&c)[5], double theta, double gamma) const {
        return perez(c, theta, gamma) / perez(c, 0, sun);
    }
    glm::dvec3 linear_color(double theta, double gamma) const {
        const double t = turbidity, s = sun, s2 = s * s, s3 = s2 * s;
        const double of_luminance[5] = {0.1787 * t - 1.4630, -0.3554 * t + 0.4275,
                                        -0.0227 * t + 5.3251, 0.1206 * t - 2.5771,
                                        -0.0670 * t + 0.3703};
        const double of_x[5] = {-0.0193 * t - 0.2592, -0.0665 * t + 0.0008, -0.0004 * t + 0.2125,
                                -0.0641 * t - 0.8989, -0.0033 * t + 0.0452};
        const double of_y[5] = {-0.0167 * t - 0.2608, -0.0950 * t + 0.0092, -0.0079 * t + 0.2102,
                                -0.0441 * t - 1.6537, -0.0109 * t + 0.0529};
        const double chi = (4.0 / 9 - t / 120) * (std::numbers::pi - 2 * s);
        const double zenith = (4.0453 * t - 4.9710) * std::tan(chi) - 0.2155 * t + 2.4192;
        const double zenith_x = t * t * (0.00166 * s3 - 0.00375 * s2 + 0.00209 * s) +
                                t * (-0.02903 * s3 + 0.06377 * s2 - 0.03202 * s + 0.00394) +
                                0.11693 * s3 - 0.21196 * s2 + 0.06052 * s + 0.25886;
        const double zenith_y = t * t * (0.00275 * s3 - 0.00610 * s2 + 0.00317 * s) +
                                t * (-0.04214 * s3 + 0.08970 * s2 - 0.04153 * s + 0.00516) +
                                0.15346 * s3 - 0.26756 * s2 + 0.06670 * s + 0.26688;
        const double luminance = zenith * relative(of_luminance, theta, gamma);
        const double x = zenith_x * relative(of_x, theta, gamma);
        const double y = zenith_y * relative(of_y, theta, gamma);
        const double cie_x = x / y * luminance, cie_z = (1 - x - y) / y * luminance;
        return {3.2404542 * cie_x - 1.5371385 * luminance - 0.4985314 * cie_z,
                -0.9692660 * cie_x + 1.8760108 * luminance + 0.0415560 * cie_z,
                0.0556434 * cie_x - 0.2040259 * luminance + 1.0572252 * cie_z};
    }
};

TEST(Sky, AClearOneIsThatOfTheFormulas) {
    const glm::dvec3 towards = glm::normalize(glm::dvec3(0.5, 0.6, 0.3));
    const Daylight daylight{3.5, std::acos(towards.y)};
    const Json sky = {{"kind", "sun"},
                      {"direction", {-0.5, -0.6, -0.3}},
                      {"turbidity", 3.5},
                      {"strength", 2},
                      {"ground", {0.25, 0.5, 0.125}}};
    const Scene scene = parse_scene(all_around(sky).dump(), "sky", {});
    RenderReport report;
    const Image image = render(test_device(), scene, report);
    for (int row = 0; row < 18; ++row)
        for (int column = 0; column < 36; ++column) {
            const glm::dvec3 d = direction_at(column, row);
            const glm::dvec3 expected =
                d.y < 0 ? glm::dvec3(0.5, 1, 0.25)
                        : 2 * std::numbers::pi / 100 *
                              glm::max(daylight.linear_color(std::acos(d.y),
                                                             std::acos(glm::dot(d, towards))),
                                       glm::dvec3(0));
            const char* names[3] = {"R", "G", "B"};
            for (int c = 0; c < 3; ++c)
                ASSERT_NEAR(image.planes.at(names[c])[size_t(row * 36 + column)], expected[c],
                            2e-5 * (1 + expected[c]))
                    << column << ", " << row << " " << names[c];
        }
}

TEST(Sky, ShowsTheSunAsADisc) {
    Json sky = {{"kind", "sun"},    {"direction", {0, -1, -1}}, {"angle", 30},
                {"intensity", 0.5}, {"color", {1, 1, 1}},       {"strength", 0}};
    const Scene scene = parse_scene(all_around(sky).dump(), "sky", {});
    RenderReport report;
    const Image image = render(test_device(), scene, report);
    const glm::dvec3 towards = glm::normalize(glm::dvec3(0, 1, 1));
    const double tangent = std::tan(glm::radians(15.0));
    for (int row = 0; row < 18; ++row)
        for (int column = 0; column < 36; ++column) {
            const double cosine = glm::dot(direction_at(column, row), towards);
            const double radiance = 0.5 / (tangent * tangent) / std::pow(cosine, 3);
            const double expected = cosine > std::cos(glm::radians(15.0)) ? radiance : 0;
            EXPECT_NEAR(image.planes.at("G")[size_t(row * 36 + column)], expected, 1e-5 * expected)
                << column << ", " << row;
        }
}

TEST(Sky, LitScenesHaveTheSameBitsOnAnyNumberOfLanes) {
    if (!is_exhaustive()) GTEST_SKIP() << kOnlyWithAll;
    for (const char* light : {"local", "global"}) {
        Json scene = floor_under(
            {{"kind", "sun"}, {"direction", {-0.5, -0.6, -0.3}}, {"angle", 4}, {"samples", 3}},
            light, 3);
        add_thing(scene, {{"shape", "sphere"}, {"radius", 0.2}, {"surface", "smooth"}}, "lacquer",
                  {0, 0.2, 0});
        scene["observer"].erase("turn");
        send_rays(scene, {0.1, 0.5, -0.55}, {-0.1, -0.6, 1}, 1, 15);
        std::set<uint64_t> hashes;
        for (const int lanes : lanes_with_all()) {
            RenderReport report;
            hashes.insert(oracle::image_hash(
                render(test_device(lanes), parse_scene(scene.dump(), "sky", {}), report)));
            EXPECT_EQ(report.not_finite, 0u);
        }
        EXPECT_EQ(hashes.size(), 1u) << light;
    }
}

TEST(Sky, ASceneInDaylightGetsNoOtherLight) {
    Json scene = floor_under(kGradient, "local", 1);
    scene.erase("lights");
    EXPECT_FALSE(parse_scene(scene.dump(), "sky", {}).has_default_light);
    scene["world"].erase("sky");
    EXPECT_TRUE(parse_scene(scene.dump(), "sky", {}).has_default_light);
}

}  // namespace
}  // namespace voxelume
