// SPDX-License-Identifier: Apache-2.0
// object grid -> a model that instances share: its pyramid, and the box of its voxels.
#pragma once

#include "runtime/grid/grid.hpp"
#include "runtime/opencl/device.hpp"

namespace voxelume {

struct ModelPyramid {
    Pyramid pyramid;
    glm::ivec3 low{0}, high{0};  ///< the box of its voxels; empty for a model without any
};

/// Builds the pyramid as build_index does, and finds its box. Throws as build_index does.
ModelPyramid index_model(const Device& device, const BrickGrid& grid);

}  // namespace voxelume
