// SPDX-License-Identifier: Apache-2.0
// cuts of smooth meshes -> the bricks and voxels of their surfaces in a lattice.
#pragma once

#include "runtime/memory/count/brick_count.hpp"
#include "runtime/scene/parts/object.hpp"

namespace voxelume {

/// The union of all that is cut from a smooth mesh; it has no parts if nothing is.
Solid cuts_of(const Model& model);

/// The extent of the surfaces of a mesh's cuts in a box of a lattice; 0 if it isn't smooth.
SurfaceExtent cut_extent(const Model& model, const glm::dmat4& frame_from_model,
                         const GridFrame& frame, const VoxelBox& box, const BrickRule& rule);

/// The number of bricks that the cuts' surfaces take in a model's grid.
size_t cut_bricks(const Model& model, const glm::dmat4& frame_from_model, const GridFrame& frame);

}  // namespace voxelume
