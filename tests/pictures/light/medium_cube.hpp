// SPDX-License-Identifier: Apache-2.0
// A medium that scatters light, and pictures of it.
#pragma once

#include <cmath>
#include <numbers>

#include "tests/pictures/light/global_light.hpp"

namespace voxelume {

/// A cube of a medium with sides of 2 m, seen along -z.
inline Json cube_of_medium(const Json& medium, const Json& lights, int bounces, int samples) {
    Json scene = Json::parse(R"({"voxelume": 1,
"world": {"voxel_size": 0.125, "bounds": {"min": [-1, -1, -1], "max": [1, 1, 1]}},
"observer": {"position": [0.0625, 0.1875, 5], "look_at": [0.0625, 0.1875, 0],
             "projection": "orthographic", "width": 1e-4},
"render": {"size": [16, 16], "light": "global"}})");
    scene["world"]["medium"] = medium;
    scene["lights"] = lights;
    scene["render"]["bounces"] = bounces;
    scene["render"]["samples"] = samples;
    return scene;
}

inline Image image_of_medium(const Json& json, int lanes = 0) {
    RenderReport report;
    return render(test_device(lanes), parse_scene(json.dump(), "medium", {}), report);
}

inline Estimate estimate_of_channel(const Image& image, const char* channel) {
    std::vector<double> values;
    for (size_t i = 0; i < 256; ++i) values.push_back(double(image.planes.at(channel)[i]));
    return estimate_of(values);
}

/// Henyey and Greenstein's phase function.
inline double phase(double g, double cosine) {
    return (1 - g * g) / (4 * std::numbers::pi * std::pow(1 + g * g - 2 * g * cosine, 1.5));
}

}  // namespace voxelume
