// SPDX-License-Identifier: Apache-2.0
// The emissive voxels of a scene, as stages exchange them.
#pragma once

#include <cstdint>

#include "kernels/shared/emitters.h"
#include "runtime/opencl/buffer.hpp"
#include "runtime/opencl/program.hpp"

namespace voxelume {

/// The emitters of a scene; without records if paths don't look for any.
struct EmitterTable {
    bool is_searched = false;  ///< by features with `emitters`: other kernels take no table
    uint32_t count = 0;
    Buffer<EmitterRecord> records;
    uint32_t slots = 0;           ///< number of slots in `table`: a power of two
    Buffer<uint32_t> table;       ///< emitters' numbers by their voxels' hash
    Buffer<EmitterFrame> frames;  ///< only in scenes with instances
    float volume = 0;             ///< volume of the world's voxels, cubic metres
};

/// VXL_EMITTER_PARAMETERS of kernels.
void bind(KernelArguments& to, const EmitterTable& emitters);

}  // namespace voxelume
