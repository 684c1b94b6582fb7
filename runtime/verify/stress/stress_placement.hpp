// SPDX-License-Identifier: Apache-2.0
// affine maps -> mismatches between the voxels that place.cl sets and the exact ones.
#pragma once

#include <glm/mat4x4.hpp>

#include "runtime/verify/stress/stress.hpp"

namespace voxelume {

/// A map from an object's metres to the world's.
struct StressMap {
    glm::dmat4 world_from_object{1.0};
    bool is_exact = false;  ///< true if the numbers of the inverse have few bits, so that nothing
                            ///< is rounded
};

/// Map `number`. Even maps turn by quarters and mirror, scale by powers of two and shift by
/// quarters of voxels, so that centres fall on faces. Odd maps turn, stretch, shear and shift by
/// any amount.
StressMap stress_map(uint64_t seed, uint64_t number);

/// Tries the placement of a lump of cubes by maps. A world voxel is set if its centre's image lies
/// in a set voxel of the object. Where the map has to be rounded, a centre may fall on either side
/// of a face if it is closer to the face than rounding moves it.
StressResult stress_placement(const StressRun& run);

}  // namespace voxelume
