// What to make of a model: shared by the stages that voxelize meshes and analytic solids.
#pragma once

#include <cstdint>

#include "runtime/grid.hpp"

namespace voxelume {

/// Which voxels stand for an object made of cubes; the definitions are those of
/// Cohen-Or & Kaufman 1995 and Laine 2013.
enum class VoxelSet : uint8_t {
    supercover,  ///< every voxel that the surface touches: no ray passes, even through corners
    thin,        ///< 6-separating: a path of voxels that share faces can't pass
    solid,       ///< every voxel whose centre is inside
};

struct VoxelizeOptions {
    Surface surface = Surface::smooth;
    VoxelSet set = VoxelSet::supercover;  ///< for `cubes`; the other surfaces decide themselves
};

}  // namespace voxelume
