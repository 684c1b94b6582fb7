// The two choices that a model makes about its voxels.
#pragma once

#include <cstdint>

namespace voxelume {

/// What stands for the surface inside a voxel; the numbers are those of shared/voxel.h.
enum class Surface : uint8_t {
    cubes = 0,   ///< the voxel itself
    smooth = 1,  ///< the zero of a distance field
    exact = 2,   ///< the source's own triangles or solid
};

/// Which voxels stand for an object made of cubes; the definitions are those of
/// Cohen-Or & Kaufman 1995 and Laine 2013.
enum class VoxelSet : uint8_t {
    supercover,  ///< every voxel that the surface touches: no ray passes, even through corners
    thin,        ///< 6-separating: a path of voxels that share faces can't pass
    solid,       ///< every voxel whose centre is inside
};

}  // namespace voxelume
