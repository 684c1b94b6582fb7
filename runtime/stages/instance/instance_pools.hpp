// SPDX-License-Identifier: Apache-2.0
// pyramids of models -> the world's pyramid with the models' voxels appended, for instances to
// share.
#pragma once

#include <span>

#include "runtime/grid/grid.hpp"
#include "runtime/opencl/device.hpp"
#include "runtime/stages/instance/instance_model.hpp"

namespace voxelume {

/// The buffers of the joined pyramid.
Pyramid allocate_joined(const Device& device, const Pyramid& world,
                        std::span<const ModelPyramid> models);

/// The world's pyramid with the models' pyramids appended in every buffer, and no instances yet.
///
/// The models' packed attributes hold the kind of each voxel or primitive, and its group as the
/// material. Throws Error::limit for more voxels or primitives than can be numbered, or if memory
/// doesn't suffice.
Pyramid join_models(const Device& device, const Pyramid& world,
                    std::span<const ModelPyramid> models);

}  // namespace voxelume
