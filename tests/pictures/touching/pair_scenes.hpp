// SPDX-License-Identifier: Apache-2.0
// Scenes of two solids, and the rays of their pictures.
#pragma once

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <random>
#include <string>

#include "runtime/scene/parts/scene_affine.hpp"
#include "runtime/scene/scene.hpp"

namespace voxelume {

inline constexpr glm::ivec2 kPairSize(80, 64);

/// A scene of two objects without light, whose images give the positions of surfaces. Vectors are
/// JSON.
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

/// The unit vector through a pixel; (0.5, 0.5) is the middle of the first pixel.
inline glm::dvec3 direction_at(const Observer& observer, const glm::dvec2& pixel) {
    const glm::dvec2 at = 2.0 * pixel / glm::dvec2(kPairSize) - 1.0;
    const glm::dvec3 ray(-at.x * std::tan(observer.display.half_angles.x),
                         -at.y * std::tan(observer.display.half_angles.y), 1);
    return observer.world_from_observer * glm::normalize(ray);
}

/// Two solids with a name.
struct SolidPair {
    const char* name;
    const char *first, *second;        ///< keys of the models
    const char *first_at, *second_at;  ///< keys of the objects
    bool is_smooth = false;            ///< has no edges except where the two meet
};

inline constexpr std::array kSolidPairs = {
    SolidPair{"ball in floor", R"("shape": "sphere", "radius": 0.6)",
              R"("shape": "box", "size": [2.2, 0.4, 2.2])", R"("position": [0.03, 0.21, 0.05])",
              R"("position": [0, -0.4, 0])"},
    SolidPair{"ring and ball", R"("shape": "torus", "radius": 0.7, "tube": 0.2)",
              R"("shape": "sphere", "radius": 0.6)", R"("turn": [20, 35, 10])",
              R"("position": [0.12, 0.05, 0.2])", true},
    SolidPair{"cone on plate",
              R"("shape": "cone", "radius": 0.5, "height": 1.1, "top_radius": 0.15)",
              R"("shape": "cylinder", "radius": 1, "height": 0.3)",
              R"("position": [0.03, 0.31, 0.05])", R"("position": [0, -0.4, 0])"},
    SolidPair{"pointed cone on plate", R"("shape": "cone", "radius": 0.5, "height": 1.1)",
              R"("shape": "cylinder", "radius": 1, "height": 0.3)",
              R"("position": [0.03, 0.31, 0.05])", R"("position": [0, -0.4, 0])"},
    SolidPair{"box in box", R"("shape": "box", "size": [1.1, 0.9, 1])",
              R"("shape": "box", "size": [1, 1.2, 0.7])", R"("turn": [10, 20, 30])",
              R"("position": [0.4, 0.1, 0.3])"},
    SolidPair{"nested shells", R"("shape": "sphere", "radius": 0.8)",
              R"("shape": "ellipsoid", "radii": [0.83, 0.75, 0.83])", R"("position": [0, 0, 0])",
              R"("position": [0, 0, 0])", true},
    SolidPair{"capsule in ellipsoid", R"("shape": "capsule", "radius": 0.3, "height": 1.2)",
              R"("shape": "ellipsoid", "radii": [0.9, 0.4, 0.6])", R"("turn": [0, 40, 25])",
              R"("turn": [15, 5, 0])"}};

/// The models and the objects of a pair in the world; each model has its own surface.
inline std::array<std::string, 2> pair_text(const SolidPair& pair, const char* first,
                                            const char* second) {
    return {fmt::format(R"("a": {{{}, "surface": "{}"}}, "b": {{{}, "surface": "{}"}})", pair.first,
                        first, pair.second, second),
            fmt::format(R"({{"model": "a", "placement": "world", {}}},
                           {{"model": "b", "placement": "world", {}}})",
                        pair.first_at, pair.second_at)};
}

inline double random_in(std::mt19937& random, double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
}

/// A shape of a random kind and size.
inline std::string random_shape(std::mt19937& random) {
    const auto in = [&](double low, double high) { return random_in(random, low, high); };
    switch (random() % 7) {
        case 0:
            return fmt::format(R"("shape": "sphere", "radius": {})", in(.4, .7));
        case 1:
            return fmt::format(R"("shape": "box", "size": [{}, {}, {}])", in(.5, 1.2), in(.5, 1.2),
                               in(.5, 1.2));
        case 2:
            return fmt::format(R"("shape": "torus", "radius": {}, "tube": {})", in(.4, .7),
                               in(.15, .3));
        case 3:
            return fmt::format(R"("shape": "cylinder", "radius": {}, "height": {})", in(.3, .6),
                               in(.5, 1.2));
        case 4:
            return fmt::format(R"("shape": "cone", "radius": {}, "height": {}, "top_radius": {})",
                               in(.4, .7), in(.6, 1.2), in(.1, .4));
        case 5:
            return fmt::format(R"("shape": "cone", "radius": {}, "height": {})", in(.4, .7),
                               in(.6, 1.2));
        default:
            return fmt::format(R"("shape": "ellipsoid", "radii": [{}, {}, {}])", in(.3, .7),
                               in(.3, .7), in(.3, .7));
    }
}

/// The minimum and the maximum factor by which random_map() stretches, and the maximum shift along
/// each axis: mapped solids stay inside the world.
inline constexpr double kMinMapStretch = 0.65, kMaxMapStretch = 1.05, kMaxMapShift = 0.2;

/// The matrix of a random affine map that shears, as JSON. Between two turns it stretches, and
/// every other map mirrors.
inline std::string random_map(std::mt19937& random) {
    const auto turn = [&] {
        glm::dvec3 degrees;
        for (int axis = 0; axis < 3; ++axis) degrees[axis] = random_in(random, 0, 360);
        return rotation_from_turn(degrees);
    };
    glm::dmat3 stretch(1);
    for (int axis = 0; axis < 3; ++axis)
        stretch[axis][axis] = random_in(random, kMinMapStretch, kMaxMapStretch);
    if (random() % 2 == 0) stretch[0][0] = -stretch[0][0];
    const glm::dmat3 first = turn(), second = turn(), m = second * stretch * first;
    std::string rows;
    for (int row = 0; row < 3; ++row)
        rows += fmt::format("{}[{}, {}, {}, {}]", row == 0 ? "" : ", ", m[0][row], m[1][row],
                            m[2][row], random_in(random, -kMaxMapShift, kMaxMapShift));
    return fmt::format(R"("matrix": [{}])", rows);
}

/// The models and the objects of two random solids under random maps; each model has its own
/// surface.
inline std::array<std::string, 2> random_pair(std::mt19937& random, const char* first,
                                              const char* second) {
    std::array<std::string, 2> shapes, maps;
    for (int i = 0; i < 2; ++i) {
        shapes[size_t(i)] = random_shape(random);
        maps[size_t(i)] = random_map(random);
    }
    return pair_text(
        {"random", shapes[0].c_str(), shapes[1].c_str(), maps[0].c_str(), maps[1].c_str()}, first,
        second);
}

}  // namespace voxelume
