// SPDX-License-Identifier: Apache-2.0
// observer and lights -> a convex body in the world that no ray leaves
#pragma once

#include <vector>

#include "runtime/grid/grid_frame.hpp"
#include "runtime/scene/scene.hpp"

namespace voxelume {

/// The convex hull of points, in the world's voxels.
using Hull = std::vector<glm::dvec3>;

/// A hull that contains every part of the world that sight rays pass.
Hull hull_of_sight_rays(const Observer& observer, const GridFrame& world);

/// Extends the hull by every part of the world that rays pass on the way from its points to the
/// scene's lights and to all of `emissive_objects`.
void add_shadow_rays(const Scene& scene, const std::vector<VoxelBox>& emissive_objects,
                     const GridFrame& world, Hull& hull);

/// True if a plane more than `gap` voxels wide lies between a hull and a box. True is certain but
/// for the rounding of doubles; false may be wrong by a little.
bool are_apart(const Hull& hull, const VoxelBox& box, double gap);

}  // namespace voxelume
