// observer and lights -> a convex body of the world that no ray leaves.
#pragma once

#include <vector>

#include "runtime/grid/grid_frame.hpp"
#include "runtime/scene/scene.hpp"

namespace voxelume {

/// The convex hull of points, in the world's voxels.
using Hull = std::vector<glm::dvec3>;

/// Holds all that sight rays pass of the world.
Hull hull_of_sight_rays(const Observer& observer, const GridFrame& world);

/// Adds what rays pass of the world from a hull's points to the scene's lights, and to all of
/// `emissive_objects`.
void add_shadow_rays(const Scene& scene, const std::vector<VoxelBox>& emissive_objects,
                     const GridFrame& world, Hull& hull);

/// Whether there is a plane more than `gap` voxels wide between a hull and a box. A yes is certain
/// but for the rounding of doubles; a no may be wrong by a little.
bool are_apart(const Hull& hull, const VoxelBox& box, double gap);

}  // namespace voxelume
