// SPDX-License-Identifier: Apache-2.0
// models -> instances: shares models' voxels between objects whose rays are transformed.
#pragma once

#include <glm/mat4x4.hpp>
#include <span>

#include "runtime/grid/grid.hpp"
#include "runtime/opencl/device.hpp"

namespace voxelume {

/// Makes `list` the instances of a joined pyramid, without those of empty models. `materials` holds
/// the scene's materials of their groups. The instances have no placement until they are placed.
void set_instances(const Device& device, std::span<const Instance> list,
                   std::span<const uint32_t> materials, Pyramid& pyramid);

/// Places the instances. It may be called whenever they move: each call makes new records, so a
/// copy of the pyramid that was made before still shows their earlier placements.
/// `world_from_object` holds the map of each object of the scene, metres to metres; maps may mirror
/// and shear.
///
/// Throws Error::scene for a map that is singular or nearly so
/// (runtime/stages/place/placement_map.hpp).
void place_instances(const Device& device, std::span<const glm::dmat4> world_from_object,
                     Pyramid& pyramid);

}  // namespace voxelume
