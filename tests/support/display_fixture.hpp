// SPDX-License-Identifier: Apache-2.0
// A sphere and a turned box in front of displays of every shape, and the same objects for the
// oracle.
#pragma once

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <string>
#include <vector>

#include "runtime/render/volume_renderer.hpp"
#include "runtime/scene_file/read_scene.hpp"
#include "tests/oracles/display_oracle.hpp"
#include "tests/support/shared_device.hpp"

namespace voxelume {

/// A display's shape, with its keys except for `layout`.
struct DisplayCase {
    const char* name;
    const char* keys;
};

inline constexpr std::array kDisplayCases = {
    DisplayCase{"pyramid", R"("shape": "pyramid", "angles": [40, 30], "near": 1.2, "far": 4.5)"},
    DisplayCase{"sector", R"("shape": "sector", "angle": 50, "near": 1.1, "far": 4.4)"},
    DisplayCase{"ball", R"("shape": "ball", "radius": 4.3)"},
    DisplayCase{"box", R"("shape": "box", "size": [2.9, 2.3, 3.1], "near": 1.3)"}};

/// A scene text; `display` has the display's keys. The observer stands at (-1.2, 0.8, -2.4).
inline std::string display_scene(const std::string& display, const std::string& surface = "exact",
                                 const std::string& world = "", const std::string& lights = "") {
    return R"({"voxelume": 1,
"world": {"voxel_size": 0.04, "bounds": {"min": [-1.4, -1.3, -1.2], "max": [1.5, 1.1, 1.3]},
          "background": [0.25, 0.5, 0.75], "ambient": [0.5, 0.4, 0.3])" +
           world + R"(},
"materials": {"red": {"color": [0.8, 0.3, 0.2]}, "green": {"color": [0.2, 0.7, 0.4]}},
"models": {"ball": {"shape": "sphere", "radius": 0.6, "voxel_size": 0.04, "surface": ")" +
           surface + R"("},
           "block": {"shape": "box", "size": [0.9, 0.5, 0.7], "voxel_size": 0.04, "surface": ")" +
           surface + R"("}},
"objects": [{"name": "ball", "model": "ball", "material": "red", "position": [0.45, 0.1, 0.2]},
            {"name": "block", "model": "block", "material": "green", "position": [-0.6, -0.5, 0.1],
             "turn": [25, 10, 0]}],
"lights": [)" +
           lights + R"(],
"observer": {"position": [-1.2, 0.8, -2.4], "look_at": [0, -0.1, 0.1], "display": {)" +
           display + R"(}},
"render": {"size": [32, 24]}})";
}

/// The objects of display_scene, from numbers written independently.
inline oracle::SimpleScene display_solids() {
    const double y = 25 * M_PI / 180, x = 10 * M_PI / 180;
    const glm::dmat3 about_y(std::cos(y), 0, -std::sin(y), 0, 1, 0, std::sin(y), 0, std::cos(y));
    const glm::dmat3 about_x(1, 0, 0, 0, std::cos(x), std::sin(x), 0, -std::sin(x), std::cos(x));
    return {{{{0.45, 0.1, 0.2}, 0.6, {}, glm::dmat3(1)},
             {{-0.6, -0.5, 0.1}, 0, {0.45, 0.25, 0.35}, about_y * about_x}}};
}

inline Scene parsed(const std::string& text) {
    return parse_scene(text, "test.json", {});
}

inline Volume volume_of(const Scene& scene, int lanes = 0) {
    RenderReport report;
    return render_volume(lanes == 0 ? shared_device() : test_device(lanes), scene, report);
}

/// The colours of a volume composited along each ray, front to back, in front of `behind`.
inline std::vector<glm::dvec3> flattened(const Volume& volume, const glm::dvec3& behind) {
    const size_t pixels = size_t(volume.frame.size.x) * size_t(volume.frame.size.y);
    std::vector<glm::dvec3> colors(pixels, glm::dvec3(0));
    std::vector<double> transmittance(pixels, 1);
    for (size_t i = 0; i < volume.indices.size(); ++i) {  // indices ascend, by step
        const size_t pixel = volume.indices[i] % pixels;
        const double opacity = volume.opacities[i];
        colors[pixel] += transmittance[pixel] * opacity * glm::dvec3(volume.colors[i]);
        transmittance[pixel] *= 1 - opacity;
    }
    for (size_t i = 0; i < pixels; ++i) colors[i] += transmittance[i] * behind;
    return colors;
}

}  // namespace voxelume
