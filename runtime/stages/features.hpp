// What a scene really contains: the constants that decide which code its kernels are made of.
#pragma once

#include "runtime/opencl/program.hpp"

namespace voxelume {

/// Every feature that is false does not exist in the machine code, and its buffers are not
/// allocated.
struct Features {
    bool cubes = false;       ///< some voxel is its own surface
    bool smooth = false;      ///< some voxel has a distance field
    bool exact = false;       ///< some voxel lists primitives
    bool attributes = false;  ///< voxels differ in object, material or kind
    bool colors = false;      ///< voxels have colours of their own
    bool medium = false;      ///< the space absorbs light
    bool shadows = false;     ///< lights can be hidden

    Defines defines(const Device& device) const {
        return {{"VXL_CUBES", cubes},     {"VXL_SMOOTH", smooth},
                {"VXL_EXACT", exact},     {"VXL_ATTRIBUTES", attributes},
                {"VXL_COLORS", colors},   {"VXL_MEDIUM", medium},
                {"VXL_SHADOWS", shadows}, {"VXL_NATIVE_DIVIDE", device.is_cpu()}};
    }
};

}  // namespace voxelume
