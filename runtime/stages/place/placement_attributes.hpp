// The packed attributes that an object's voxels get in the world.
#pragma once

#include <glm/vec4.hpp>
#include <vector>

#include "runtime/stages/place/place.hpp"

namespace voxelume {

/// An object's words as lib/voxelize/placed_attributes.h reads them.
struct AttributeMap {
    glm::uvec4 map;  ///< kind bits and object, the object's own constant word, materials, 0
    Buffer<uint32_t> materials;  ///< of each group
};

AttributeMap attribute_map(const Device& device, const PlacedObject& object, Surface surface);

/// Every word that a voxel of the object may get.
std::vector<uint32_t> possible_attributes(const PlacedObject& object, Surface surface);

}  // namespace voxelume
