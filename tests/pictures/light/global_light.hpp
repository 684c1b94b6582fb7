// SPDX-License-Identifier: Apache-2.0
// Scenes in global light, and the light of their pixels with its statistical error.
#pragma once

#include <cmath>
#include <glm/vec3.hpp>
#include <string>
#include <vector>

#include "tests/pictures/light/sensor_room.hpp"

namespace voxelume {

/// A mean of pixels and its standard error, as if pixels were independent samples. The pixels of a
/// 4 x 4 square aren't: their errors cancel, so the mean's error is smaller. An exception is what
/// depends on the pairing of a pixel's decisions, for which the error is up to a seventh larger.
struct Estimate {
    double mean = 0, error = 0;
};

inline Estimate estimate_of(const std::vector<double>& values) {
    Estimate e;
    const auto count = double(values.size());
    for (const double v : values) e.mean += v / count;
    double square = 0;
    for (const double v : values) square += (v - e.mean) * (v - e.mean);
    e.error = std::sqrt(square / (count * (count - 1)));
    return e;
}

/// The values of a channel.
inline std::vector<double> channel_of(const std::vector<SensedRay>& rays, int channel) {
    std::vector<double> values;
    values.reserve(rays.size());
    for (const SensedRay& ray : rays) values.push_back(ray.color[channel]);
    return values;
}

/// Fails if a mean isn't within three standard errors and a relative `rounding` of the expected
/// value.
inline void expect_mean(const Estimate& e, double expected, const std::string& what,
                        double rounding = 2e-6) {
    fmt::print("{}: {:.6f} +- {:.6f}, expected {:.6f}\n", what, e.mean, e.error, expected);
    EXPECT_NEAR(e.mean, expected, 3 * e.error + rounding * std::abs(expected)) << what;
}

/// An empty world under a white sky of radiance 1, in global light.
inline Json open_furnace(int samples) {
    Json scene = sensor_room(0.02);
    scene["objects"] = Json::array();
    scene["lights"] = Json::array();
    scene["world"]["background"] = {1, 1, 1};
    scene["materials"] = {
        {"chalk", {{"color", {1, 1, 1}}}},
        {"mirror", {{"diffuse", 0}, {"reflection", 1}}},
        {"glass",
         {{"diffuse", 0}, {"reflection", 1}, {"refraction", 1}, {"fresnel", true}, {"ior", 1.5}}},
        {"lacquer", {{"color", {1, 1, 1}}, {"diffuse", 0.625}, {"reflection", 0.375}}},
        {"veil", {{"color", {1, 1, 1}}, {"opacity", 0.375}}}};
    scene["render"] = {{"samples", samples}, {"light", "global"}, {"bounces", 64}};
    return scene;
}

/// A closed sphere of radius 0.5 m seen from inside: a hollow in a box.
inline Json hollow_sphere(const char* surface) {
    return {
        {"shape", "difference"},
        {"surface", surface},
        {"parts",
         {{{"shape", "box"}, {"size", {1.1, 1.1, 1.1}}}, {{"shape", "sphere"}, {"radius", 0.5}}}}};
}

}  // namespace voxelume
