// SPDX-License-Identifier: Apache-2.0
// a picture of the sky -> its radiance, and cells for sampling directions by their light.
#pragma once

#include <memory>

#include "runtime/opencl/device.hpp"
#include "runtime/scene/parts/sky.hpp"
#include "runtime/stages/sky_map.hpp"

namespace voxelume {

/// The maximum number of pixels of a sky's picture: 8192 x 4096.
inline constexpr int64_t kMaxSkyPixels = int64_t{1} << 25;

/// Makes the cells of a picture, in proportion to the light of each; `data` has everything else.
/// All is computed in double and rounded to integers, and no cell is left out, however dark.
void make_sky_cells(SkyMapData& data);

/// The picture of a sky that is a map; it is read once. Negative values and NaN count as 0, values
/// above 1e9 as 1e9. Throws Error::input, which begins with the place of the file's name.
std::shared_ptr<const SkyMapData> sky_map_data(const Sky& sky);

/// Puts a sky's picture on a device.
SkyMap build_sky_map(const Device& device, const Sky& sky);

/// The bytes of a sky map on a device, by its file's header, and in main memory while it is read.
struct SkyMapBytes {
    double texels = 0, table = 0, host = 0;
};
SkyMapBytes sky_map_bytes(const Sky& sky);

}  // namespace voxelume
