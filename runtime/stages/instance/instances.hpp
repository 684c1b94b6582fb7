// models -> instances: shares models' voxels between objects that rays are carried into.
#pragma once

#include <glm/mat4x4.hpp>
#include <span>

#include "runtime/grid/grid.hpp"
#include "runtime/opencl/device.hpp"

namespace voxelume {

/// Makes `list` the instances of a joined pyramid. `materials` holds the scene's materials of their
/// groups. They stand nowhere until they are placed; those of empty models are left out.
void set_instances(const Device& device, std::span<const Instance> list,
                   std::span<const uint32_t> materials, Pyramid& pyramid);

/// Places the instances, as often as they move, in records of their own: a copy of the pyramid made
/// before shows them where they were. `world_from_object` has the map of each object of
/// the scene, metres to metres: mirrors and shears are welcome.
///
/// Throws Error::scene for a map that can't be inverted well
/// (runtime/stages/place/placement_map.hpp).
void place_instances(const Device& device, std::span<const glm::dmat4> world_from_object,
                     Pyramid& pyramid);

}  // namespace voxelume
