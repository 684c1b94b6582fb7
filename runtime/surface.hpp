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

/// Which voxels belong to a `cubes` model.
enum class VoxelSet : uint8_t { supercover, thin, solid };

}  // namespace voxelume
