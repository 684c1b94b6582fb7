// What to make of a model: shared by the stages that voxelize meshes and analytic solids.
#pragma once

#include "runtime/scene/surface.hpp"

namespace voxelume {

struct VoxelizeOptions {
    Surface surface = Surface::smooth;
    VoxelSet set = VoxelSet::supercover;  ///< for `cubes`; the other surfaces decide themselves
    double band = 2.8;  ///< `smooth`: distances of meshes are exact up to here, in shortest voxel
                        ///< edges, at most 4; 2.8 is what rays and gradients at a surface read
};

}  // namespace voxelume
