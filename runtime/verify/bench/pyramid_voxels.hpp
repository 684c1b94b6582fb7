// SPDX-License-Identifier: Apache-2.0
// The voxels of a pyramid, read back from the device.
#pragma once

#include <functional>
#include <glm/vec3.hpp>

#include "runtime/grid/grid.hpp"

namespace voxelume {

/// A grid in a pyramid's buffers: the world's, or that of a model that instances show.
struct PyramidPart {
    GridFrame frame;
    uint32_t first_sector = 0;
};

/// The world's grid, or the first model's where an instance shows the only object.
PyramidPart shown_part(const Pyramid& pyramid);

/// Calls `visit` with every voxel of the part and its number, in no particular order.
void for_voxels(const Pyramid& pyramid, const PyramidPart& part,
                const std::function<void(const glm::ivec3& voxel, uint32_t number)>& visit);

}  // namespace voxelume
