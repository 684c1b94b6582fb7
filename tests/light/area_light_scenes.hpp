// SPDX-License-Identifier: Apache-2.0
// Scenes with an area light or emissive object above a floor.
#pragma once

#include <cmath>
#include <filesystem>
#include <glm/glm.hpp>
#include <numbers>
#include <string>

#include "runtime/render/renderer.hpp"
#include "runtime/scene_file/read_scene.hpp"
#include "tests/oracles/image_hash.hpp"
#include "tests/support/shared_device.hpp"

namespace voxelume {

/// A scene of 1.2 x 0.9 x 1 m from (-0.5, -0.1, -0.4) on, with a floor whose top is y = 0, seen
/// from straight above by parallel rays: 0.9 x 0.62 m around (0.05, 0.1), in 45 x 31 pixels of 2
/// cm. `models` and `objects` are added to the scene; each ends with a comma.
inline Scene floor_scene(const std::string& models, const std::string& objects,
                         const std::string& lights) {
    return parse_scene(
        R"({"voxelume": 1,
"world": {"voxel_size": [0.02, 0.0173, 0.0214], "bounds": {"min": [-0.5, -0.1, -0.4], "max": [0.7, 0.8, 0.6]}},
"materials": {"floor": {"color": [1, 0.5, 0.25]},
              "glow": {"color": [0.9, 0.9, 0.9], "diffuse": 1, "emission": [3, 2, 1]}},
"models": {)" +
            models + R"("floor": {"shape": "slab", "thickness": 0.06, "surface": "exact"}},
"objects": [)" +
            objects +
            R"({"name": "floor", "model": "floor", "material": "floor", "position": [0, -0.03, 0]}],
"lights": [)" +
            lights + R"(],
"observer": {"position": [0.05, 1.7, 0.1], "look_at": [0.05, 0, 0.1], "up": [0, 0, 1],
             "display": {"shape": "box", "size": [0.9, 0.62, 1.85], "voxels": [9, 6, 5]}},
"render": {"size": [45, 31]}})",
        "test.json", {});
}

inline Image image_of(const Scene& scene, int lanes = 0) {
    RenderReport report;
    return render(lanes == 0 ? shared_device() : test_device(lanes), scene, report);
}

inline glm::dvec3 point_at(const Image& image, size_t pixel) {
    return {image.planes.at("P.X")[pixel], image.planes.at("P.Y")[pixel],
            image.planes.at("P.Z")[pixel]};
}

/// The pixel whose point lies nearest to a point on the floor.
inline size_t pixel_at(const Image& image, double x, double z) {
    size_t best = 0;
    double minimum = 1e9;
    for (size_t i = 0; i < image.planes.at("R").size(); ++i) {
        const glm::dvec3 p = point_at(image, i);
        const double distance = std::hypot(p.x - x, p.z - z);
        if (distance < minimum) best = i, minimum = distance;
    }
    return best;
}

inline bool is_floor(const Image& image, size_t pixel) {
    return std::abs(point_at(image, pixel).y) < 1e-4;
}

/// The form factor of a rectangle a x b with one corner straight above the point, at height d.
inline double corner_form_factor(double a, double b, double d) {
    const double x = a / d, y = b / d, p = std::sqrt(1 + x * x), q = std::sqrt(1 + y * y);
    return (x / p * std::atan(y / p) + y / q * std::atan(x / q)) / (2 * std::numbers::pi);
}

}  // namespace voxelume
