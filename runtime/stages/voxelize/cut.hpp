// SPDX-License-Identifier: Apache-2.0
// object grid -> object grid: what remains of a body after solids are cut away from it.
#pragma once

#include <vector>

#include "runtime/grid/grid.hpp"
#include "runtime/opencl/device.hpp"
#include "runtime/scene/parts/solid.hpp"

namespace voxelume {

/// The whole frame without the solids `cuts`, which `frame_from_model` maps into the frame's space.
/// It lies in the frame's space, and is to be voxelized there in the same way as the body.
Solid rest_of(const GridFrame& frame, const glm::dmat4& frame_from_model,
              const std::vector<Solid>& cuts);

/// A body, or the rest of space, as `cubes`: two grids of one frame.
struct CoveredBody {
    const BrickGrid& cover;   ///< the set that is asked for
    const BrickGrid& inside;  ///< VoxelSet::solid; the same grid as `cover` if that set is asked
                              ///< for
};

/// The intersection of a body and the rest of space. The grids have one frame. Voxels that only the
/// rest concerns have the body's own packed attributes and are white.
///
/// The intersection of distance fields is the greater distance, that of SOLID sets the voxels in
/// both. For other sets it is what each covers on or in the other, which closes the surface where
/// it was cut. Along the edges of the cut the cover may have voxels of both that the common surface
/// just misses.
BrickGrid common_field(const Device& device, const BrickGrid& body, const BrickGrid& rest);
BrickGrid common_cubes(const Device& device, const CoveredBody& body, const CoveredBody& rest);

}  // namespace voxelume
