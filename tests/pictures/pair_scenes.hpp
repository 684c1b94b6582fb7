// SPDX-License-Identifier: Apache-2.0
// Scenes of two solids, and the rays of their pictures.
#pragma once

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <random>
#include <string>

#include "runtime/scene/scene.hpp"

namespace voxelume {

inline constexpr glm::ivec2 kPairSize(80, 64);

/// A scene of two objects without light, whose images say where surfaces are. Vectors are JSON.
inline std::string pair_scene(double voxel, const std::string& models, const std::string& objects) {
    return fmt::format(
        R"({{"voxelume": 1,
"world": {{"voxel_size": {}, "bounds": {{"min": [-1.3, -1.3, -1.3], "max": [1.3, 1.3, 1.3]}}}},
"models": {{{}}}, "objects": [{}], "lights": [],
"observer": {{"position": [0.9, 1.6, 3.4], "look_at": [0, 0, 0],
              "display": {{"shape": "pyramid", "angle": 34}}}},
"render": {{"size": [{}, {}]}}}})",
        voxel, models, objects, kPairSize.x, kPairSize.y);
}

/// The unit vector through a pixel, (0.5, 0.5) being the middle of the first.
inline glm::dvec3 direction_at(const Observer& observer, const glm::dvec2& pixel) {
    const glm::dvec2 at = 2.0 * pixel / glm::dvec2(kPairSize) - 1.0;
    const glm::dvec3 ray(-at.x * std::tan(observer.display.half_angles.x),
                         -at.y * std::tan(observer.display.half_angles.y), 1);
    return observer.world_from_observer * glm::normalize(ray);
}

/// A solid of a random kind and size, at a random place, turned and stretched.
inline std::array<std::string, 2> random_solid(std::mt19937& random, const char* surface) {
    const auto in = [&](double low, double high) {
        return std::uniform_real_distribution<double>(low, high)(random);
    };
    const std::string keys = [&]() -> std::string {
        switch (random() % 6) {
            case 0:
                return fmt::format(R"("shape": "sphere", "radius": {})", in(.4, .7));
            case 1:
                return fmt::format(R"("shape": "box", "size": [{}, {}, {}])", in(.5, 1.2),
                                   in(.5, 1.2), in(.5, 1.2));
            case 2:
                return fmt::format(R"("shape": "torus", "radius": {}, "tube": {})", in(.4, .7),
                                   in(.15, .3));
            case 3:
                return fmt::format(R"("shape": "cylinder", "radius": {}, "height": {})", in(.3, .6),
                                   in(.5, 1.2));
            case 4:  // blunt: `smooth` loses points
                return fmt::format(
                    R"("shape": "cone", "radius": {}, "height": {}, "top_radius": {})", in(.4, .7),
                    in(.6, 1.2), in(.1, .4));
            default:
                return fmt::format(R"("shape": "ellipsoid", "radii": [{}, {}, {}])", in(.3, .7),
                                   in(.3, .7), in(.3, .7));
        }
    }();
    return {fmt::format(R"({{{}, "surface": "{}"}})", keys, surface),
            fmt::format(R"("position": [{}, {}, {}], "turn": [{}, {}, {}], "scale": [{}, {}, {}])",
                        in(-.3, .3), in(-.3, .3), in(-.3, .3), in(0, 360), in(0, 360), in(0, 360),
                        in(.8, 1.2), in(.8, 1.2), in(.8, 1.2))};
}

}  // namespace voxelume
