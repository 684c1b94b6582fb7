// SPDX-License-Identifier: Apache-2.0
// The loaded picture of a sky.
#pragma once

#include <cstdint>
#include <memory>
#include <mutex>
#include <vector>

namespace voxelume {

/// The radiance of a sky, and the table for sampling directions; see kernels/shared/sky.h.
struct SkyMapData {
    int width = 0, height = 0;    ///< texels
    std::vector<float> texels;    ///< red, green and blue, in rows from the zenith down
    int columns = 0, rows = 0;    ///< cells
    std::vector<uint32_t> table;  ///< table of the cells
};

/// Storage for the picture of a sky, which is read when it is first needed. Copies of a scene share
/// it.
struct SkyMapRoom {
    std::mutex mutex;
    std::shared_ptr<const SkyMapData> data;
};

/// The storage of a sky's picture; never null for a map. Comparing skies ignores it, because the
/// other values determine it.
struct SkyMapPlace {
    std::shared_ptr<SkyMapRoom> room;

    friend bool operator==(const SkyMapPlace&, const SkyMapPlace&) { return true; }
};

}  // namespace voxelume
