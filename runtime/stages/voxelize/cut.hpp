// object grid -> object grid: what is left of a body that solids cut away from.
#pragma once

#include <vector>

#include "runtime/grid/grid.hpp"
#include "runtime/opencl/device.hpp"
#include "runtime/scene/solid.hpp"

namespace voxelume {

/// All of a frame but what is in one of `cuts`, whose parents are the frame's space: a body to be
/// voxelized as the one that is cut.
Solid rest_of(const GridFrame& frame, const std::vector<Solid>& cuts);

/// A body, or what is left of space, as `cubes`: two grids of one frame.
struct CoveredBody {
    const BrickGrid& cover;   ///< the set asked for
    const BrickGrid& inside;  ///< VoxelSet::solid; the same grid where that is asked for
};

/// What a body and the rest of space have in common. The grids have one frame; voxels that only the
/// rest concerns have the body's own word and are white.
///
/// Of distance fields it is the greater distance, of SOLID sets the voxels in both. Of other sets
/// it is what each covers on or in the other, which closes the surface where it was cut; along the
/// edges of the cut the cover may have voxels of both that the common surface just misses.
BrickGrid common_field(const Device& device, const BrickGrid& body, const BrickGrid& rest);
BrickGrid common_cubes(const Device& device, const CoveredBody& body, const CoveredBody& rest);

}  // namespace voxelume
