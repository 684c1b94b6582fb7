// affine maps -> mismatches between the voxels that place.cl sets and the exact ones.
#pragma once

#include <glm/mat4x4.hpp>

#include "runtime/verify/stress/stress.hpp"

namespace voxelume {

/// A map of an object's metres to the world's.
struct StressMap {
    glm::dmat4 world_from_object{1.0};
    bool is_exact = false;  ///< its inverse's numbers are few bits long, so nothing is rounded
};

/// Map `number`: even ones turn by quarters and mirror, scale by powers of two and shift by
/// quarters of voxels, so that centres fall on faces; odd ones turn, stretch, shear and shift by
/// anything.
StressMap stress_map(uint64_t seed, uint64_t number);

/// Tries the placement of a lump of cubes by maps. A world voxel is set when its centre's image
/// lies in a set voxel of the object. Where the map has to be rounded, centres closer to a face
/// than that moves them may fall on either side.
StressResult stress_placement(const StressRun& run);

}  // namespace voxelume
