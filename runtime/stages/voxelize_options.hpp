// What to make of a model: shared by the stages that voxelize meshes and analytic solids.
#pragma once

#include "runtime/surface.hpp"

namespace voxelume {

struct VoxelizeOptions {
    Surface surface = Surface::smooth;
    VoxelSet set = VoxelSet::supercover;  ///< for `cubes`; the other surfaces decide themselves
};

}  // namespace voxelume
