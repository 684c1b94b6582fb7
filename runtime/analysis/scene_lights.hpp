// SPDX-License-Identifier: Apache-2.0
// scene -> the lights that it lists, as kernels have them.
#pragma once

#include <optional>
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

/// The lights that a scene lists and its sun, as global light samples them.
std::vector<PathLight> path_lights(const Scene& scene, const GridFrame& world);

}  // namespace voxelume
