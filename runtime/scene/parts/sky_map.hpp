// SPDX-License-Identifier: Apache-2.0
// A picture of everything around the world, as it was read.
#pragma once

#include <cstdint>
#include <memory>
#include <mutex>
#include <vector>

namespace voxelume {

/// The radiance of a sky, and what directions are chosen by; kernels/shared/sky.h tells of both.
struct SkyMapData {
    int width = 0, height = 0;    ///< texels
    std::vector<float> texels;    ///< red, green and blue, in rows from the zenith down
    int columns = 0, rows = 0;    ///< cells
    std::vector<uint32_t> table;  ///< of the cells
};

/// Room for the picture of a sky, which is read when it is needed first. Copies of a scene share
/// it.
struct SkyMapRoom {
    std::mutex mutex;
    std::shared_ptr<const SkyMapData> data;
};

/// Where a sky's picture is kept: of a map never null. It says nothing of the sky that its other
/// values don't.
struct SkyMapPlace {
    std::shared_ptr<SkyMapRoom> room;

    friend bool operator==(const SkyMapPlace&, const SkyMapPlace&) { return true; }
};

}  // namespace voxelume
