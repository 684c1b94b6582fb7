// SPDX-License-Identifier: Apache-2.0
// Scenes in JSON that leave out values.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <string>

#include "runtime/base/error.hpp"
#include "runtime/scene_file/read_scene.hpp"
#include "tests/support/file_fixture.hpp"

namespace voxelume {

/// A scene of these members alone, on line 2.
inline std::string scene_with_members(const std::string& members) {
    return "{\"voxelume\": 1,\n" + members + "}";
}

inline Scene parse_members(const std::string& members) {
    return parse_scene(scene_with_members(members), "s.json", {});
}

inline std::string message_about(const std::string& members) {
    return error_of([&] { parse_members(members); }).what();
}

inline constexpr const char* kBall =
    R"("models": {"ball": {"shape": "sphere", "radius": 0.5, "surface": "smooth"}},
"objects": [{"name": "ball", "model": "ball", "position": [1, -2, 3]}])";

/// How far ahead of the observer the world's nearest corner is, in metres.
inline double depth_of_nearest_corner(const Scene& scene, const Observer& observer) {
    const Bounds world = lattice_bounds(scene.world);
    double nearest = INFINITY;
    for (int i = 0; i < 8; ++i)
        nearest = std::min(nearest, glm::dot(observer.world_from_observer[2],
                                             corner(world, i) - observer.position));
    return nearest;
}

}  // namespace voxelume
