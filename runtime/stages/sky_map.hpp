// SPDX-License-Identifier: Apache-2.0
// The picture of a sky, as stages exchange it.
#pragma once

#include <cstdint>

#include "kernels/shared/sky.h"
#include "runtime/opencl/buffer.hpp"
#include "runtime/opencl/program.hpp"

namespace voxelume {

/// A sky that is a map; kernels without one take nothing of this.
struct SkyMap {
    bool is_used = false;
    SkyMapRecord record{};
    Buffer<float> texels;    ///< SkyMapData::texels
    Buffer<uint32_t> table;  ///< SkyMapData::table
};

/// VXL_SKY_MAP_PARAMETERS of kernels.
inline void bind(KernelArguments& to, const SkyMap& map) {
    if (map.is_used) to.add(map.record, map.texels, map.table);
}

/// The sky of a world.
struct SkyView {
    Buffer<SkyRecord> record;  ///< one; empty in a world without a sky
    SkyMap map;
};

/// VXL_SKY_PARAMETERS of kernels.
inline void bind(KernelArguments& to, const SkyView& sky) {
    to.add(sky.record, sky.map);
}

}  // namespace voxelume
