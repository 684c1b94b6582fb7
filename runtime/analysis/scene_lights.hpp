// SPDX-License-Identifier: Apache-2.0
// scene -> the lights that it lists, as kernels have them.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "kernels/shared/paths.h"
#include "kernels/shared/scene.h"
#include "runtime/grid/grid.hpp"
#include "runtime/scene/scene.hpp"

namespace voxelume {

/// The lights that a scene lists, those with an area by their samples, and its sun.
std::vector<LightRecord> given_lights(const Scene& scene, const GridFrame& world);

/// A light that a scene lists, and its area if it has one.
struct PathLight {
    LightRecord record;
    std::optional<LightAreaRecord> area;
    uint32_t number = 0;  ///< number of its random samples, which doesn't depend on other lights
};

/// The lights that a scene lists and its sun, as global light samples them. Among them are dark
/// lights that may be chosen.
std::vector<PathLight> path_lights(const Scene& scene, const GridFrame& world);

/// The lights of `lights` of which each point chooses one, on a surface or in a medium, where there
/// are so many that shadow rays to each of them take longer than the choice's noise is worth:
/// points and spots without an area. Empty if there are fewer, or all are dark.
std::vector<LightRecord> chosen_lights(std::span<const PathLight> lights);

/// True for a light that is among these if there are any.
bool may_be_chosen(const PathLight& light);

/// True for a light that brings no light, but may be chosen.
bool is_dark(const PathLight& light);

/// The number of chosen lights of a scene; 0 in local light.
size_t count_chosen_lights(const Scene& scene, const GridFrame& world);

}  // namespace voxelume
