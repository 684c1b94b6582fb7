// SPDX-License-Identifier: Apache-2.0
// Lights in and around a medium that scatters their light, against integrals along the line of
// sight, and against lights that are infinitely far away.
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include "runtime/analysis/scene_features.hpp"
#include "tests/pictures/light/medium_cube.hpp"

namespace voxelume {
namespace {

constexpr glm::dvec3 kLine{0.0625, 0.1875, 0};  // and along z, from 1 to -1

struct PlacedLight {
    glm::dvec3 position, direction{0};  ///< none: it shines all around
    double inner = 0, outer = 0;        ///< degrees, from edge to edge
    const char* name = "";

    Json json() const {
        Json light = {{"type", "point"},
                      {"position", {position.x, position.y, position.z}},
                      {"intensity", 2}};
        if (outer == 0) return light;
        light["type"] = "spot";
        light["direction"] = {direction.x, direction.y, direction.z};
        light["inner_angle"] = inner;
        light["angle"] = outer;
        return light;
    }

    /// The light that arrives at a point at the end of `way`, without the medium.
    double light_along(const glm::dvec3& way) const {
        const double squared = glm::dot(way, way);
        if (outer == 0) return 2 / squared;
        const double full = std::cos(glm::radians(inner / 2)),
                     none = std::cos(glm::radians(outer / 2));
        const double cosine = glm::dot(glm::normalize(direction), glm::normalize(way));
        const double s = std::clamp((cosine - none) / (full - none), 0.0, 1.0);
        return 2 / squared * s * s * (3 - 2 * s);
    }
};

/// The part of the way from a point of the cube to another that lies in the cube.
double length_in_cube(const glm::dvec3& from, const glm::dvec3& to) {
    const glm::dvec3 way = to - from;
    double part = 1;
    for (int a = 0; a < 3; ++a)
        if (way[a] != 0) part = std::min(part, ((way[a] > 0 ? 1 : -1) - from[a]) / way[a]);
    return part * glm::length(way);
}

class NearLight : public testing::TestWithParam<PlacedLight> {};

TEST_P(NearLight, FollowsTheIntegralAlongTheLineOfSight) {
    const PlacedLight& light = GetParam();
    const glm::dvec3 scattering(1.5, 0.7, 3), absorption(0.4, 0.2, 0);
    constexpr double kG = 0.4;
    const Image image = image_of_medium(cube_of_medium(
        {{"scattering", {1.5, 0.7, 3}}, {"absorption", {0.4, 0.2, 0}}, {"anisotropy", kG}},
        Json::array({light.json()}), 0, 64));
    constexpr const char* kChannels[] = {"R", "G", "B"};
    for (int c = 0; c < 3; ++c) {
        const double extinction = scattering[c] + absorption[c];
        constexpr int kSteps = 100000;
        double sum = 0;
        for (int i = 0; i < kSteps; ++i) {
            const double z = 1 - 2 * (i + 0.5) / kSteps;
            const glm::dvec3 at(kLine.x, kLine.y, z), way = at - light.position;
            const double metres = 1 - z + length_in_cube(at, light.position);
            sum += std::exp(-extinction * metres) * phase(kG, way.z / glm::length(way)) *
                   light.light_along(way);
        }
        const double expected = scattering[c] * sum * 2 / kSteps * std::numbers::pi;
        const Estimate found = estimate_of_channel(image, kChannels[c]);
        expect_mean(found, expected, std::string(light.name) + kChannels[c], 1e-5 * expected);
        // Paths that the medium scatters by chance alone are off by 2 to 30 times as much.
        EXPECT_LE(found.error, 0.006 * expected) << light.name;
    }
}

INSTANTIATE_TEST_SUITE_P(
    Lights, NearLight,
    testing::Values(PlacedLight{.position = {0.0625, 0.3, 0.2}, .name = "close by, "},
                    PlacedLight{.position = {0.0725, 0.1875, -0.5}, .name = "almost on the line, "},
                    PlacedLight{.position = {0.5, 3, -1}, .name = "outside, "},
                    PlacedLight{{0.0625, 0.9, 0.3}, {0, -1, 0}, 20, 40, "across, "},
                    PlacedLight{{0.4, 0.8, 1.4}, {-0.2, -0.5, -0.9}, 10, 60, "obliquely, "},
                    PlacedLight{{0.1, 0.15, 1.5}, {0, 0, -1}, 10, 30, "along, "},
                    PlacedLight{{0.1, 0.25, -1.4}, {0, 0, 1}, 10, 30, "against, "},
                    PlacedLight{{0.0625, 0.5, 0}, {0, -1, 0}, 150, 178, "wide, "}));

TEST(NearLightAlone, DarkConesBringNothing) {
    const PlacedLight away{{0.0625, 0.5, 0}, {0, 1, 0}, 20, 60};
    const Image image = image_of_medium(
        cube_of_medium({{"scattering", {1, 1, 1}}}, Json::array({away.json()}), 0, 16));
    EXPECT_EQ(estimate_of_channel(image, "G").mean, 0);
}

/// A medium whose density differs from voxel to voxel.
TEST(NearLightAlone, FollowsTheDensityOfEachVoxel) {
    const PlacedLight light{.position = {0.1, 0.45, -0.3}};
    const Image image = image_of_medium(cube_of_medium(
        {{"scattering", {2, 2, 2}},
         {"absorption", {0.5, 0.5, 0.5}},
         {"anisotropy", 0.25},
         {"density", {{"kind", "ball"}, {"center", {0, 0, 0}}, {"radius", 0.8}, {"falloff", 0.5}}}},
        Json::array({light.json()}), 0, 256));
    constexpr double kEdge = 0.125;
    const auto density = [](const glm::dvec3& p) {
        const glm::dvec3 middle = (glm::floor(p / kEdge) + 0.5) * kEdge;
        const double s = std::clamp((0.8 - glm::length(middle)) / 0.5, 0.0, 1.0);
        return s * s * (3 - 2 * s);
    };
    constexpr int kSteps = 8000, kParts = 400;
    double sum = 0, depth = 0;
    for (int i = 0; i < kSteps; ++i) {
        const glm::dvec3 at(kLine.x, kLine.y, 1 - 2 * (i + 0.5) / kSteps);
        const glm::dvec3 way = at - light.position;
        const double here = density(at), before = depth + here / kSteps;
        depth += here * 2 / kSteps;
        double between = 0;
        for (int k = 0; k < kParts; ++k)
            between += density(light.position + way * ((k + 0.5) / kParts));
        sum += here * std::exp(-2.5 * (before + between * glm::length(way) / kParts)) *
               phase(0.25, way.z / glm::length(way)) * light.light_along(way);
    }
    const double expected = 2 * sum * 2 / kSteps * std::numbers::pi;
    expect_mean(estimate_of_channel(image, "R"), expected, "ball", 3e-4 * expected);
}

/// A point 2,000 m away and a light from infinitely far away look alike, however often light is
/// scattered.
TEST(NearLightAlone, AgreesWithChanceWhereLightIsScatteredOften) {
    const glm::dvec3 from = glm::normalize(glm::dvec3(0.3, 0.9, 0.4)) * 2000.0;
    const Json medium = {{"scattering", {2, 1, 3}}, {"anisotropy", 0.3}};
    const Json far = Json::array({{{"type", "point"},
                                   {"position", {from.x, from.y, from.z}},
                                   {"intensity", 3 * 2000.0 * 2000.0}}});
    const Json directional = Json::array(
        {{{"type", "directional"}, {"direction", {-from.x, -from.y, -from.z}}, {"intensity", 3}}});
    const Image near = image_of_medium(cube_of_medium(medium, far, 6, 256)),
                by_chance = image_of_medium(cube_of_medium(medium, directional, 6, 256));
    for (const char* channel : {"R", "G", "B"}) {
        const Estimate a = estimate_of_channel(near, channel),
                       b = estimate_of_channel(by_chance, channel);
        // The point's light differs by its distance; the cube is at most 1 in 1,000 of it.
        EXPECT_NEAR(a.mean, b.mean, 4 * std::hypot(a.error, b.error) + 2e-3 * b.mean) << channel;
    }
}

/// Behind the ball, whose shadow the light throws into the medium, the line of sight ends.
TEST(NearLightAlone, StopsAtSurfacesAndInShadows) {
    const PlacedLight light{.position = {0.0625, 0.9, 0.1}};
    Json scene = cube_of_medium({{"scattering", {1, 1, 1}}}, Json::array({light.json()}), 0, 64);
    scene["materials"] = {{"black", {{"color", {0, 0, 0}}}}};
    scene["models"] = {{"ball", {{"shape", "sphere"}, {"radius", 0.1875}, {"surface", "exact"}}},
                       {"wall", {{"shape", "box"}, {"size", {2, 2, 0.25}}, {"surface", "exact"}}}};
    scene["objects"] =
        Json::array({{{"model", "ball"}, {"material", "black"}, {"position", {0.0625, 0.55, 0.1}}},
                     {{"model", "wall"}, {"material", "black"}, {"position", {0, 0, -0.75}}}});
    constexpr int kSteps = 200000;
    double sum = 0;
    for (int i = 0; i < kSteps; ++i) {
        const glm::dvec3 at(kLine.x, kLine.y, 1 - 1.625 * (i + 0.5) / kSteps);
        const glm::dvec3 way = at - light.position, to_ball = glm::dvec3(0, -0.35, 0);
        const double length = glm::length(way), along = glm::dot(to_ball, way) / length;
        if (glm::dot(to_ball, to_ball) - along * along < 0.1875 * 0.1875) continue;
        sum += std::exp(-(1 - at.z + length)) * phase(0, 0) * light.light_along(way);
    }
    const double expected = sum * 1.625 / kSteps * std::numbers::pi;
    expect_mean(estimate_of_channel(image_of_medium(scene), "G"), expected, "behind a ball",
                1e-4 * expected);
}

/// An observer with a light sees light with an infinite mean, and yet the picture is finite.
TEST(NearLightAlone, ALightAtTheObserversPlaceLeavesAPicture) {
    const auto median_with = [](double aside) {
        Json scene =
            cube_of_medium({{"scattering", {1, 1, 1}}},
                           Json::array({PlacedLight{.position = {aside, 0.1, 0.9}}.json()}), 1, 64);
        scene["observer"] = {{"position", {0, 0.1, 0.9}},
                             {"look_at", {0, 0.1, 0}},
                             {"display", {{"shape", "pyramid"}, {"angle", 40}}}};
        const Image image = image_of_medium(scene);
        std::vector<float> green;
        for (size_t i = 0; i < 256; ++i) green.push_back(image.planes.at("G")[i]);
        std::nth_element(green.begin(), green.begin() + 128, green.end());
        return green[128];
    };
    const float aside = median_with(0.05);
    EXPECT_GT(median_with(0), aside);
    // Points found by chance give 11 times as much; points that crowd at the light gave 600,000
    // times as much.
    EXPECT_LT(median_with(0), 50 * aside);
}

TEST(NearLightAlone, CostsNothingWhereThereIsNone) {
    const auto has_near_light = [](const Json& json) {
        const Scene scene = parse_scene(json.dump(), "medium", {});
        return features_of(scene, Pyramid()).near_light;
    };
    const Json medium = {{"scattering", {1, 1, 1}}};
    const Json light = PlacedLight{.position = {0, 0.5, 0}}.json();
    Json scene = cube_of_medium(medium, Json::array({light}), 2, 4);
    EXPECT_TRUE(has_near_light(scene));
    scene["lights"][0]["intensity"] = 0;
    EXPECT_FALSE(has_near_light(scene));
    scene["lights"][0] = {{"type", "directional"}, {"direction", {0, -1, 0}}};
    EXPECT_FALSE(has_near_light(scene));
    scene["lights"][0] = light;
    scene["render"]["light"] = "local";
    EXPECT_FALSE(has_near_light(scene));
    scene["render"]["light"] = "global";
    scene["world"].erase("medium");
    EXPECT_FALSE(has_near_light(scene));
}

TEST(NearLightAlone, HasTheSameBitsForAllLanes) {
    Json scene = cube_of_medium(
        {{"scattering", {1.5, 0.7, 3}}, {"anisotropy", 0.4}},
        Json::array({PlacedLight{.position = {0.0625, 0.3, 0.2}}.json(),
                     PlacedLight{{0.4, 0.8, 1.4}, {-0.2, -0.5, -0.9}, 10, 60}.json()}),
        3, 4);
    scene["observer"]["width"] = 2.4;
    const Image image = image_of_medium(scene);
    for (const int lanes : {1, 4, 16})
        EXPECT_TRUE(image_of_medium(scene, lanes).planes == image.planes) << lanes;
}

}  // namespace
}  // namespace voxelume
