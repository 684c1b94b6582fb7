// SPDX-License-Identifier: Apache-2.0
// The tree of lights of which paths choose some, as stages exchange it.
#pragma once

#include <cstdint>

#include "kernels/shared/light_tree.h"
#include "kernels/shared/paths.h"
#include "runtime/opencl/buffer.hpp"
#include "runtime/opencl/program.hpp"

namespace voxelume {

/// The tables of a tree of lights.
struct LightTree {
    Buffer<LightRecord> lights;     ///< one for each node of the last level
    Buffer<LightAreaRecord> areas;  ///< as many, or one where lights are points
    Buffer<LightNode> nodes;        ///< by number; number 0 is no node
    uint32_t levels = 0;            ///< below the root
    uint32_t compared = 0;          ///< the level whose nodes are compared
    bool has_areas = false;
};

/// VXL_LIGHT_TREE_PARAMETERS of kernels.
void bind(KernelArguments& to, const LightTree& tree);

}  // namespace voxelume
