// SPDX-License-Identifier: Apache-2.0
// object grid -> object grid: the rest of a body after solids are cut away from it.
#pragma once

#include <memory>
#include <vector>

#include "runtime/grid/grid.hpp"
#include "runtime/opencl/device.hpp"
#include "runtime/scene/parts/solid.hpp"

namespace voxelume {

/// The whole frame without the solids `cuts`, which `frame_from_model` maps into the frame's space.
/// The result lies in the frame's space, and is to be voxelized there in the same way as the body.
Solid rest_of(const GridFrame& frame, const glm::dmat4& frame_from_model,
              const std::vector<Solid>& cuts);

/// A body, or the rest of space, as `cubes`: two grids of one frame.
struct CoveredBody {
    const BrickGrid& cover;   ///< the requested set
    const BrickGrid& inside;  ///< VoxelSet::solid; the same grid as `cover` if that is the set
};

/// The rest of a `smooth` body after solids are cut away, as a grid with parts: the body's own
/// distances and those to the surfaces of `rest`, so that the edges of the cut are sharp. `rest`
/// comes from rest_of(). Surfaces of the cut have material 0, object 0, and are white.
BrickGrid cut_field(const Device& device, std::shared_ptr<const BrickGrid> body, const Solid& rest);

/// The intersection of a body and the rest of space, as `cubes`. The grids have one frame. Voxels
/// that only belong to the surface of the rest have the body's own packed attributes and are white.
///
/// The intersection of SOLID sets has the voxels in both. For other sets it has the voxels that
/// each covers on or inside the other, which closes the surface where it was cut. Along the edges
/// of the cut the cover may have voxels of both that the common surface just misses.
BrickGrid common_cubes(const Device& device, const CoveredBody& body, const CoveredBody& rest);

}  // namespace voxelume
