// SPDX-License-Identifier: Apache-2.0
// The packed attributes that an object's voxels get in the world.
#pragma once

#include <glm/vec4.hpp>
#include <vector>

#include "runtime/stages/place/place.hpp"

namespace voxelume {

/// The packed attributes of an object, as lib/voxelize/placed_attributes.h reads them.
struct AttributeMap {
    glm::uvec4 map;  ///< kind bits and object; the object's own constant attributes; number of
                     ///< materials; 0
    Buffer<uint32_t> materials;  ///< for each group
};

AttributeMap attribute_map(const Device& device, const PlacedObject& object, Surface surface);

/// All values of packed attributes that a voxel of the object may get.
std::vector<uint32_t> possible_attributes(const PlacedObject& object, Surface surface);

}  // namespace voxelume
