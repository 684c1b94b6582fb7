// SPDX-License-Identifier: Apache-2.0
// scene -> the lights that it lists, as kernels have them.
#pragma once

#include <span>
#include <vector>

#include "kernels/shared/scene.h"
#include "runtime/grid/grid.hpp"
#include "runtime/scene/scene.hpp"
#include "runtime/stages/light/light.hpp"

namespace voxelume {

/// The lights that a scene lists, those with an area by their samples, and its sun.
std::vector<LightRecord> given_lights(const Scene& scene, const GridFrame& world);

/// The lights that a scene lists and its sun, as global light samples them. Among them are dark
/// lights that may be chosen.
std::vector<PathLight> path_lights(const Scene& scene, const GridFrame& world);

/// The lights of `lights` of which each point chooses one, on a surface or in a medium, where there
/// are so many that shadow rays to each of them take longer than the choice's noise is worth: a
/// list of points and spots, and one of lights with a small area, from each of which one is chosen.
/// Lists that would be short, or dark, are left out.
std::vector<std::vector<PathLight>> chosen_lights(std::span<const PathLight> lights,
                                                  const GridFrame& world);

/// True for a light that is in a list if there is one for its kind. Large lights aren't, since they
/// bring light to most of a world: a choice among them makes more noise than it saves time.
bool may_be_chosen(const PathLight& light, const GridFrame& world);

/// True for a light that brings no light, but may be chosen.
bool is_dark(const PathLight& light);

/// True if points of paths send rays to each of some lights with an area: those that may not be
/// chosen or, unless `are_chosen`, all.
bool asks_areas(const Scene& scene, const GridFrame& world, bool are_chosen);

/// The chosen lights of a scene; none in local light.
std::vector<std::vector<PathLight>> chosen_lights_of(const Scene& scene, const GridFrame& world);

}  // namespace voxelume
